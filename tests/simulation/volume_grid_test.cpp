#include <array>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "tests/gpu_fixture.h"
#include "tests/largest_difference.h"
#include "tests/simulation/volume_rig.h"

// Tests the grid of hair-hair contact: its position and its sums.
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

// All hair is in the first grid's centre. That is a corner of cells if their number is even and
// else the centre of a cell; in the second grid it is the other way round. A quadratic B-spline
// gives a point on the face of two cells half to each, and a point in the middle of a cell 3/4 to
// that cell and 1/8 to both of its neighbours.
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

    // Returns the totals of both grids. Each grid holds all the hair.
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

// B-splines sum to 1 and preserve a point's position (their first moment), so the grid's totals are
// the vertices'. A vertex's part in each of 27 cells is rounded to a float, 6e-8 of it, and to a
// multiple of 2^-31 of the whole at most. Positions in cells, up to 24, are rounded to 24 * 6e-8 a
// few times.
TEST_F(GpuVolume, SumsUpShareAndMomentum) {
    const groom::Groom groom = wavyGroom(50, 9);
    VolumeRig rig(device(), groom, withFriction());
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
    const double rounding = 2e-7 + 27.0 * double(shares.size()) * 0x1p-32;
    for (const Totals& totals : ofGrids(rig)) {
        EXPECT_NEAR(totals.share, expected.share, rounding);
        EXPECT_NEAR(totals.share, 1.0, rounding);
        EXPECT_LT(
            glm::distance(totals.momentum, expected.momentum), 4.0 * rounding * speeds.greatest());
        EXPECT_LT(glm::distance(totals.moment, expected.moment), 24.0 * 4.0 * rounding);
    }
}

// For a block of cells with the share M and the greatest speed V, fixed point rounds a part of a
// vertex by up to 2^-32 M and its momentum by 2^-31 M V (hair_hair.h). This happens in each of 27
// cells. Besides, a weight and a product are floats.
double lostShare(double vertices) { return 27.0 * vertices * 0x1p-32 + 3e-7; }
double lostMomentum(double vertices) { return 27.0 * vertices * 0x1p-31 + 3e-7; }

// Worst case: all hair in one cell at the same, great speed.
TEST_F(GpuVolume, HoldsAllHairInOnePoint) {
    const groom::Groom groom = wavyGroom(2000, 33);
    VolumeRig rig(device(), groom, withFriction());
    for (const float speed : {1e-3f, 1.0f, 1e6f}) {
        const glm::vec3 moved = glm::vec3(1.0f, -1.0f, 1.0f) * (speed / 60.0f);
        rig.accelerations(
            std::vector(groom.points.size(), glm::vec3(0.0f)),
            std::vector(groom.points.size(), -moved));
        const double vertices = groom.points.size();
        for (const Totals& totals : ofGrids(rig)) {
            EXPECT_NEAR(totals.share, 1.0, lostShare(vertices));
            EXPECT_NEAR(totals.momentum.x / speed, 1.0, lostMomentum(vertices));
            EXPECT_NEAR(totals.momentum.y / speed, -1.0, lostMomentum(vertices));
        }
    }
}

