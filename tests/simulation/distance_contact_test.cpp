#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "engine/transfer.h"
#include "tests/gpu_fixture.h"
#include "tests/largest_difference.h"
#include "tests/simulation/closed_meshes.h"
#include "tests/simulation/distance_probe.h"
#include "tests/simulation/strands.h"

// Tests how shaders sample a distance field: shaders/simulation/constraints/distance_field.glsl.
namespace hair::simulation {
namespace {

const glm::dvec3 kCentre{0.02, -0.01, 0.03};
constexpr double kRadius = 0.1;

// A mesh of 20 * 4^5 triangles lies in the sphere by up to edge^2 / (6 r), which makes distances
// larger. No edge is longer than 1.2 times the mean edge, which is the icosahedron's 1.107 rad over
// 2^5.
constexpr double kEdge = 1.2 * 1.107 / 32 * kRadius;
constexpr double kChord = kEdge * kEdge / (6 * kRadius);

// Some ten roundings of numbers up to 1 m and of up to 32 cells.
constexpr double kRounding = 10 * 0x1p-24;

class DistanceContactTest : public GpuTest {
protected:
    static DistanceField sphere(std::uint32_t resolution, float padding) {
        return {device(), makeSphere(kCentre, kRadius, 5), resolution, padding};
    }

    // A box from -1 to 1 with a padding of 1/4 and cells of 1/4, so that its faces lie on grid
    // points.
    static DistanceField box() { return {device(), makeBox({-1, -1, -1}, {1, 1, 1}), 8, 0.25f}; }

    static glm::dvec3 pushed(
        const DistanceField& field, const glm::vec3& position, const glm::vec3& before = {},
        const Contact& contact = {}) {
        return probe(device(), field, position, before, contact).pushed;
    }

