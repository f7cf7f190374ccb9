#include "hair/groom/style/followers.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "engine/error.h"
#include "hair/groom/style/strand_edits.h"
#include "hair/groom/style/strand_frames.h"
#include "hair/random.h"

namespace hair {
namespace {

// A random point of the disc across the strand's direction at the root, uniform in area.
glm::dvec3 randomInDisc(
    std::span<const glm::vec3> points, double radius, std::uint32_t follower, std::uint32_t seed) {
    const glm::dvec3 direction = rootDirection(points);
    const glm::dvec3 u = across(direction);
    const glm::dvec3 v = glm::cross(direction, u);
    const double angle = 2.0 * std::numbers::pi * random01(seed, follower, purpose::follower_angle);
    const double distance =
        radius * std::sqrt(double{random01(seed, follower, purpose::follower_radius)});
    return distance * (std::cos(angle) * u + std::sin(angle) * v);
}

}  // namespace

StrandSet addFollowers(
    const StrandSet& strands, std::uint32_t count, float radius, float tip_separation,
    std::uint32_t seed) {
    if (count == 0) return strands;
    const std::uint64_t times = std::uint64_t{count} + 1;
    const std::uint64_t points = strands.points.size() * times;
    if (points > 0xffff'ffffu)
        throw engine::Error(
            std::to_string(count) + " followers for each strand make " + std::to_string(points) +
            " points, more than 2^32 - 1");

    std::vector<std::uint32_t> sources;
    sources.reserve(strands.strandCount() * times);
    for (std::uint32_t strand = 0; strand < strands.strandCount(); ++strand)
        sources.insert(sources.end(), times, strand);
    StrandSet all = pickStrands(strands, sources);
    for (std::uint32_t i = 0; i < all.strandCount(); ++i) {
        if (i % times == 0) continue;
        const glm::dvec3 offset = randomInDisc(strands.strand(sources[i]), radius, i, seed);
        for (std::uint32_t k = 0; k < all.size(i); ++k) {
            const double share = k == 0 ? 0.0 : double(k) / (all.size(i) - 1);
            glm::vec3& point = all.points[all.first(i) + k];
            point = glm::vec3(
                glm::dvec3(point) + std::lerp(1.0, double{tip_separation}, share) * offset);
        }
    }
    all.root_triangles = strands.root_triangles;
    for (auto& triangle : all.root_triangles)
        for (std::uint32_t& corner : triangle) corner *= static_cast<std::uint32_t>(times);
    return all;
}

}  // namespace hair
