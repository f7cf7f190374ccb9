#include "hair/groom/mesh/winding_number.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "tests/largest_difference.h"
#include "tests/simulation/closed_meshes.h"
#include "tests/simulation/strands.h"
#include "tests/simulation/surface_reference.h"

namespace hair::simulation {
namespace {

using groom::WindingNumber;
using std::numbers::pi;

// Reach with which every triangle is summed by itself.
constexpr double kNoMultipoles = std::numeric_limits<double>::infinity();

// Some hundred roundings of angles up to 2 pi.
constexpr double kAngleRounding = 1e-13;

WindingNumber windingOf(const groom::Mesh& mesh) {
    const groom::JoinedMesh joined = groom::joinMesh(mesh);
    return {joined.positions, joined.triangles};
}

// Returns the solid angle over 4 pi, seen from p, of the rectangle from lower to upper in the plane
// z = 0, with the sign of p.z. Each corner's part follows Gotoh and Yagi 1971, Solid angle
// subtended by a rectangular slit: atan(x y / (z sqrt(x^2 + y^2 + z^2))).
double rectangleTurns(const glm::dvec2& lower, const glm::dvec2& upper, const glm::dvec3& p) {
    const auto part = [&](double x, double y) {
        x -= p.x, y -= p.y;
        return std::atan(x * y / (p.z * std::sqrt(x * x + y * y + p.z * p.z)));
    };
    return (part(upper.x, upper.y) - part(lower.x, upper.y) - part(upper.x, lower.y) +
            part(lower.x, lower.y)) /
           (4 * pi);
}

// A box from z = -2 to 0 without its upper face. The winding number differs from 1 inside and from
// 0 outside by the solid angle of that face over 4 pi.
TEST(WindingNumber, OfACubeWithoutAFaceIsWhatTheFaceLeaves) {
    groom::Mesh mesh = makeBox({-1, -1, -2}, {1, 1, 0});
    mesh.triangles.resize(10);  // z = 0 is the last
    const WindingNumber winding = windingOf(mesh);
    std::mt19937 random(5);
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 p = 3.0 * randomVector(random);
        const bool inside = std::max(std::abs(p.x), std::abs(p.y)) < 1 && p.z < 0 && p.z > -2;
        const double expected = (inside ? 1.0 : 0.0) + rectangleTurns({-1, -1}, {1, 1}, p);
        ASSERT_NEAR(winding(p, kNoMultipoles), expected, kAngleRounding);
    }
}

// The hole is a regular polygon of n corners with the circumradius r. Seen from its axis at the
// distance z, its solid angle is 2 pi - 2 n atan(tan(pi / n) / sqrt(1 + r^2 / z^2)), from n
// pyramids whose edges at the apex have the angles pi / n and two of pi / 2. A disc has 2 pi (1 - z
// / sqrt(z^2 + r^2)).
TEST(WindingNumber, OfASphereWithAHoleIsWhatTheHoleLeaves) {
    constexpr int kAround = 24;
    constexpr double kOpening = 2.0;
    const WindingNumber winding = windingOf(makeOpenSphere({0, 0, 0}, 1.0, kOpening, kAround, 20));
    const double radius = std::sin(kOpening);
    for (double y = -2.975; y < 3.0; y += 0.05) {
        const double z = y - std::cos(kOpening);
        const double hole =
            2 * pi -
            2 * kAround *
                std::atan(std::tan(pi / kAround) / std::sqrt(1 + radius * radius / (z * z)));
        // Above the hole's plane, the hole subtracts its part, from 1 inside the sphere and from 0
        // above it. Below the plane it adds its part.
        const double expected = z > 0 ? (y < 1 ? 1 : 0) - hole / (4 * pi) : hole / (4 * pi);
        // Vertices are floats, and the hole's radius is 0.9.
        EXPECT_NEAR(winding({0, y, 0}, kNoMultipoles), expected, 0x1p-24) << y;
        const double disc = 2 * pi * (1 - std::abs(z) / std::sqrt(z * z + radius * radius));
        EXPECT_NEAR(disc, hole, 2 * pi * pi * pi / 3 / (kAround * kAround));
    }
}

// In the plane of a triangle its own solid angle is 0.
TEST(WindingNumber, OnATriangleIsTheMeanOfBothSides) {
    groom::Mesh mesh = makeBox({-1, -1, -2}, {1, 1, 0});
    EXPECT_NEAR(windingOf(mesh)({0.3, 0.2, 0}), 0.5, kAngleRounding);
    mesh.triangles.resize(10);
    EXPECT_NEAR(windingOf(mesh)({0.3, 0.2, 0}), 0.5, kAngleRounding);
}

// Returns the bound of winding_number.h, summed over the nodes that are taken as multipoles.
double boundOf(const WindingNumber& winding, const glm::dvec3& p, std::uint32_t node) {
    const groom::TriangleBvh::Node& box = winding.tree().nodes[node];
    const groom::Multipole& moments = winding.multipoles()[node];
    const double distance = glm::distance(moments.centre, p);
    const double radius = moments.radius;
    if (distance > WindingNumber::kReach * radius) {
        double area = 0.0;
        const auto add = [&](const auto& self, std::uint32_t index) -> void {
            const groom::TriangleBvh::Node& below = winding.tree().nodes[index];
            for (std::uint32_t i = below.first; i < below.first + below.count; ++i) {
                const auto& [a, b, c] = winding.corners()[i];
                area += glm::length(glm::cross(glm::dvec3(b - a), glm::dvec3(c - a))) / 2;
            }
            if (below.count > 0) return;
            self(self, below.first);
            self(self, below.first + 1);
        };
        add(add, node);
        return area * std::pow(radius, 3) / (pi * std::pow(distance - radius, 5));
    }
    if (box.count > 0) return 0.0;
    return boundOf(winding, p, box.first) + boundOf(winding, p, box.first + 1);
}

// For a single node the error falls with the fourth power of the reach, and for nodes of all sizes
// with its third. So twice the reach divides it by eight or more.
TEST(WindingNumber, MultipolesAreAsExactAsTheirBound) {
    for (const groom::Mesh& mesh :
         {makeOpenSphere({0.2, 0, 0}, 1.0, 2.3, 60, 40), makeTorus(1.0, 0.4, 60, 30), makeStar()}) {
        const WindingNumber winding = windingOf(mesh);
        std::mt19937 random(9);
        Extremes errors, finer, shares;
        for (int i = 0; i < 400; ++i) {
            const glm::dvec3 p = 1.6 * randomVector(random);
            const double exact = reference::windingNumber(mesh, p);
            const double error = std::abs(winding(p) - exact);
            const double bound = boundOf(winding, p, 0) + kAngleRounding;
            ASSERT_LE(error, bound);
            errors.add(error);
            shares.add(error / bound);
            finer.add(std::abs(winding(p, 2 * WindingNumber::kReach) - exact));
        }
        EXPECT_LT(errors.greatest(), 0.01);
        EXPECT_LT(finer.greatest(), errors.greatest() / 8 + kAngleRounding);
    }
}

// Far away, a triangle is fully described by its moments about the centre: the error relative to
// its dipole falls with the third power of the distance.
TEST(WindingNumber, ATriangleFromAfarIsItsMoments) {
    groom::Mesh mesh;
    addTriangle(mesh, {0, 0, 0}, {1, 0.2, 0}, {0.1, 0.7, 0.3});
    const WindingNumber winding = windingOf(mesh);
    const groom::Multipole& moments = winding.multipoles().front();
    const glm::dvec3 way = glm::normalize(glm::dvec3(0.5, -0.4, 0.8));
    const auto relative = [&](double distance) {
        const glm::dvec3 p = moments.centre + distance * way;
        return std::abs(winding(p) - winding(p, kNoMultipoles)) /
               (glm::length(moments.dipole) / (4 * pi * distance * distance));
    };
    EXPECT_GT(relative(4), 1e-5);  // large enough to see it fall
    EXPECT_NEAR(relative(16) / relative(8), 1.0 / 8, 0.05);
}

}  // namespace
}  // namespace hair::simulation
