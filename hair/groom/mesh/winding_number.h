#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/groom/mesh/surface.h"

namespace hair::groom {

// What triangles are from afar: moments of their areas about `centre`, with the normal n and the
// offset x from the centre. Of those of second and third rank only the symmetric part without
// traces counts.
struct Multipole {
    glm::dvec3 centre;  // mean of the triangles' centroids, weighed by area, m
    double radius;  // of the sphere round `centre` that holds the triangles, m
    glm::dvec3 dipole;  // integral of n, m^2
    std::array<double, 5> quadrupole;  // of n x: xx, yy, xy, xz, yz; zz = -xx - yy, m^3
    // Of n x x: xxx, yyy, zzz, xxy, xxz, yyx, yyz, zzx, zzy, xyz, m^4.
    std::array<double, 10> octupole;
};

// The generalised winding number of any triangles: the sum of their solid angles over 4 pi. Inside
// a closed surface it is 1, outside 0; where a surface is open it goes smoothly from one to the
// other through the opening, and across a triangle it jumps by 1. Jacobson et al. 2013, Robust
// inside-outside segmentation using generalized winding numbers, eq. 5.
//
// The triangles of a tree's node count as a multipole where its centre is farther away than kReach
// times its radius: Barill et al. 2018, Fast winding numbers for soups and clouds, with their three
// terms of the Taylor series and their kReach (there beta). What is left out of a node of the area
// A and the radius r at the distance d is at most A r^3 / (pi (d - r)^5) in sum: r^3 / 6 times the
// third derivatives of x / |x|^3, which are at most 24 / |x|^5.
class WindingNumber {
public:
    static constexpr double kReach = 2.0;

    // At least one triangle, none without area.
    WindingNumber(
        std::span<const glm::vec3> positions,
        std::span<const std::array<std::uint32_t, 3>> triangles);

    double operator()(const glm::dvec3& point, double reach = kReach) const;

    // What it is made of: a multipole for each node, and the corners of the leaves' triangles.
    const TriangleTree& tree() const { return tree_; }
    const std::vector<Multipole>& multipoles() const { return multipoles_; }
    const std::vector<std::array<glm::vec3, 3>>& corners() const { return corners_; }

private:
    TriangleTree tree_;
    std::vector<Multipole> multipoles_;  // [node]
    std::vector<std::array<glm::vec3, 3>> corners_;  // in the order of the leaves
};

}  // namespace hair::groom
