#pragma once

#include <cstdint>
#include <span>

#include <glm/vec3.hpp>

#include "hair/settings.h"

// The offsets that are made and not taken from a model. All add to `samples`, evenly spaced from
// the root to the tip of a strand of `length` m, and leave the first alone; `profile` is a number
// that the random ones come from.
namespace hair {

// A helix of a random phase and frequency.
void addCurl(
    const StrandCurlSettings& settings, double length, std::uint32_t seed, std::uint32_t profile,
    std::span<glm::vec3> samples);

// Smooth noise: a random vector of at most the amplitude at every change of direction.
void addVariation(
    const StrandVariationSettings& settings, double length, std::uint32_t seed,
    std::uint32_t profile, std::span<glm::vec3> samples);

}  // namespace hair
