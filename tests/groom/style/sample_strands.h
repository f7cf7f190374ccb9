#pragma once

#include <cmath>
#include <cstdint>
#include <functional>

#include "hair/groom/groom.h"

// Grooms of known curves.
namespace hair::groom {

// `point(strand, t)` gives the curve at t, 0 at the root to 1 at the tip.
inline Groom sampleGroom(
    std::uint32_t strands, std::uint32_t vertices,
    const std::function<glm::dvec3(std::uint32_t, double)>& point) {
    Groom groom{.strand_count = strands, .vertices_per_strand = vertices};
    for (std::uint32_t strand = 0; strand < strands; ++strand)
        for (std::uint32_t i = 0; i < vertices; ++i)
            groom.points.emplace_back(point(strand, double(i) / (vertices - 1)));
    return groom;
}

// Straight up from (x, 0, 0), x = 0, 1, … times `distance`.
inline Groom
verticalStrands(std::uint32_t strands, std::uint32_t vertices, double length, double distance) {
    return sampleGroom(strands, vertices, [=](std::uint32_t strand, double t) {
        return glm::dvec3(strand * distance, length * t, 0.0);
    });
}

// As verticalStrands(), with a normal at each root.
inline Groom withNormals(Groom groom, const glm::vec3& normal) {
    groom.root_normals.assign(groom.strand_count, normal);
    return groom;
}

// All coordinates are at most 1 in size, so a float rounds each of the three by at most 2^-25.
inline constexpr double kRounding = 1e-7;

// Strands with coincident vertices, and a plain one.
inline Groom awkwardStrands() {
    Groom groom{.strand_count = 4, .vertices_per_strand = 3};
    groom.points = {{0, 0, 0},    {0, 0, 0},       {0, 0, 0},  // no length
                    {0.1f, 0, 0}, {0.1f, 0, 0},    {0.1f, 0.2f, 0},  // root twice
                    {0.2f, 0, 0}, {0.2f, 0.2f, 0}, {0.2f, 0, 0},  // back to the root
                    {0.3f, 0, 0}, {0.3f, 0.1f, 0}, {0.3f, 0.2f, 0}};
    return groom;
}

// The guides of a groom as a file would hold them, in metres.
inline StrandSet strandsOf(const Groom& groom) {
    StrandSet strands{
        .points = groom.points,
        .widths = {.values = groom.widths},
        .root_triangles = groom.root_triangles,
        .metres_per_unit = 1.0};
    for (std::uint32_t i = 1; i <= groom.strand_count; ++i)
        strands.ends.push_back(i * groom.vertices_per_strand);
    return strands;
}

inline bool allFinite(const Groom& groom) {
    for (const glm::vec3& p : groom.points)
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return false;
    for (const float width : groom.widths)
        if (!std::isfinite(width)) return false;
    return true;
}

}  // namespace hair::groom
