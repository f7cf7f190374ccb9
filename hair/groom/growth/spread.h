#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace hair {

// Picks `count` of the candidates, far from each other and from the fixed points. The candidates
// are uniform over a surface of `area` m^2 and the fixed points lie on its boundary. Returns
// indices in ascending order. Time and memory grow with the number of candidates.
// Yuksel 2015, Sample elimination for generating Poisson disk sample sets.
std::vector<std::uint32_t> spread(
    std::span<const glm::vec3> candidates, std::span<const glm::vec3> fixed, std::uint32_t count,
    double area);

}  // namespace hair
