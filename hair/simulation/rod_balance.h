#pragma once

#include <optional>
#include <vector>

#include <glm/ext/quaternion_double.hpp>
#include <glm/vec3.hpp>

// Inverse statics of the rods of rod.comp: the rest shape with which a rod hangs as in the groom.
namespace hair::simulation {

// A rod that hangs under weights, in any consistent units. All arrays are [vertex], root first.
// Segment i and joint i end and start in vertices i - 1 and i. Entry 0 is the follicle, which has
// only an orientation.
struct HangingRod {
    std::vector<glm::dquat> orientations;  // of segments; the third axis is the tangent
    std::vector<glm::dvec3> edges;  // of segments
    std::vector<glm::dvec3> weights;  // on vertices
    std::vector<double> bend_stiffness;  // of joints, torque per angle
    std::vector<double> twist_stiffness;  // of joints, torque per angle
    double ellipticity = 1.0;  // of the section: gpu::RodParameters
};

struct BalancedRod {
    double stiffening;  // factor of all joints, >= 1
    std::vector<glm::dquat> half_rotations;  // at joints, for the rest shape
};

// Returns the rest shape with which the rod is at rest as it hangs. A joint's torque is the moment
// of the weights below it; strain and rest rotation follow joint by joint. So a solution exists
// whenever the joints can bear the moment, but not every equilibrium is stable. Takes the least
// stiffening, to 5 %, for which no joint bends by more than kMostBend under its moment and the
// equilibrium is an energy minimum, also with all loads kLoadMargin times as large: the second
// variation along the rod must be positive, which its elimination from the tip up shows. Absent if
// more than `most_stiffening` would be needed. Hsu et al. 2023, Sag-free initialization for
// strand-based hybrid hair simulation, solve the same problem and stiffen too. Rods with segments
// that neither stretch nor shear need no global solve.
std::optional<BalancedRod> balanceRod(const HangingRod& rod, double most_stiffening);

inline constexpr double kMostBend = 1.5;  // rad; half as much at the follicle
inline constexpr double kLoadMargin = 1.25;

}  // namespace hair::simulation
