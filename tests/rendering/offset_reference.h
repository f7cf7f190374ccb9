#pragma once

#include <algorithm>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "hair/groom/style/displace.h"
#include "hair/rendering/strand_offsets.h"
#include "tests/rendering/strand_reference.h"

// Points off the smooth strand, in double precision and independent of the shaders. The table is
// given.
namespace hair::reference {

struct Offset {
    glm::dvec3 value;
    glm::dvec3 slope;  // by the place along the strand, 0 to 1
};

// Catmull and Rom 1974 with tension 1/2, as a matrix.
inline Offset
offsetAt(const rendering::StrandOffsets& offsets, std::uint32_t profile, double along) {
    constexpr double kBasis[4][4] = {{0, 2, 0, 0}, {-1, 0, 1, 0}, {2, -5, 4, -1}, {-1, 3, -3, 1}};
    const double intervals = offsets.samples - 1;
    const double interval = std::min(std::floor(along * intervals), intervals - 1.0);
    const double f = along * intervals - interval;
    const double powers[4] = {1.0, f, f * f, f * f * f};
    const double slopes[4] = {0.0, 1.0, 2.0 * f, 3.0 * f * f};
    const glm::vec3* const before =
        offsets.profile(profile).data() - 1 + static_cast<int>(interval);
    Offset offset{};
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) {
            const glm::dvec3 sample(before[column]);
            offset.value += 0.5 * powers[row] * kBasis[row][column] * sample;
            offset.slope += 0.5 * slopes[row] * kBasis[row][column] * intervals * sample;
        }
    }
    return offset;
}

// The frame of the guide with the greatest weight, at rest: its normals as a B-spline, made
// perpendicular to the strand.
inline glm::dmat3 frameAt(
    const groom::Groom& groom, std::uint32_t guide, std::uint32_t segment, double t,
    const glm::dvec3& tangent) {
    constexpr double kBasis[4][4] = {{-1, 3, -3, 1}, {3, -6, 3, 0}, {-3, 0, 3, 0}, {1, 4, 1, 0}};
    const double powers[4] = {t * t * t, t * t, t, 1.0};
    const glm::vec3 start(groom::across(groom::rootDirection(groom.strand(guide))));
    const std::vector<groom::StrandFrame> frames = groom::strandFrames(groom.strand(guide), &start);
    glm::dvec3 normal(0.0);
    for (int column = 0; column < 4; ++column) {
        const int index = std::clamp(
            static_cast<int>(segment) + column - 1, 0, static_cast<int>(frames.size()) - 1);
        for (int row = 0; row < 4; ++row)
            normal += powers[row] * kBasis[row][column] / 6.0 *
                      frames[static_cast<std::size_t>(index)].normal;
    }
    const glm::dvec3 along = glm::normalize(tangent);
    normal = glm::normalize(glm::cross(glm::cross(along, normal), along));
    return {normal, glm::cross(along, normal), along};
}

inline Point offsetPoint(
    const groom::Groom& groom, const Settings& settings, const rendering::StrandOffsets& offsets,
    std::uint32_t triangle, std::uint32_t strand, std::uint32_t segment, double t) {
    Point point = pointOnStrand(groom, settings, triangle, strand, segment, t);
    const auto w = weights(settings.seed, triangle, strand);
    const std::uint32_t guide =
        groom.root_triangles[triangle]
                            [static_cast<std::size_t>(std::ranges::max_element(w) - w.begin())];
    const std::uint32_t key = hash(settings.seed, triangle, gpu::kRootPurpose);
    const std::uint32_t profile = hash(key, strand, gpu::kOffsetPurpose) % offsets.profiles;
    const glm::dmat3 frame = frameAt(groom, guide, segment, t, point.tangent);
    const Offset offset = offsetAt(offsets, profile, point.along);
    point.position += frame * offset.value;
    point.tangent += frame * offset.slope / static_cast<double>(groom.segmentsPerStrand());
    return point;
}

}  // namespace hair::reference
