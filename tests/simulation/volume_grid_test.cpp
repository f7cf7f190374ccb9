#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/gpu_fixture.h"
#include "tests/largest_difference.h"
#include "tests/simulation/volume_rig.h"

// The grid of hair on hair: its place, and what is summed up in it.
namespace hair::simulation {
namespace {

SimulationSettings withFriction() {
    SimulationSettings settings;
    settings.hair_hair = {.friction = 0.5f, .repulsion = 0.3f, .crowding = 1.0f, .resolution = 24};
    return settings;
}

TEST(VolumeGrid, HoldsWhateverHairCanReach) {
    const groom::Groom groom = wavyGroom(20, 9);
    for (const std::uint32_t resolution : {8u, 33u, 128u}) {
        const VolumeGrid grid = volumeGrid(groom, resolution);
        for (std::uint32_t s = 0; s < groom.strand_count; ++s)
            for (const glm::dvec3& direction :
                 {glm::dvec3(1, 0, 0), glm::dvec3(0, -1, 0), glm::dvec3(0, 0, 1)})
                for (const double sign : {-1.0, 1.0}) {
                    const glm::dvec3 tip =
                        glm::dvec3(groom.strand(s)[0]) + sign * longestStrand(groom) * direction;
                    const glm::dvec3 cells = (tip - grid.origin) / grid.cell;
                    for (int axis = 0; axis < 3; ++axis) {
                        EXPECT_GE(cells[axis], gpu::kVolumeMargin);
                        EXPECT_LE(cells[axis], resolution - gpu::kVolumeMargin);
                    }
                }
    }
}

TEST(VolumeGrid, SharesAreOfTheLength) {
    groom::Groom groom{.strand_count = 2, .vertices_per_strand = 3};
    groom.points = {{0, 0, 0}, {0, 1, 0}, {0, 1, 3}, {5, 0, 0}, {7, 0, 0}, {7, 0, 2}};
    const std::vector<double> expected{0.5 / 8, 2.0 / 8, 1.5 / 8, 1.0 / 8, 2.0 / 8, 1.0 / 8};
    const auto shares = lengthShares(groom);
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_DOUBLE_EQ(shares[i], expected[i]);

    groom.points.assign(6, glm::vec3(1.0f));
    for (const double share : lengthShares(groom)) EXPECT_DOUBLE_EQ(share, 1.0 / 6.0);
}

// All hair in the first grid's middle: on a corner of cells where they are even in number, else in
// the middle of one, and the other way round in the second grid. A quadratic B-spline gives a point
// on the face of two cells half to each, and one in the middle of a cell 3/4 to that and 1/8 to
// both of its neighbours.
TEST(VolumeGrid, MeanRestDensityIsThatOfAPoint) {
    const groom::Groom groom{
        .strand_count = 1, .vertices_per_strand = 2, .points = {glm::vec3(1.0f), glm::vec3(1.0f)}};
    const double on_corner = std::pow(2.0 * 0.25, 3.0);
    const double in_middle = std::pow(0.5625 + 2.0 / 64.0, 3.0);
    for (const std::uint32_t resolution : {8u, 9u})
        EXPECT_NEAR(
            meanRestDensity(groom, volumeGrid(groom, resolution)), 0.5 * (on_corner + in_middle),
            1e-12);
}

class GpuVolume : public GpuTest {
protected:
    struct Totals {
        double share = 0.0;
        glm::dvec3 momentum{0.0};
        glm::dvec3 moment{0.0};  // share times place, cells
    };

