#pragma once

#include <cmath>
#include <numbers>

#include "hair/groom/mesh/mesh.h"

namespace hair::groom {

inline constexpr auto kNoHole = [](std::uint32_t, std::uint32_t) { return false; };

// The part of a sphere round `centre` up to `opening` from +y, its apex a vertex, in rings of
// `sectors` vertices; outer triangles beyond `hairline` are skin, the rest scalp. Angles in
// radians; exact normals.
struct CapOptions {
    glm::vec3 centre{0.0f};
    float radius = 0.1f;
    float opening = 1.8f;
    float hairline = 1.5f;
    std::uint32_t rings = 24;
    std::uint32_t sectors = 48;
};

inline Mesh makeCap(const CapOptions& options = {}) {
    Mesh mesh;
    mesh.materials = {{.name = "skin"}, {.name = "scalp"}};
    const auto add = [&](float polar, float azimuth) {
        const glm::vec3 normal{
            std::sin(polar) * std::sin(azimuth), std::cos(polar),
            std::sin(polar) * std::cos(azimuth)};
        mesh.positions.push_back(options.centre + options.radius * normal);
        mesh.normals.push_back(normal);
    };
    const auto polarOf = [&](std::uint32_t ring) {
        return options.opening * static_cast<float>(ring) / static_cast<float>(options.rings);
    };
    const auto triangle = [&](std::uint32_t ring, std::uint32_t a, std::uint32_t b,
                              std::uint32_t c) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangle_materials.push_back(polarOf(ring) <= options.hairline ? 1 : 0);
    };
    add(0.0f, 0.0f);
    for (std::uint32_t ring = 1; ring <= options.rings; ++ring) {
        for (std::uint32_t sector = 0; sector < options.sectors; ++sector) {
            const float turn = static_cast<float>(sector) / static_cast<float>(options.sectors);
            add(polarOf(ring), 2.0f * std::numbers::pi_v<float> * turn);
        }
    }
    const auto vertex = [&](std::uint32_t ring, std::uint32_t sector) {
        return ring == 0 ? 0 : 1 + (ring - 1) * options.sectors + sector % options.sectors;
    };
    for (std::uint32_t ring = 1; ring <= options.rings; ++ring) {
        for (std::uint32_t s = 0; s < options.sectors; ++s) {
            triangle(ring, vertex(ring - 1, s), vertex(ring, s), vertex(ring, s + 1));
            if (ring > 1) {
                triangle(ring, vertex(ring - 1, s), vertex(ring, s + 1), vertex(ring - 1, s + 1));
            }
        }
    }
    return mesh;
}

// A flat grid of `columns` by `rows` unit squares in the plane y = 0, facing +y. All squares are
// scalp except those with a true `hole`.
template <class Hole>
Mesh makeGrid(std::uint32_t columns, std::uint32_t rows, Hole&& hole) {
    Mesh mesh;
    mesh.materials = {{.name = "scalp"}};
    for (std::uint32_t z = 0; z <= rows; ++z) {
        for (std::uint32_t x = 0; x <= columns; ++x) {
            mesh.positions.emplace_back(static_cast<float>(x), 0.0f, static_cast<float>(z));
            mesh.normals.emplace_back(0.0f, 1.0f, 0.0f);
        }
    }
    for (std::uint32_t z = 0; z < rows; ++z) {
        for (std::uint32_t x = 0; x < columns; ++x) {
            if (hole(x, z)) continue;
            const std::uint32_t corner = z * (columns + 1) + x;
            const std::uint32_t below = corner + columns + 1;
            mesh.triangles.push_back({corner, below, below + 1});
            mesh.triangles.push_back({corner, below + 1, corner + 1});
            mesh.triangle_materials.insert(mesh.triangle_materials.end(), 2, 0);
        }
    }
    return mesh;
}

}  // namespace hair::groom
