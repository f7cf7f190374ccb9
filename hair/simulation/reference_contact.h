#pragma once

#include <span>

#include "hair/settings.h"
#include "hair/simulation/reference_constraints.h"
#include "hair/simulation/rigid_motion.h"

namespace hair::reference {

// Contact of one vertex with every capsule, one after the other, each in the frame that it moves
// with: what slides on it is the motion relative to it.
struct Contact {
    const SimulationSettings& settings;
    RigidMotion frame;         // of the head at the end of the substep
    RigidMotion frame_before;  // and at its start

    // Where the vertex comes to lie that has moved from `before` to `position`.
    glm::dvec3 operator()(glm::dvec3 position, const glm::dvec3& before) const {
        for (const Collider& collider : settings.colliders) {
            const bool on_head = collider.follows == Follows::head;
            const RigidMotion now = on_head ? frame : RigidMotion{};
            const RigidMotion then = on_head ? frame_before : RigidMotion{};
            // pushOut leaves the root alone, so the vertex is a strand's second.
            glm::dvec3 here[2] = {glm::dvec3(0.0), seenFrom(now, position)};
            const glm::dvec3 there[2] = {glm::dvec3(0.0), seenFrom(then, before)};
            const glm::dvec3 free = here[1];
            pushOut(here, there, std::span(&collider, 1), settings.collision);
            if (here[1] != free) position = now(here[1]);
        }
        return position;
    }

    static glm::dvec3 seenFrom(const RigidMotion& motion, const glm::dvec3& point) {
        return glm::conjugate(motion.rotation) * (point - motion.translation);
    }
};

}  // namespace hair::reference
