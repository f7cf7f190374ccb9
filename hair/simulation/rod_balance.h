#pragma once

#include <optional>
#include <vector>

#include <glm/ext/quaternion_double.hpp>
#include <glm/vec3.hpp>

// The inverse static problem of the rods of rod.comp: the rest shape that hangs as the groom does.
namespace hair::simulation {

// A rod that hangs under weights, in any consistent units. All is [vertex], root first; segment and
// joint i end and start in vertices i - 1 and i, so entry 0 is the follicle's, which has but an
// orientation.
struct HangingRod {
    std::vector<glm::dquat> orientations;  // of segments; the third axis is the tangent
    std::vector<glm::dvec3> edges;  // of segments
    std::vector<glm::dvec3> weights;  // on vertices
    std::vector<double> bend_stiffness;  // of joints, torque per angle
    std::vector<double> twist_stiffness;  // of joints, torque per angle
    double ellipticity = 1.0;  // of the section: gpu::RodParameters
};

struct BalancedRod {
    double stiffening;  // of all joints, >= 1
    std::vector<glm::dquat> half_rotations;  // at joints, of the rest shape
};

// The rest shape in which the rod is at rest as it hangs. A joint's torque is the moment of the
// weights below, and strain and rest rotation follow from that joint by joint, so there always is
// one where joints can bear the moment; but not every rest is stable. The least stiffening, to 5 %,
// is taken at which no joint bends by more than kMostBend under its moment and the rest is a
// minimum of the energy, also with all loads kLoadMargin times as great: the second variation along
// the rod is positive, as its elimination from the tip up shows. Absent where more than
// `most_stiffening` would be needed. Hsu et al. 2023, Sag-free initialization for strand-based
// hybrid hair simulation, solve for the same and stiffen too; rods whose segments neither stretch
// nor shear need no global solve.
std::optional<BalancedRod> balanceRod(const HangingRod& rod, double most_stiffening);

inline constexpr double kMostBend = 1.5;  // rad; half of it at the follicle
inline constexpr double kLoadMargin = 1.25;

}  // namespace hair::simulation
