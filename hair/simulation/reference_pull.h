#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/settings.h"

// What hands do to hair, in double and straight from the equations of pull_pass.h.
namespace hair::reference {

// Every strand at the start of a time step, [strand][vertex], m.
struct PulledHair {
    std::size_t vertices = 0;  // per strand
    std::span<const glm::dvec3> rest;
    std::span<const glm::dvec3> positions;
    std::span<const glm::dvec3> previous;
    double substep = 0.0;  // s
    double from = 0.0;     // of the time step, s
    double to = 0.0;
};

// Adds what the settings' hands give to accelerations that have all else, gravity too, m/s^2.
void addPulls(
    std::span<const PullSettings> pulls, const PulledHair& hair,
    std::span<glm::dvec3> accelerations);

}  // namespace hair::reference
