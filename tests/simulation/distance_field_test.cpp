#include "engine/transfer.h"
#include "hair/simulation/bodies.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "hair/groom/mesh/import_mesh.h"
#include "tests/gpu_fixture.h"
#include "tests/largest_difference.h"
#include "tests/simulation/closed_meshes.h"
#include "tests/simulation/surface_reference.h"

namespace hair::simulation {
namespace {

// A distance takes some 20 roundings (of the grid point, the vector to a corner and its square) of
// numbers up to the grid's size plus its distance from the origin.
double roundingOf(double size) { return 20 * 0x1p-24 * size; }

double boxDistance(const glm::dvec3& p, const glm::dvec3& half) {
    const glm::dvec3 apart = glm::abs(p) - half;
    return glm::length(glm::max(apart, 0.0)) + std::min(std::max({apart.x, apart.y, apart.z}), 0.0);
}

class DistanceFieldTest : public GpuTest {
protected:
    // A field and its values.
    struct Baked {
        DistanceField field;
        double padding;
        std::vector<float> distances;

        Baked(const groom::Mesh& mesh, std::uint32_t resolution, float beyond)
            : field(device(), mesh, resolution, beyond), padding(double{beyond}),
              distances(engine::downloadAs<float>(device(), field.distances())) {}

        const gpu::DistanceField& grid() const { return field.parameters(); }

        glm::dvec3 position(std::size_t index) const {
            const glm::uvec3 points = grid().points;
            const glm::dvec3 point(
                index % points.x, index / points.x % points.y, index / points.x / points.y);
            return glm::dvec3(grid().origin) + double{grid().cell} * point;
        }

        // Distances are exact up to this one; farther outside they are lower bounds of at least
        // this.
        double exactTo() const { return padding + 2.0 * double{grid().cell}; }

        // Whether a grid point has its exact distance or, beyond the exact range, at most that
        // distance and at least the range.
        testing::AssertionResult tells(double found, double exact) const {
            const double rounding = roundingOf(size());
            const bool fits = exact <= exactTo()
                                  ? std::abs(found - exact) <= rounding
                                  : found <= exact + rounding && found >= exactTo() - rounding;
            if (fits) return testing::AssertionSuccess();
            return testing::AssertionFailure() << found << " for " << exact << ", exact to "
                                               << exactTo() << ", rounding " << rounding;
        }

        double size() const {
            return glm::length(glm::dvec3(grid().origin)) +
                   glm::distance(position(0), position(distances.size() - 1));
        }
    };

    static groom::Mesh head() {
        return groom::importMesh(std::string(HAIRBENCH_SCENES_DIR) + "/assets/head.glb");
    }

    // Calls check(position, distance) for `count` random grid points.
    template <class Check>
    static void atRandomPoints(const Baked& baked, int count, Check&& check) {
        std::mt19937 random(11);
        for (int i = 0; i < count && !testing::Test::HasFailure(); ++i) {
            const std::size_t index = random() % baked.distances.size();
            check(baked.position(index), double{baked.distances[index]});
        }
    }

    static void expectSigns(const groom::Mesh& mesh, std::uint32_t resolution, int count) {
        const Baked baked(mesh, resolution, 0.1f);
        int inside = 0;
        atRandomPoints(baked, count, [&](const glm::dvec3& p, double distance) {
            if (std::abs(distance) < roundingOf(baked.size())) return;  // on the surface
            const double winding = reference::windingNumber(mesh, p);
            EXPECT_EQ(distance < 0.0, winding > 0.5)
                << p.x << " " << p.y << " " << p.z << ": " << distance << ", " << winding;
            inside += distance < 0.0;
        });
        EXPECT_GT(inside, count / 50);
    }

