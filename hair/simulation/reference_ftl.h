#pragma once

#include <functional>

#include "hair/simulation/reference_constraints.h"

namespace hair::reference {

// Where a vertex comes to lie that has moved from `before` to `position`.
using PushOut = std::function<glm::dvec3(const glm::dvec3& position, const glm::dvec3& before)>;

struct FtlStep {
    ConstPoints accelerations;  // m/s^2
    double substep = 0.0;       // s
    double velocity_kept = 1.0;
    double global_stiffness = 0.0;
    double velocity_correction = 0.0;  // s_damping of eq. 9
};

// One substep of follow the leader for one strand: Mueller, Kim and Chentanez 2012, Fast simulation
// of inextensible hair and fur, section 3. `rest` is the rest strand where the head is now, and
// positions[0] is taken from it. `previous` becomes positions less substep times velocity, with
// eq. 9's velocities.
void stepFtl(
    Points positions, Points previous, ConstPoints rest, const FtlStep& step,
    const PushOut& push_out);

}  // namespace hair::reference
