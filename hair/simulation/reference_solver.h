#pragma once

#include <cstddef>
#include <functional>
#include <memory>

#include "hair/groom/groom.h"
#include "hair/settings.h"
#include "hair/simulation/reference_constraints.h"
#include "hair/simulation/reference_factors.h"
#include "hair/simulation/rigid_motion.h"

namespace hair::reference {

// One strand in one substep.
struct Substep {
    std::size_t strand = 0;
    Points positions;
    Points previous;  // becomes the positions before the substep, or what the solver makes of them
    ConstPoints rest;  // where the groom was made, m
    ConstPoints accelerations;  // of gravity and air, m/s^2
    RigidMotion frame;  // of the head at the substep's end
    // Where a vertex comes to lie that the substep has moved from `before` to `position`.
    std::function<glm::dvec3(const glm::dvec3& position, const glm::dvec3& before)> push_out;
};

// What moves the strands of a Reference: GuideSolver's counterpart.
class Solver {
public:
    virtual ~Solver() = default;

    virtual void step(const Substep& substep) = 0;

    // Derives the state of its own from positions and previous positions that someone else wrote.
    // Accelerations and push_out are empty.
    virtual void adopt(const Substep&) {}
};

// The settings' solver; null where nothing moves: `none` without keyframes.
std::unique_ptr<Solver>
makeSolver(const Groom& groom, const SimulationSettings& settings, const Step& step);

}  // namespace hair::reference