// The greatest possible sum: hair in the middle of a cell, which then has (3/4)^3 of it, with share
// and speed just below a power of two. Two of 2^17 equal shares are elsewhere. Positions of 1e-4 m
// are rounded to 4e-12 m, 2e-7 of the hair's motion.
TEST_F(GpuVolume, HoldsTheGreatestSumThereIs) {
    groom::Groom groom{.strand_count = 1 << 16, .vertices_per_strand = 2};
    groom.points.assign(std::size_t{2} << 16, glm::vec3(0.0f));
    SimulationSettings settings = withFriction();
    settings.time_step = 0x1p-6f;
    settings.substeps = 1;
    VolumeRig rig(device(), groom, settings);
    const VolumeGrid grid = rig.grid();
    const std::size_t side = grid.resolution;
    const glm::vec3 middle(grid.origin + (double(side / 2) + 0.5) * grid.cell);
    for (const float moved : {-0.99999f * 0x1p-16f, 0.99999f * 0x1p-16f}) {
        // The sums use the hair's positions at the end of the step.
        std::vector positions(groom.points.size(), middle - moved);
        std::vector previous(groom.points.size(), middle - 2.0f * moved);
        const auto elsewhere = static_cast<float>(8.0 * grid.cell);
        for (std::size_t i = positions.size() - 2; i < positions.size(); ++i) {
            positions[i].x -= elsewhere;
            previous[i].x -= elsewhere;
        }
        rig.accelerations(positions, previous);
        const auto sums = rig.sums();
        const auto& sum = sums[((side / 2) * side + side / 2) * side + side / 2];
        const double vertices = groom.points.size();
        const double share = 27.0 / 64.0 * (1.0 - 0x1p-16);
        EXPECT_NEAR(sum.share, share, vertices * 0x1p-32 + 1e-6);
        const double speed = double{moved} * 64.0;
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(sum.momentum[axis] / speed, share, vertices * 0x1p-31 + 1e-6);
    }
}

// There are 10^5 vertices in about a cell at 1 mm/s, and one strand at 10 m/s far away. With a
// single fixed point for all, a slow vertex would have 10^-4 10^-5 2^30 units, and its part in a
// cell would round to 0.
TEST_F(GpuVolume, KeepsSlowMomentumBesideFastHair) {
    constexpr std::uint32_t kSlow = 50000;  // strands
    groom::Groom groom{.strand_count = kSlow + 1, .vertices_per_strand = 2};
    for (std::uint32_t s = 0; s <= kSlow; ++s) {
        const glm::vec3 root(s < kSlow ? 0.0f : 1.0f, 0.0f, 0.0f);
        groom.points.push_back(root);
        groom.points.push_back(root - glm::vec3(0.0f, 0.02f, 0.0f));
    }
    VolumeRig rig(device(), groom, withFriction());
    const VolumeGrid grid = rig.grid();
    std::mt19937 random(5);
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> previous;
    const double share = 0.5 / (kSlow + 1);
    const double step = withFriction().time_step;
    glm::dvec3 expected(0.0);
    Extremes speeds;
    for (std::size_t i = 0; i < groom.points.size(); ++i) {
        const bool is_slow = i < 2 * kSlow;
        const glm::dvec3 place = double{groom.points[i].x} * glm::dvec3(1.0, 0.0, 0.0);
        const glm::dvec3 speed =
            is_slow ? 1e-3 * glm::dvec3(1.0, -1.0, 0.5) : glm::dvec3(0.0, 10.0, 0.0);
        positions.emplace_back(place + 0.4 * grid.cell * randomVector(random));
        previous.emplace_back(glm::dvec3(positions.back()) - step * speed);
        if (!is_slow) continue;
        const glm::dvec3 velocity =
            (glm::dvec3(positions.back()) - glm::dvec3(previous.back())) / step;
        expected += share * velocity;
        for (int axis = 0; axis < 3; ++axis) speeds.add(std::abs(velocity[axis]));
    }
    rig.accelerations(positions, previous);

    const auto sums = rig.sums();
    const std::size_t side = grid.resolution;
    std::array<glm::dvec3, gpu::kVolumeGrids> slow{};
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const double x = grid.origin.x + grid.cell * (double(i % side) + 0.5);
        if (x < 0.5) slow[i / side / side / side] += sums[i].momentum;
    }
    for (const glm::dvec3& momentum : slow)
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(
                momentum[axis], expected[axis], lostMomentum(2.0 * kSlow) * speeds.greatest());
}

// The grid moves with the head. If head and hair are moved and turned, the sums are the same,
// except for the rounding of positions, 1e-7 m in cells of 20 mm.
TEST_F(GpuVolume, MovesWithTheHead) {
    const groom::Groom groom = wavyGroom(50, 9);
    VolumeRig rig(device(), groom, withFriction());
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
