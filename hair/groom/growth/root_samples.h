#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/groom/growth/scalp.h"
#include "hair/random.h"

namespace hair {

// Points picked at random, uniform in area, each known by its number.
struct RootSamples {
    std::vector<std::uint32_t> numbers;
    std::vector<glm::vec3> positions;  // m
};

inline SurfacePoint rootSample(const Scalp& scalp, std::uint32_t seed, std::uint32_t number) {
    return sampleSurface(
        scalp, {random01(seed, number, purpose::root_triangle),
                random01(seed, number, purpose::root_u), random01(seed, number, purpose::root_v)});
}

// The first `count` samples that are accepted, or fewer if `tries` run out.
template <class Accept>
RootSamples takeSamples(
    const Scalp& scalp, std::uint32_t seed, std::uint32_t count, std::uint64_t tries,
    Accept&& accept) {
    RootSamples samples;
    samples.numbers.reserve(count);
    samples.positions.reserve(count);
    for (std::uint32_t i = 0; i < tries && samples.numbers.size() < count; ++i) {
        const SurfacePoint sample = rootSample(scalp, seed, i);
        if (!accept(i, sample)) continue;
        samples.numbers.push_back(i);
        samples.positions.push_back(sample.position);
    }
    return samples;
}

}  // namespace hair
