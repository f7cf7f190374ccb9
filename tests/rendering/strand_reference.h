#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "hair/gpu_structs.h"
#include "hair/groom/groom.h"
#include "hair/random.h"
#include "hair/settings.h"

// Strands in double precision, written from the thesis's equations and not from the shaders. Only
// the random numbers (hair/random.h) are shared: without the same ones there is nothing to compare.
namespace hair::reference {

struct Point {
    glm::dvec3 position;
    glm::dvec3 tangent;  // d position / d t
    double width;
    double along;
};

// Thesis equations (1) and (2) with the fold of 2.3.2.
inline std::array<double, 3> foldedWeights(double t1, double t2) {
    if (t1 + t2 > 1.0) {
        t1 = 1.0 - t1;
        t2 = 1.0 - t2;
    }
    return {t1, t2, 1.0 - t1 - t2};
}

inline std::array<double, 3>
weights(std::uint32_t seed, std::uint32_t triangle, std::uint32_t strand) {
    const std::uint32_t first = pcg(hash(seed, triangle, gpu::kRootPurpose) + strand);
    return foldedWeights(
        static_cast<double>(first >> 8u) / 16777216.0,
        static_cast<double>(pcg(first) >> 8u) / 16777216.0);
}

// Thesis programs 2.3 and 2.4: rand(co) of co = (strand's isoline, 0.6 and -0.4).
inline std::array<double, 3> thesisWeights(std::uint32_t density, std::uint32_t strand) {
    const auto random = [&](double y) {
        const double x = static_cast<double>(strand) / density;
        const double value = 43758.5453 * std::sin(x * 12.9898 + y * 78.233);
        return value - std::floor(value);
    };
    return foldedWeights(random(0.6), random(-0.4));
}

inline std::array<double, 3>
weights(const Settings& settings, std::uint32_t triangle, std::uint32_t strand) {
    if (settings.strands.randomness == Randomness::thesis)
        return thesisWeights(settings.strands.density, strand);
    return weights(settings.seed, triangle, strand);
}

// Vertices of a strand between three guides, thesis 2.3.1 to 2.3.4. `contacts`, [guide][vertex],
// tells whether a guide touches a body at the vertex or above it. If it is empty, no guide does.
inline std::vector<glm::dvec3> strandVertices(
    const groom::Groom& groom, const StrandSettings& settings,
    const std::array<std::uint32_t, 3>& guides, const std::array<double, 3>& w,
    const std::vector<bool>& contacts) {
    const auto mean = [&](std::uint32_t v) {
        glm::dvec3 sum(0.0);
        for (std::size_t i = 0; i < 3; ++i) sum += w[i] * glm::dvec3(groom.strand(guides[i])[v]);
        return sum;
    };
    const auto one =
        groom.strand(guides[static_cast<std::size_t>(std::ranges::max_element(w) - w.begin())]);
    std::vector<glm::dvec3> vertices;
    for (std::uint32_t v = 0; v < groom.vertices_per_strand; ++v) {
        const bool touches =
            settings.collision_rule && std::ranges::any_of(guides, [&](std::uint32_t guide) {
                return contacts[guide * groom.vertices_per_strand + v];
            });
        const glm::dvec3 multi = mean(v);
        const glm::dvec3 single = mean(0) + (glm::dvec3(one[v]) - glm::dvec3(one[0]));
        if (settings.interpolation == Interpolation::single || touches)
            vertices.push_back(single);
        else if (settings.interpolation == Interpolation::mixed)
            vertices.push_back(single + double{settings.blend} * (multi - single));
        else
            vertices.push_back(multi);
    }
    return vertices;
}

// A strand's vertex. One step outside its ends, it is the control point that the curve needs there.
inline glm::dvec3 controlPoint(const std::vector<glm::dvec3>& vertices, int index, Curve curve) {
    const int last = static_cast<int>(vertices.size()) - 1;
    const auto vertex = [&](int i) { return vertices[static_cast<std::size_t>(i)]; };
    if (index >= 0 && index <= last) return vertex(index);
    const int end = index < 0 ? 0 : last;
    if (curve == Curve::bspline_unpinned) return vertex(end);
    // (outside + 4 end + inside) / 6 = end
    return 6.0 * vertex(end) - 4.0 * vertex(end) - vertex(index < 0 ? 1 : last - 1);
}

// The displacement of the point with these weights from its flat triangle: half of the way to the
// mean of its projections onto the corners' tangent planes (Boubekeur and Alexa 2008, Phong
// tessellation).
inline glm::dvec3
lift(const groom::Groom& groom, std::uint32_t triangle, const std::array<double, 3>& t) {
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

using Basis = std::array<std::array<double, 4>, 4>;

// Rows: t^3, t^2, t, 1. Columns: control points. Thesis equation (4), and Catmull and Rom 1974.
inline Basis basis(Curve curve) {
    Basis rows{{{-1, 3, -3, 1}, {3, -6, 3, 0}, {-3, 0, 3, 0}, {1, 4, 1, 0}}};
    double divisor = 6.0;
    if (curve == Curve::catmull_rom) {
        rows = {{{-1, 3, -3, 1}, {2, -5, 4, -1}, {-1, 0, 1, 0}, {0, 2, 0, 0}}};
        divisor = 2.0;
    }
    for (auto& row : rows)
        for (double& number : row) number /= divisor;
    return rows;
}

// Thesis equations (3) and (4), its derivative, and the width of 2.3.5.
inline Point pointOnStrand(
    const groom::Groom& groom, const Settings& settings, std::uint32_t triangle,
    std::uint32_t strand, std::uint32_t segment, double t, const std::vector<bool>& contacts = {}) {
    const Curve curve = settings.strands.curve;
    const Basis rows = basis(curve);
    const double powers[4] = {t * t * t, t * t, t, 1.0};
    const double slopes[4] = {3.0 * t * t, 2.0 * t, 1.0, 0.0};
    const auto w = weights(settings, triangle, strand);
    const std::vector<glm::dvec3> vertices =
        strandVertices(groom, settings.strands, groom.root_triangles[triangle], w, contacts);

    Point point{.position = lift(groom, triangle, w), .tangent = glm::dvec3(0.0)};
    for (std::size_t column = 0; column < 4; ++column) {
        const glm::dvec3 control =
            controlPoint(vertices, static_cast<int>(segment + column) - 1, curve);
        for (std::size_t row = 0; row < 4; ++row) {
            point.position += powers[row] * rows[row][column] * control;
            point.tangent += slopes[row] * rows[row][column] * control;
        }
    }
    point.along = (segment + t) / groom.segmentsPerStrand();
    const double place = settings.strands.taper == Taper::segment ? t : point.along;
    const double start = settings.strands.taper_start;
    const double taper = place > start ? (place - start) / (1.0 - start) : 0.0;
    point.width = (1.0 - taper) * settings.strands.root_width + taper * settings.strands.tip_width;
    return point;
}

}  // namespace hair::reference
