#include "hair/groom/style/smooth_noise.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "hair/groom/style/along_strand.h"
#include "hair/random.h"

namespace hair {
namespace {

// A random point of a cube, drawn in along its ray.
glm::dvec3 randomInBall(std::uint32_t seed, std::uint32_t purpose, std::uint32_t index) {
    glm::dvec3 point;
    for (std::uint32_t axis = 0; axis < 3; ++axis)
        point[static_cast<int>(axis)] = 2.0 * random01(seed, index, purpose + axis) - 1.0;
    const double length = glm::length(point);
    if (length == 0.0) return point;
    return point * (std::max({std::abs(point.x), std::abs(point.y), std::abs(point.z)}) / length);
}

}  // namespace

glm::dvec3 smoothNoise(std::uint32_t seed, std::uint32_t purpose, double x) {
    const double whole = std::floor(x);
    const auto index = static_cast<std::uint32_t>(std::fmod(whole, 4294967296.0));
    return glm::mix(
        randomInBall(seed, purpose, index), randomInBall(seed, purpose, index + 1),
        ease(0.0, 1.0, x - whole));
}

}  // namespace hair
