#pragma once

#include <cstdint>

#include <glm/vec3.hpp>

namespace hair {

// Value noise of vectors: a random point of the unit ball at every whole number, eased between, so
// always within the ball. `purpose` and the two after it are its purposes of random numbers.
glm::dvec3 smoothNoise(std::uint32_t seed, std::uint32_t purpose, double x);

}  // namespace hair
