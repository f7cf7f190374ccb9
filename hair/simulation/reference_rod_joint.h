#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

// What bends and twists a rod of reference_rod.h.
namespace hair::reference {

// Of a joint between two frames that coincide at rest, in the axes of space.
struct Joint {
    double energy;          // J
    glm::dvec3 torque;      // on the second frame, N m; the first gets its opposite
    glm::dmat3 stiffness;  // torque per rotation of the second against the first, N m/rad
};

// A clamp is half of the joint between the second frame and its mirror image in the first.
enum class Clamp { no, yes };

// Bending by an angle b between the third axes costs -4 K ln cos(b / 2), a torque of 2 K tan(b /
// 2): the discrete elastica of Bobenko and Suris 1999, Discrete time Lagrangian mechanics on Lie
// groups, which is integrable as the smooth one is, and which few segments suffice for. Beyond 120
// degrees the torque goes on as a straight line. A clamp has half of the energy at twice the angle,
// the stiffnesses being those at the single angle. Twisting by t round the axis that is left after
// the smallest rotation between the third axes costs K t^2 / 2, which fades where the axes are more
// than 120 degrees apart: there is no such rotation between opposite ones.
Joint bendAndTwist(
    const glm::dquat& first, const glm::dquat& second, double bend_stiffness,
    double twist_stiffness, Clamp clamp);

// The smallest rotation between unit vectors; between opposite ones, round an axis perpendicular to
// the first and to the coordinate axis it has least of.
glm::dquat rotationBetween(const glm::dvec3& from, const glm::dvec3& to);

// The rotation that done twice is `rotation`, of unit length, the short way round.
glm::dquat halfOf(const glm::dquat& rotation);

}  // namespace hair::reference
