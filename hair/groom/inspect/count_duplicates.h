#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include <glm/vec3.hpp>

namespace hair {

// How many of `count` rows of points are equal to one before them. Takes 16 bytes for each.
std::uint32_t countDuplicates(
    std::uint32_t count, const std::function<std::span<const glm::vec3>(std::uint32_t)>& row);

}  // namespace hair
