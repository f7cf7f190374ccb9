#pragma once

#include <span>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "hair/reference/constraints.h"

// The local constraint of `shape` as an energy, in double; simulation/constraints/bend.glsl has the
// equations. Here a substep is one dense system with two angles per joint, in the directions
// perpendicular to the axis of its torsion-free turn.
namespace hair::reference {

struct BendStep {
    // [vertex], root unused, both with air's part. `pushes`: free movement plus substep^2 times the
    // accelerations, m. `masses`: effective mass over the vertex's own.
    std::vector<glm::dvec3> pushes;
    std::vector<glm::dmat3> masses;
    // Push of air along the tangent at a vertex when the strand turns there, m.
    std::vector<glm::dvec3> turning_pushes;
    double stiffness = 0.0;  // substep^2 K
    double damping = 1.0;  // factor by which the stiffness is implicit
    glm::dmat3 frame{1.0};  // of the head at the substep's start
    glm::dvec3 turn{0.0};  // of the head during the substep, rad
    glm::dvec3 root{0.0};  // at the end of the substep, m
};

// Moves a strand. `rest` is in the groom's frame.
void bendStrand(Points positions, ConstPoints rest, const BendStep& step);

}  // namespace hair::reference
