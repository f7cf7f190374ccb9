#include "engine/transfer.h"
#include "hair/simulation/bodies.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hair/groom/mesh/import_mesh.h"
#include "tests/error_text.h"
#include "tests/gpu_fixture.h"
#include "tests/largest_difference.h"
#include "tests/simulation/closed_meshes.h"
#include "tests/simulation/surface_reference.h"

// Tests distance fields of meshes that are not closed.
namespace hair::simulation {
namespace {

class OpenFieldTest : public GpuTest {
protected:
    // A field and its values.
    struct Baked {
        DistanceField field;
        std::vector<float> distances;

        Baked(const groom::BodyMesh& mesh, std::uint32_t resolution, float padding)
            : field(device(), mesh, resolution, padding),
              distances(engine::downloadAs<float>(device(), field.distances())) {}

        double cell() const { return double{field.parameters().cell}; }
        glm::uvec3 points() const { return field.parameters().points; }

        glm::dvec3 position(std::size_t i) const {
            const glm::uvec3 n = points();
            return glm::dvec3(field.parameters().origin) +
                   cell() * glm::dvec3(i % n.x, i / n.x % n.y, i / n.x / n.y);
        }
    };

    // Some twenty roundings of numbers of one or two metres.
    static constexpr double kRounding = 40 * 0x1p-24;
};

// A mesh without a rim that doesn't cut itself has the same nearest triangles and sides as an open
// mesh and as a closed one. Distances are equal to the bit, except at points on the surface.
TEST_F(OpenFieldTest, OfAClosedMeshIsWhatItIsAsAClosedOne) {
    groom::Mesh hollow = makeSphere({0, 0, 0}, 1.0, 2);
    append(hollow, insideOut(makeSphere({0.1, 0, 0}, 0.6, 2)));
    for (const groom::Mesh& mesh :
         {hollow, makeTorus(1.0, 0.4, 36, 18), makeLShape(), makeStar(),
          groom::importMesh(std::string(HAIRBENCH_SCENES_DIR) + "/assets/head.glb")}) {
        const Baked closed(groom::closeMesh(mesh), 28, 0.02f);
        const Baked open(groom::openMesh(mesh), 28, 0.02f);
        ASSERT_EQ(closed.distances.size(), open.distances.size());
        std::size_t inside = 0;
        for (std::size_t i = 0; i < closed.distances.size(); ++i) {
            const double expected = double{closed.distances[i]};
            if (std::abs(expected) < kRounding) {
                ASSERT_NEAR(open.distances[i], expected, 2 * kRounding);
            } else {
                ASSERT_EQ(open.distances[i], closed.distances[i]) << i;
            }
            inside += expected < 0.0;
        }
        EXPECT_GT(inside, 100u);
    }
}

double boxDistanceTo(const glm::dvec3& p, const glm::dvec3& half) {
    const glm::dvec3 apart = glm::abs(p) - half;
    return glm::length(glm::max(apart, 0.0)) + std::min(std::max({apart.x, apart.y, apart.z}), 0.0);
}

// The opening is seen as half a sphere only from its own plane, so the cap is flat, and the field
// is that of the closed box. The cap's vertices are found to half of 1/256 of an edge, which is at
// most a cell's diagonal. Within a cell of the rim the cap cuts the corner between opening and
// sides, which changes distances up to a few cells from the rim.
TEST_F(OpenFieldTest, OfABoxWithoutAFaceIsThatOfTheBox) {
    const glm::dvec3 half{0.5, 0.31, 0.73};
    groom::Mesh mesh = makeBox(-half, half);
    mesh.triangles.resize(10);  // z = 0.73 is open
    const Baked baked(groom::bodyMesh(mesh), 43, 0.11f);
    const double exact_to = 0.11 + 2 * baked.cell();
    const double found_to = std::sqrt(3.0) * baked.cell() / 512 + kRounding;
    Extremes near, far;
    for (std::size_t i = 0; i < baked.distances.size(); ++i) {
        const glm::dvec3 p = baked.position(i);
        const double expected = boxDistanceTo(p, half);
        if (expected > exact_to) {
            ASSERT_GT(baked.distances[i], exact_to - kRounding);
            continue;
        }
        const double error = std::abs(double{baked.distances[i]} - expected);
        const glm::dvec3 apart = glm::abs(p) - half;
        const double from_rim = std::hypot(p.z - half.z, std::max(apart.x, apart.y));  // or nearer
        (from_rim < 4 * baked.cell() + std::abs(expected) ? near : far).add(error);
    }
    EXPECT_LT(near.greatest(), baked.cell());
    EXPECT_LT(far.greatest(), found_to);
}

// Between neighbouring points distances change by no more than a cell, plus the error of a cell at
// either end beside the rim. Distances to the mesh alone would change by the opening's width, 15
// cells.
TEST_F(OpenFieldTest, DoesNotJumpAtAnOpening) {
    const Baked baked(groom::bodyMesh(makeOpenSphere({0, 0, 0}, 1.0, 2.0, 48, 24)), 33, 0.1f);
    const double exact_to = 0.1 + 2 * baked.cell();
    const glm::uvec3 n = baked.points();
    Extremes steps;
    for (std::size_t i = 0; i < baked.distances.size(); ++i) {
        const std::size_t x = i % n.x, y = i / n.x % n.y, z = i / n.x / n.y;
        for (const std::size_t next :
             {x + 1 < n.x ? i + 1 : i, y + 1 < n.y ? i + n.x : i,
              z + 1 < n.z ? i + std::size_t{n.x} * n.y : i}) {
            const double a = double{baked.distances[i]}, b = double{baked.distances[next]};
            if (std::max(a, b) < exact_to) steps.add(std::abs(a - b));
        }
    }
    EXPECT_LT(steps.greatest(), 3 * baked.cell());
}

// Compares with the sum over all triangles, except where that is nearly 1/2.
TEST_F(OpenFieldTest, SignIsThatOfTheWindingNumber) {
    groom::Mesh winged = makeSphere({0, 0, 0}, 1.0, 3);
    const auto corners = reference::corners(winged, winged.triangles[100]);
    addTriangle(winged, corners[0], corners[1], 1.5 * (corners[0] + corners[1]) / 2.0);
    groom::Mesh crossing = makeOpenSphere({0, 0, 0}, 1.0, 2.4, 40, 20);
    append(crossing, makeOpenSphere({0.3, 0.9, 0.2}, 0.6, 2.6, 30, 15));
    for (const groom::Mesh& mesh :
         {makeOpenSphere({0, 0, 0}, 1.0, 2.0, 40, 20), makeOpenSphere({0, 0, 0}, 1.0, 1.2, 40, 20),
          winged, crossing}) {
        const Baked baked(groom::bodyMesh(mesh), 30, 0.1f);
        std::size_t inside = 0, asked = 0;
        for (std::size_t i = 0; i < baked.distances.size(); i += 23) {
            const glm::dvec3 p = baked.position(i);
            const double winding = reference::windingNumber(mesh, p);
            if (std::abs(winding - 0.5) < 0.01) continue;
            ASSERT_EQ(baked.distances[i] < 0.0f, winding > 0.5)
                << p.x << " " << p.y << " " << p.z << ": " << winding;
            inside += winding > 0.5;
            ++asked;
        }
        EXPECT_GT(inside, asked / 20);
    }
}

// Outside the ball the sheet counts as it is. Inside it is behind the ball's surface.
TEST_F(OpenFieldTest, DistanceIsThatToASheetToo) {
    groom::Mesh mesh = makeSphere({0, 0, 0}, 1.0, 2);
    const auto corners = reference::corners(mesh, mesh.triangles[100]);
    addTriangle(mesh, corners[0], corners[1], 1.5 * (corners[0] + corners[1]) / 2.0);
    const Baked baked(groom::bodyMesh(mesh), 24, 0.1f);
    EXPECT_THAT(baked.field.warning(), testing::HasSubstr("more than two triangles: 1,"));
    const double exact_to = 0.1 + 2 * baked.cell();
    for (std::size_t i = 0; i < baked.distances.size(); i += 5) {
        const double expected = reference::distance(mesh, baked.position(i));
        if (baked.distances[i] < exact_to) {
            ASSERT_NEAR(std::abs(baked.distances[i]), expected, kRounding);
        } else {
            ASSERT_LE(baked.distances[i], expected + kRounding);
        }
    }
}

// Two balls cross; triangles of either inside the other bound nothing. A ball of 20 * 4^4 triangles
// is up to kBallChord smaller than the sphere round it. A strip of crossed triangles remains,
// kStrip deep.
TEST_F(OpenFieldTest, OfBallsThatCrossIsThatOfBoth) {
    const glm::dvec3 other{0.9, 0, 0};
    constexpr double kBallEdge = 1.2 * 1.107 / 16;
    constexpr double kBallChord = kBallEdge * kBallEdge / 6;
    constexpr double kStrip = 2 * kBallEdge;
    groom::Mesh mesh = makeSphere({0, 0, 0}, 1.0, 4);
    append(mesh, makeSphere(other, 1.0, 4));
    const Baked baked(groom::bodyMesh(mesh), 32, 0.1f);
    const double across = std::sqrt(1 - 0.45 * 0.45);  // the radius of the circle where they meet
    const double exact_to = 0.1 + 2 * baked.cell();
    std::size_t deep = 0;
    for (std::size_t i = 0; i < baked.distances.size(); ++i) {
        const glm::dvec3 p = baked.position(i);
        const double found = double{baked.distances[i]};
        const double outside =
            std::min(glm::length(p), glm::distance(p, other)) - 1.0;  // less inside
        if (outside > 0.0) {
            if (outside < exact_to - kBallChord) {
                ASSERT_NEAR(found, outside, kBallChord + kRounding);
            }
            continue;
        }
        if (outside > -kBallChord) continue;
        ASSERT_LT(found, 0.0);
        // Nearest of the remaining parts of both spheres and the circle where they meet.
        const double ring = std::hypot(p.x - 0.45, std::hypot(p.y, p.z) - across);
        const auto depthIn = [&](const glm::dvec3& centre, double side) {
            const glm::dvec3 to = p - centre;
            const double length = glm::length(to);
            const bool seen = side * (to.x / length - side * 0.45) <=
                              0.0;  // the nearest point of the sphere belongs to the surface
            return seen && length > 1e-9 ? 1.0 - length : 10.0;
        };
        const double depth = std::min({ring, depthIn({0, 0, 0}, 1), depthIn(other, -1)});
        ASSERT_LT(-found, depth + kBallChord + kRounding);
        ASSERT_GT(-found, std::min(depth, ring - kStrip) - kBallChord - kRounding);
        deep += glm::length(p) < 0.9 && glm::distance(p, other) < 0.9;
    }
    EXPECT_GT(deep, 300u);
}

// A sheet with a bulge thinner than any cell.
TEST_F(OpenFieldTest, RefusesWhatNoPointOfTheGridIsIn) {
    const groom::Mesh dish = makeOpenSphere({0, 0, 0}, 1.0, 0.1, 40, 4);
    EXPECT_THAT(
        errorText([&] { DistanceField(device(), dish, 8, 0.1f); }),
        testing::AllOf(
            testing::HasSubstr("no point of the grid is inside the surface: the winding number"),
            testing::HasSubstr("raise /resolution")));
}

}  // namespace
}  // namespace hair::simulation
