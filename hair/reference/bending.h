#pragma once

#include <span>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "hair/reference/constraints.h"

// The local constraint of `shape` as an energy, in double: simulation/constraints/bend.glsl has the
// equations. Here a substep is one dense system of the joints' angles, two at each, in the
// directions across the axis of its torsion-free turn.
namespace hair::reference {

struct BendStep {
    // Of the vertices, [vertex], root unused: substep^2 times the accelerations, what a vertex
    // would move by without any and what air adds to both, m; and the mass over its own.
    std::vector<glm::dvec3> pushes;
    std::vector<glm::dmat3> masses;
    // What air pulls with along the tangent at a vertex when the strand turns there, m.
    std::vector<glm::dvec3> turning_pushes;
    double stiffness = 0.0;  // substep^2 K
    double damping = 1.0;  // times the stiffness is implicit
    glm::dmat3 frame{1.0};  // of the head at the substep's start
    glm::dvec3 turn{0.0};  // of the head in the substep, rad
    glm::dvec3 root{0.0};  // at its end, m
};

// Moves a strand. `rest` is where the groom was made.
void bendStrand(Points positions, ConstPoints rest, const BendStep& step);

}  // namespace hair::reference
