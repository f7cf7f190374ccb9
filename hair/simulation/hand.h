#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include <glm/vec3.hpp>

#include "hair/settings.h"

namespace hair {

// The hand of a pull in a time step.
struct Hand {
    glm::dvec3 position;  // at the step's end, m
    glm::dvec3 velocity;  // its mean over the step, m/s
};

// In the time step between two times, s; null where the hand does not pull: it pulls in the steps
// whose middle lies between its first and last key, which is most of every such step. So keys at
// multiples of the step mean what they say, however those are rounded. Before its first key and
// after its last the hand is where these are.
//
// The spring is implicit, and asks where the hand is when the step ends. It asks for the mean
// velocity, and not that of the path at one time, because a path may have keys much closer than
// steps, between which it is as fast as one likes.
std::optional<Hand> handIn(const PullSettings& pull, double from, double to);

// Throws Error for pulls (/simulation/pulls/N) at vertices that there are not, and for keys whose
// times don't ascend.
void checkPulls(
    std::span<const PullSettings> pulls, std::uint32_t guides, std::uint32_t vertices_per_guide);

}  // namespace hair
