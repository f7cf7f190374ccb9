#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/reference/constraints.h"
#include "hair/settings.h"
#include "hair/simulation/head_motion.h"

namespace hair::reference {

struct VolumeState {
    std::size_t vertices;                    // per strand
    std::span<const glm::dvec3> rest;        // [strand][vertex], m
    std::span<const glm::dvec3> positions;   // m
    std::span<const glm::dvec3> previous;    // m, a substep earlier
    Step step;
    simulation::RigidMotion frame;                       // of the head at the end of the step
    // Velocity difference of each vertex that friction left in the previous step, m/s; becomes
    // that of this step. Empty: no previous step. Null: not wanted.
    std::vector<glm::dvec3>* kept = nullptr;
};

// Returns the acceleration by hair-hair contact over the next step, [strand][vertex], m/s^2: the
// equations of hair/simulation/hair_hair.h on sparse grids in double precision. Zero if
// settings.hair_hair is off.
std::vector<glm::dvec3>
volumeAccelerations(const SimulationSettings& settings, const VolumeState& state);

}  // namespace hair::reference