    // Returns `count` positions in the grid's box, enlarged by `beyond` times its size on all
    // sides.
    static std::vector<gpu::DistanceProbe>
    randomProbes(const DistanceField& field, int count, double beyond) {
        const gpu::DistanceField& grid = field.parameters();
        const glm::dvec3 size = double{grid.cell} * glm::dvec3(grid.points - 1u);
        std::mt19937 random(3);
        std::vector<gpu::DistanceProbe> probes(static_cast<std::size_t>(count));
        for (gpu::DistanceProbe& probe : probes) {
            const glm::dvec3 where = 0.5 + (0.5 + beyond) * randomVector(random);
            probe.position = glm::vec3(glm::dvec3(grid.origin) + where * size);
        }
        return probes;
    }
};

void expectNear(const glm::dvec3& point, const glm::dvec3& expected) {
    EXPECT_LT(glm::distance(point, expected), kRounding)
        << point.x << " " << point.y << " " << point.z;
}

// Along one axis, the interpolant of f is off by at most h^2 / 8 max |f''|. Interpolation along the
// next axes does not enlarge errors, so that each axis adds h^2 / 8. Along any axis the distance to
// the centre, r, has second derivatives between 0 and 1 / r, so the interpolant is never below it.
// Corners of a cell are exact up to the padding plus two cells; farther corners have a value of at
// least that. So the interpolant is right if no corner of the cell, whose diagonal is sqrt(3)
// cells, is farther. Otherwise it is at least the exact range less this diagonal.
TEST_F(DistanceContactTest, SampledSphereIsOffByTheCurvatureAtMost) {
    for (const std::uint32_t resolution : {8u, 16u, 32u}) {
        const DistanceField field = sphere(resolution, 0.02f);
        const double cell = double{field.parameters().cell};
        const double exact_to = 0.02 + (2.0 - std::sqrt(3.0)) * cell - kChord;
        Extremes errors;
        for (const auto& probe : probe(device(), field, randomProbes(field, 20000, 0.0))) {
            const double from_centre = glm::distance(glm::dvec3(probe.position), kCentre);
            const double nearest = from_centre - std::sqrt(3.0) * cell;  // bound for the cell
            if (nearest <= 0.0) continue;
            const double error = double{probe.distance} - (from_centre - kRadius);
            if (from_centre - kRadius <= exact_to) {
                ASSERT_GT(error, -kRounding);
            } else {
                ASSERT_GT(probe.distance, exact_to - kRounding);
            }
            ASSERT_LT(error, 3 * cell * cell / 8 / nearest + kChord + kRounding);
            if (from_centre > 0.9 * kRadius) errors.add(error);
        }
        // The bound is nearly reached: in the middle of a cell two axes have the second derivative
        // 1 / r.
        EXPECT_GT(errors.greatest(), cell * cell / 8 / kRadius);
    }
}

// Returns the same interpolant, computed in double precision as a sum over all grid points.
double interpolate(
    const gpu::DistanceField& grid, const std::vector<float>& distances, const glm::dvec3& p) {
    const glm::dvec3 scaled = (p - glm::dvec3(grid.origin)) / double{grid.cell};
    const glm::dvec3 inside = glm::clamp(scaled, glm::dvec3(0), glm::dvec3(grid.points - 1u));
    double sum = 0.0;
    for (unsigned z = 0; z < grid.points.z; ++z) {
        for (unsigned y = 0; y < grid.points.y; ++y) {
            for (unsigned x = 0; x < grid.points.x; ++x) {
                const glm::dvec3 weights =
                    glm::max(1.0 - glm::abs(inside - glm::dvec3(x, y, z)), 0.0);
                const double weight = weights.x * weights.y * weights.z;
                if (weight > 0.0)
                    sum += weight * double{distances[x + grid.points.x * (y + grid.points.y * z)]};
            }
        }
    }
    return sum + glm::distance(scaled, inside) * double{grid.cell};
}

// In a cell the interpolant is linear along each axis, so differences are exact except for
// rounding. Beyond the grid their error is step^2 / 6 times the third derivative of the distance to
// the grid, which is at most 1 / gap^2. No differences are taken near the grid's planes, where the
// gradient jumps.
TEST_F(DistanceContactTest, ValueAndGradientAreThoseOfTheInterpolant) {
    const DistanceField field = sphere(10, 0.03f);
    const auto distances = engine::downloadAs<float>(device(), field.distances());
    const gpu::DistanceField& grid = field.parameters();
    constexpr double kStep = 1e-5;
    // The position in the cell is known to a few roundings of 0.2 m. The slopes change by up to
    // sqrt(2) / cell per metre in each direction.
    const double slope_rounding = 4 * 0x1p-24 * 0.2 * 4 / double{grid.cell} + 1e-6;
    int beyond = 0;
    for (const auto& probe : probe(device(), field, randomProbes(field, 1500, 0.2))) {
        const glm::dvec3 p(probe.position);
        ASSERT_NEAR(probe.distance, interpolate(grid, distances, p), kRounding);
        const glm::dvec3 scaled = (p - glm::dvec3(grid.origin)) / double{grid.cell};
        const glm::dvec3 from_plane = glm::abs(scaled - glm::round(scaled)) * double{grid.cell};
        if (std::min({from_plane.x, from_plane.y, from_plane.z}) < 2 * kStep) continue;
        const glm::dvec3 last(grid.points - 1u);
        const double gap =
            glm::distance(scaled, glm::clamp(scaled, glm::dvec3(0), last)) * double{grid.cell};
        const double curvature = gap > 0.0 ? kStep * kStep / (gap * gap) : 0.0;
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 step(0.0);
            step[axis] = kStep;
            const double slope =
                (interpolate(grid, distances, p + step) - interpolate(grid, distances, p - step)) /
                (2 * kStep);
            ASSERT_NEAR(probe.gradient[axis], slope, slope_rounding + curvature) << gap;
        }
        beyond += gap > 0.0;
    }
    EXPECT_GT(beyond, 300);
}

// Every point on or beyond the outer side of the padding is at least the padding away.
TEST_F(DistanceContactTest, NothingBeyondTheGridTouches) {
    const DistanceField field = sphere(16, 0.02f);
    const gpu::DistanceField& grid = field.parameters();
    const glm::vec3 upper = grid.origin + grid.cell * glm::vec3(grid.points - 1u);
    for (const auto& probe :
         probe(device(), field, randomProbes(field, 5000, 3.0), {.margin = 0.0199f})) {
        const glm::vec3 p = probe.position;
        if (glm::all(glm::greaterThan(p, grid.origin)) && glm::all(glm::lessThan(p, upper)))
            continue;
        ASSERT_GT(probe.distance, 0.02 - kRounding);
        ASSERT_EQ(probe.pushed, p);
    }
    // Far away the value is the distance to the sphere, except for the size of the grid.
    const auto far = probe(device(), field, {1000.0f, 0.0f, 0.0f});
    EXPECT_NEAR(far.distance, 1000.0f, 0.4f);
    EXPECT_NEAR(far.gradient.x, 1.0f, 1e-3f);
}

// The points lie in a cell nearest to the top face of the box.
TEST_F(DistanceContactTest, PushesOutToTheMarginAlongTheGradient) {
    const DistanceField field = box();
    expectNear(pushed(field, {0.125f, 0.875f, 0.25f}), {0.125, 1, 0.25});
    expectNear(pushed(field, {0.125f, 0.875f, 0.25f}, {}, {.margin = 0.1f}), {0.125, 1.1, 0.25});
    expectNear(pushed(field, {0.125f, 1.0625f, 0.25f}, {}, {.margin = 0.1f}), {0.125, 1.1, 0.25});
    const glm::vec3 outside{0.125f, 1.125f, 0.25f};
    EXPECT_EQ(pushed(field, outside, {}, {.margin = 0.1f}), glm::dvec3(outside));
}

// The point is 0.25 deep and has moved 0.2 along the face. A friction coefficient of 0.5 takes back
// 0.125 of that; 0.8 and more take back all of it, and never more.
TEST_F(DistanceContactTest, TakesBackWhatFrictionHolds) {
    const DistanceField field = box();
    const glm::vec3 inside{0.125f, 0.75f, 0.25f};
    const glm::vec3 before{0.125f, 1.0f, 0.05f};
    expectNear(pushed(field, inside, before, {.friction = 0.0f}), {0.125, 1, 0.25});
    expectNear(pushed(field, inside, before, {.friction = 0.5f}), {0.125, 1, 0.125});
    expectNear(pushed(field, inside, before, {.friction = 1.0f}), {0.125, 1, 0.05});
    expectNear(pushed(field, inside, before, {.friction = 9.0f}), {0.125, 1, 0.05});
}

// With five cells, the box's centre is the centre of a cell, and all corners of that cell are 0.8
// deep.
TEST_F(DistanceContactTest, LeavesThroughTheTopWhereNoWayIsShortest) {
    const DistanceField field(device(), makeBox({-1, -1, -1}, {1, 1, 1}), 5, 0.0f);
    const auto middle = probe(device(), field, {0, 0, 0}, {}, {.margin = 0.1f});
    EXPECT_NEAR(middle.distance, -0.8, kRounding);
    expectNear(middle.pushed, {0, 0.9, 0});
}

// The sampled distance is too large by the interpolation error. The sampled slope along each axis
// is a difference between two grid points, half a cell from here. So it is off by cell / 2 times
// the second derivatives, at most 1 / r each and 2 / r together, and the gradient is tilted by less
// than t = cell / r. A move by d with this tilt ends d t^2 / 2 too low and (d t)^2 / (2 r) too
// high.
TEST_F(DistanceContactTest, OnePushBringsAPointOfASphereToTheMargin) {
    constexpr double kMargin = 0.005;
    const DistanceField field = sphere(32, 0.02f);
    const double cell = double{field.parameters().cell};
    int inside = 0;
    for (const auto& probe : probe(
             device(), field, randomProbes(field, 5000, 0.0),
             {.margin = static_cast<float>(kMargin)})) {
        const double from_centre = glm::distance(glm::dvec3(probe.position), kCentre);
        if (from_centre < 0.5 * kRadius || from_centre > kRadius) continue;
        const double nearest = from_centre - std::sqrt(3.0) * cell;  // lower bound for the cell
        const double interpolation = 3 * cell * cell / 8 / nearest + kChord;
        const double depth = kRadius + kMargin - from_centre;
        const double tilt = cell / nearest;
        const double outside = glm::distance(glm::dvec3(probe.pushed), kCentre) - kRadius;
        EXPECT_GT(outside, kMargin - interpolation - depth * tilt * tilt / 2 - kRounding);
        EXPECT_LT(outside, kMargin + depth * depth * tilt * tilt / (2 * nearest) + kRounding);
        ++inside;
    }
    EXPECT_GT(inside, 1000);
}

}  // namespace
}  // namespace hair::simulation
