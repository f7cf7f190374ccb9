#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/groom/mesh/surface.h"

namespace hair::groom {

// Moments of triangles, to approximate them from afar: integrals over their areas with the normal n
// and the offset x from `centre`. Only the symmetric, traceless parts of the second and third rank
// count.
struct Multipole {
    glm::dvec3 centre;  // mean of the triangles' centroids, weighted by area, m
    double radius;  // of the sphere round `centre` that holds the triangles, m
    glm::dvec3 dipole;  // integral of n, m^2
    std::array<double, 5> quadrupole;  // of n x: xx, yy, xy, xz, yz; zz = -xx - yy, m^3
    // Moments of n x x: xxx, yyy, zzz, xxy, xxz, yyx, yyz, zzx, zzy, xyz, m^4.
    std::array<double, 10> octupole;
};

// The generalised winding number of any triangles: the sum of their solid angles over 4 pi. Inside
// a closed surface it is 1, outside 0. Through the opening of an open surface it changes smoothly
// from one to the other, and across a triangle it jumps by 1. Jacobson et al. 2013, Robust
// inside-outside segmentation using generalized winding numbers, eq. 5.
//
// A tree node counts as a multipole if its centre is farther away than kReach times its radius:
// Barill et al. 2018, Fast winding numbers for soups and clouds, with their three terms of the
// Taylor series and their kReach (there beta). The error of a node with the area A and the radius r
// at the distance d is at most A r^3 / (pi (d - r)^5) in sum: r^3 / 6 times the third derivatives
// of x / |x|^3, which are at most 24 / |x|^5.
class WindingNumber {
public:
    static constexpr double kReach = 2.0;

    // Needs at least one triangle, and none without area.
    WindingNumber(
        std::span<const glm::vec3> positions,
        std::span<const std::array<std::uint32_t, 3>> triangles);

    double operator()(const glm::dvec3& point, double reach = kReach) const;

    // The data of the evaluation: a multipole for each node, and the corners of the leaves'
    // triangles.
    const TriangleBvh& tree() const { return tree_; }
    const std::vector<Multipole>& multipoles() const { return multipoles_; }
    const std::vector<std::array<glm::vec3, 3>>& corners() const { return corners_; }

private:
    TriangleBvh tree_;
    std::vector<Multipole> multipoles_;  // [node]
    std::vector<std::array<glm::vec3, 3>> corners_;  // in the order of the leaves
};

}  // namespace hair::groom