    // Of both, each of which has all of it.
    static std::array<Totals, gpu::kVolumeGrids> ofGrids(const VolumeRig& rig) {
        std::array<Totals, gpu::kVolumeGrids> all;
        const std::size_t side = rig.grid().resolution;
        const std::size_t cells = side * side * side;
        const auto sums = rig.sums();
        for (std::size_t i = 0; i < sums.size(); ++i) {
            const glm::dvec3 cell(i % side, i / side % side, i / side / side % side);
            Totals& totals = all[i / cells];
            totals.share += sums[i].share;
            totals.momentum += sums[i].momentum;
            const glm::dvec3 middle = cell + (i < cells ? 0.5 : 0.0);
            totals.moment += sums[i].share * middle;
        }
        return all;
    }
};

// B-splines sum to 1 and carry a point's place (their first moment), so the grid's totals are the
// vertices'. A vertex's part in each of 27 cells is rounded to a float, 6e-8 of it, and to 2^-30
// of the whole; places in cells, up to 24, are rounded to 24 * 6e-8 a few times.
TEST_F(GpuVolume, SumsUpShareAndMomentum) {
    const groom::Groom groom = wavyGroom(50, 9);
    const VolumeRig rig(device(), groom, withFriction());
    const auto positions = disturbed(groom, 0.01, 1);
    const auto previous = disturbed(groom, 0.01, 2);
    rig.accelerations(positions, previous);

    const auto shares = lengthShares(groom);
    const VolumeGrid grid = rig.grid();
    const double step = withFriction().time_step;
    Totals expected;
    Extremes speeds;
    for (std::size_t i = 0; i < shares.size(); ++i) {
        const glm::dvec3 now = positions[i];
        const glm::dvec3 velocity = (now - glm::dvec3(previous[i])) / step;
        const glm::dvec3 later = now + step * velocity;
        expected.share += shares[i];
        expected.momentum += shares[i] * velocity;
        expected.moment += shares[i] * (later - grid.origin) / grid.cell;
        speeds.add(glm::length(velocity));
    }
    const double rounding = 2e-7 + 27.0 * double(shares.size()) * 0x1p-31;
    for (const Totals& totals : ofGrids(rig)) {
        EXPECT_NEAR(totals.share, expected.share, rounding);
        EXPECT_NEAR(totals.share, 1.0, rounding);
        EXPECT_LT(
            glm::distance(totals.momentum, expected.momentum), 4.0 * rounding * speeds.greatest());
        EXPECT_LT(glm::distance(totals.moment, expected.moment), 24.0 * 4.0 * rounding);
    }
}

// The worst that can happen: all hair in one cell at the same, great speed.
TEST_F(GpuVolume, HoldsAllHairInOnePoint) {
    const groom::Groom groom = wavyGroom(2000, 33);
    const VolumeRig rig(device(), groom, withFriction());
    for (const float speed : {1e-3f, 1.0f, 1e6f}) {
        const glm::vec3 moved = glm::vec3(1.0f, -1.0f, 1.0f) * (speed / 60.0f);
        rig.accelerations(
            std::vector(groom.points.size(), glm::vec3(0.0f)),
            std::vector(groom.points.size(), -moved));
        // Now most of the error is that 2^-30 is 6e-5 of a vertex's share; half of it in each of up
        // to 27 cells.
        for (const Totals& totals : ofGrids(rig)) {
            EXPECT_NEAR(totals.share, 1.0, 1e-3);
            EXPECT_NEAR(totals.momentum.x / speed, 1.0, 1e-3);
            EXPECT_NEAR(totals.momentum.y / speed, -1.0, 1e-3);
        }
    }
}

// The grid is the head's: where head and hair are moved and turned, the same is summed up, but for
// the rounding of places, 1e-7 m of cells of 20 mm.
TEST_F(GpuVolume, MovesWithTheHead) {
    const groom::Groom groom = wavyGroom(50, 9);
    const VolumeRig rig(device(), groom, withFriction());
    const auto positions = disturbed(groom, 0.01, 1);
    const auto previous = disturbed(groom, 0.01, 2);
    const auto accelerations = rig.accelerations(positions, previous);
    const auto sums = rig.sums();

    const RigidMotion motion{
        .rotation = glm::angleAxis(1.0, glm::normalize(glm::dvec3(1.0, 2.0, -1.0))),
        .translation = {0.3, -0.2, 0.5}};
    const auto moved = [&](const std::vector<glm::vec3>& points) {
        std::vector<glm::vec3> result;
        for (const glm::vec3& point : points) result.emplace_back(motion(point));
        return result;
    };
    const auto turned = rig.accelerations(moved(positions), moved(previous), motion);
    const auto sums_there = rig.sums();
    Extremes sizes;
    for (const glm::vec3& a : accelerations) sizes.add(double{glm::length(a)});
    const double greatest = sizes.greatest();
    ASSERT_GT(greatest, 1.0);
    for (std::size_t i = 0; i < sums.size(); ++i)
        EXPECT_NEAR(sums[i].share, sums_there[i].share, 2e-7);
    for (std::size_t i = 0; i < turned.size(); ++i)
        EXPECT_LT(
            glm::distance(motion.rotation * glm::dvec3(accelerations[i]), glm::dvec3(turned[i])),
            1e-4 * greatest);
}

}  // namespace
}  // namespace hair::simulation
