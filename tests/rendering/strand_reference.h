#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "hair/groom/groom.h"
#include "hair/gpu_structs.h"
#include "hair/random.h"
#include "hair/settings.h"

// Strands in double, written from the thesis's equations and not from the shaders. Only the random
// numbers (hair/random.h) are shared: without the same ones there is nothing to compare.
namespace hair::reference {

struct Point {
    glm::dvec3 position;
    glm::dvec3 tangent;  // d position / d t
    double width;
    double along;
};

// Thesis equations (1) and (2) with the fold of 2.3.2.
inline std::array<double, 3>
weights(std::uint32_t seed, std::uint32_t triangle, std::uint32_t strand) {
    const std::uint32_t first = pcg(hash(seed, triangle, gpu::kRootPurpose) + strand);
    double t1 = static_cast<double>(first >> 8u) / 16777216.0;
    double t2 = static_cast<double>(pcg(first) >> 8u) / 16777216.0;
    if (t1 + t2 > 1.0) {
        t1 = 1.0 - t1;
        t2 = 1.0 - t2;
    }
    return {t1, t2, 1.0 - t1 - t2};
}

// A guide's vertex; one step outside its ends what the curve needs there.
inline glm::dvec3 controlPoint(const Groom& groom, std::uint32_t guide, int index, Curve curve) {
    const auto vertices = groom.strand(guide);
    const int last = static_cast<int>(vertices.size()) - 1;
    const auto vertex = [&](int i) { return glm::dvec3(vertices[static_cast<std::size_t>(i)]); };
    if (index >= 0 && index <= last) return vertex(index);
    const int end = index < 0 ? 0 : last;
    if (curve == Curve::bspline_unpinned) return vertex(end);
    // (outside + 4 end + inside) / 6 = end
    return 6.0 * vertex(end) - 4.0 * vertex(end) - vertex(index < 0 ? 1 : last - 1);
}

// How far the point with these weights is moved off its flat triangle: half of the way to the mean
// of its projections onto the corners' tangent planes (Boubekeur and Alexa 2008, Phong
// tessellation).
inline glm::dvec3 lift(const Groom& groom, std::uint32_t triangle, const std::array<double, 3>& t) {
    if (groom.root_normals.empty()) return glm::dvec3(0.0);
    const auto& corners = groom.root_triangles[triangle];
    glm::dvec3 flat(0.0);
    for (std::size_t i = 0; i < 3; ++i) flat += t[i] * glm::dvec3(groom.strand(corners[i])[0]);
    glm::dvec3 curved(0.0);
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3 corner = groom.strand(corners[i])[0];
        const glm::dvec3 normal = groom.root_normals[corners[i]];
        curved += t[i] * (flat - glm::dot(flat - corner, normal) * normal);
    }
    return 0.5 * (curved - flat);
}

// Thesis equations (3) and (4), its derivative, and the width of 2.3.5.
inline Point pointOnStrand(
    const Groom& groom, const Settings& settings, std::uint32_t triangle, std::uint32_t strand,
    std::uint32_t segment, double t) {
    constexpr double kBasis[4][4] = {{-1, 3, -3, 1}, {3, -6, 3, 0}, {-3, 0, 3, 0}, {1, 4, 1, 0}};
    const double powers[4] = {t * t * t, t * t, t, 1.0};
    const double slopes[4] = {3.0 * t * t, 2.0 * t, 1.0, 0.0};
    const auto w = weights(settings.seed, triangle, strand);
    const auto& guides = groom.root_triangles[triangle];

    Point point{.position = lift(groom, triangle, w), .tangent = glm::dvec3(0.0)};
    for (int column = 0; column < 4; ++column) {
        glm::dvec3 control(0.0);
        for (std::size_t i = 0; i < 3; ++i) {
            control += w[i] * controlPoint(
                                  groom, guides[i], static_cast<int>(segment) + column - 1,
                                  settings.strands.curve);
        }
        for (int row = 0; row < 4; ++row) {
            point.position += powers[row] * kBasis[row][column] / 6.0 * control;
            point.tangent += slopes[row] * kBasis[row][column] / 6.0 * control;
        }
    }
    point.along = (segment + t) / groom.segmentsPerStrand();
    const double taper = settings.strands.taper == Taper::segment ? t : point.along;
    point.width = (1.0 - taper) * settings.strands.root_width + taper * settings.strands.tip_width;
    return point;
}

}  // namespace hair::reference