    static void expectDistances(const groom::Mesh& mesh, const Baked& baked, int count) {
        atRandomPoints(baked, count, [&](const glm::dvec3& p, double distance) {
            const double exact = reference::distance(mesh, p);
            EXPECT_TRUE(baked.tells(distance, std::copysign(exact, distance)));
        });
    }
};

TEST_F(DistanceFieldTest, OfABoxIsExact) {
    const glm::dvec3 half{0.5, 0.25, 0.75};
    const Baked baked(makeBox(-half, half), 24, 0.3f);
    for (std::size_t i = 0; i < baked.distances.size(); ++i)
        ASSERT_TRUE(baked.tells(baked.distances[i], boxDistance(baked.position(i), half))) << i;
}

// The corners of the grid are 0.52 m from the box.
TEST_F(DistanceFieldTest, BeyondThePaddingIsALowerBoundThatIsOutside) {
    const groom::Mesh box = makeBox({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
    const Baked baked(box, 64, 0.3f);
    ASSERT_LT(baked.exactTo(), 0.5);
    std::size_t bounds = 0;
    for (std::size_t i = 0; i < baked.distances.size(); ++i) {
        const double exact = boxDistance(baked.position(i), glm::dvec3(0.5));
        ASSERT_TRUE(baked.tells(baked.distances[i], exact)) << i;
        bounds += baked.distances[i] < exact - roundingOf(baked.size());
    }
    EXPECT_GT(bounds, 0u);  // some distances were not computed
}

// The box lies where neighbouring floats are 1 / 16 mm apart.
TEST_F(DistanceFieldTest, OfABoxFarFromTheOriginIsAsExactAsFloats) {
    const glm::dvec3 half{0.5, 0.5, 0.5};
    const glm::dvec3 centre{1000.0, -1000.0, 500.0};
    const Baked baked(makeBox(centre - half, centre + half), 16, 0.25f);
    for (std::size_t i = 0; i < baked.distances.size(); ++i)
        ASSERT_TRUE(baked.tells(baked.distances[i], boxDistance(baked.position(i) - centre, half)));
}

// The sphere through the vertices contains the mesh, and the sphere that touches the planes of its
// triangles lies in the mesh. So distances lie between those to the two spheres.
TEST_F(DistanceFieldTest, OfASphereLiesBetweenThoseOfTheSpheresRoundAndInIt) {
    const glm::dvec3 centre{0.02, -0.01, 0.03};
    const groom::Mesh mesh = makeSphere(centre, 0.1, 3);
    Extremes planes;
    for (const auto& triangle : mesh.triangles) {
        const auto [a, b, c] = reference::corners(mesh, triangle);
        planes.add(glm::dot(glm::normalize(glm::cross(b - a, c - a)), a - centre));
    }
    const double inner = planes.least();
    const Baked baked(mesh, 33, 0.04f);
    const double rounding = roundingOf(baked.size());
    ASSERT_GT(inner, 0.0985);
    for (std::size_t i = 0; i < baked.distances.size(); ++i) {
        const double from_centre = glm::distance(baked.position(i), centre);
        ASSERT_GT(baked.distances[i], std::min(from_centre - 0.1, baked.exactTo()) - rounding);
        ASSERT_LT(baked.distances[i], from_centre - inner + rounding);
    }
}

TEST_F(DistanceFieldTest, SignIsThatOfTheWindingNumber) {
    expectSigns(makeTorus(1.0, 0.4, 36, 18), 40, 1500);
    expectSigns(makeLShape(), 41, 4000);
    expectSigns(makeStar(), 97, 8000);
    groom::Mesh hollow = makeSphere({0, 0, 0}, 1.0, 2);
    append(hollow, insideOut(makeSphere({0.1, 0, 0}, 0.6, 2)));
    expectSigns(hollow, 30, 2000);
}

TEST_F(DistanceFieldTest, DistanceIsThatToTheNearestTriangle) {
    for (const groom::Mesh& mesh : {makeTorus(1.0, 0.4, 36, 18), makeLShape(), makeStar()})
        expectDistances(mesh, Baked(mesh, 40, 0.2f), 500);
}

TEST_F(DistanceFieldTest, OfTheHeadHasTheNearestTrianglesDistanceAndTheWindingNumbersSign) {
    const groom::Mesh mesh = head();
    expectDistances(mesh, Baked(mesh, 48, 0.02f), 300);
    expectSigns(mesh, 48, 300);
}

TEST_F(DistanceFieldTest, OfTwoPartsIsThatOfTheNearerOne) {
    groom::Mesh mesh = makeBox({-2, -0.5, -0.5}, {-1, 0.5, 0.5});
    append(mesh, makeBox({0.5, -1, -1}, {2.5, 1, 1}));
    const Baked baked(mesh, 36, 0.25f);
    for (std::size_t i = 0; i < baked.distances.size(); ++i) {
        const glm::dvec3 p = baked.position(i);
        const double small = boxDistance(p - glm::dvec3(-1.5, 0, 0), glm::dvec3(0.5));
        const double large = boxDistance(p - glm::dvec3(1.5, 0, 0), glm::dvec3(1.0));
        ASSERT_TRUE(baked.tells(baked.distances[i], std::min(small, large)));
    }
}

// Sides of 1, 0.5 and 0.3 with a padding of 0.125 on either side make 10, 6 and 4.4 cells of 1/8.
TEST_F(DistanceFieldTest, GridIsAsFineAsAskedAndCoversThePadding) {
    const groom::Mesh mesh = makeBox({1, 2, 3}, {2, 2.5, 3.3});
    const DistanceField coarse(device(), mesh, 8, 0.125f);
    EXPECT_EQ(coarse.parameters().cell, 0.125f);
    EXPECT_EQ(coarse.parameters().cells_per_metre, 8.0f);
    EXPECT_EQ(coarse.parameters().points, glm::uvec3(11, 7, 6));
    EXPECT_EQ(coarse.parameters().origin.x, 0.875f);
    EXPECT_EQ(coarse.parameters().origin.y, 1.875f);
    EXPECT_NEAR(coarse.parameters().origin.z, 3.15 - 2.5 * 0.125, 0x1p-22);
    EXPECT_EQ(coarse.distances().size(), 4u * 11 * 7 * 6);
    const DistanceField fine(device(), mesh, 16, 0.125f);
    EXPECT_EQ(fine.parameters().cell, 0.0625f);
    EXPECT_EQ(fine.parameters().points, glm::uvec3(21, 13, 10));
    const DistanceField whole(device(), makeBox({0, 0, 0}, {1, 1, 1}), 1, 0.0f);
    EXPECT_EQ(whole.parameters().points, glm::uvec3(2, 2, 2));
}

TEST_F(DistanceFieldTest, RefusesAGridThatNoBufferHolds) {
    const groom::Mesh box = makeBox({0, 0, 0}, {1, 1, 1});
    EXPECT_THROW(DistanceField(device(), box, 100000, 0.0f), engine::Unsupported);
    EXPECT_THROW(DistanceField(device(), box, 0xffffffffu, 1e30f), engine::Unsupported);
}

}  // namespace
}  // namespace hair::simulation
