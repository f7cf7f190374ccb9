#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "hair/reference/constraints.h"
#include "tests/simulation/strands.h"

// Tests the reference of `ftl` against the paper.
namespace hair::simulation {
namespace {

reference::VertexContact untouched(const glm::dvec3& position, const glm::dvec3&) {
    return {.position = position};
}

struct Strand {
    std::vector<glm::dvec3> rest;
    std::vector<glm::dvec3> positions = rest;
    std::vector<glm::dvec3> previous = rest;

    void step(const glm::dvec3& acceleration, double h, double correction) {
        const std::vector accelerations(rest.size(), acceleration);
        reference::stepFtl(
            positions, previous, rest,
            {.accelerations = accelerations, .substep = h, .velocity_correction = correction},
            untouched);
    }
};

Strand horizontal(int segments) {
    Strand strand;
    for (int i = 0; i <= segments; ++i) strand.rest.emplace_back(i, 0.0, 0.0);
    strand.positions = strand.previous = strand.rest;
    return strand;
}

void expectNear(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
    EXPECT_LT(glm::distance(a, b), tolerance)
        << a.x << ' ' << a.y << ' ' << a.z << " against " << b.x << ' ' << b.y << ' ' << b.z;
}

// Two segments of 1 m fall for 1 s at 1 m/s^2; the values are worked out by hand. The predictions
// are (1, -1) and (2, -1). The first vertex goes to (1, -1) / sqrt 2. The second goes 1 m from
// there toward (2, -1), a correction of d_2 = (-0.317606, 0.071951). By eq. 9 the first vertex's
// velocity is (-0.292893, -0.707107) - 0.9 d_2.
TEST(ReferenceFtl, TakesTheStepThatHandTakes) {
    Strand strand = horizontal(2);
    strand.step({0.0, -1.0, 0.0}, 1.0, 0.9);
    const double r = std::sqrt(0.5);
    expectNear(strand.positions[1], {r, -r, 0.0}, 1e-12);
    expectNear(strand.positions[2], {1.68239364336, -0.92804916388, 0.0}, 1e-10);
    expectNear(
        strand.positions[1] - strand.previous[1], {-0.00704749784, -0.77186253370, 0.0}, 1e-10);
    expectNear(
        strand.positions[2] - strand.previous[2], {-0.31760635664, -0.92804916388, 0.0}, 1e-10);
}

TEST(ReferenceFtl, KeepsEveryLengthInOnePass) {
    std::mt19937 random(4);
    Strand strand = horizontal(20);
    for (int i = 0; i < 50; ++i) {
        strand.step(30.0 * randomVector(random), 1.0 / 60.0, 0.9);
        for (std::size_t v = 1; v < strand.positions.size(); ++v)
            ASSERT_NEAR(glm::distance(strand.positions[v], strand.positions[v - 1]), 1.0, 1e-12);
    }
    EXPECT_EQ(strand.positions[0], strand.rest[0]);
}

// One segment is a simple pendulum: from release to the lowest point it takes a quarter of 2 pi
// sqrt(l / g). With 2,000 steps a second the crossing is found within half a step, 0.25 ms. The
// amplitude of 0.05 makes the period 0.016 % longer.
TEST(ReferenceFtl, SwingsAsAPendulum) {
    Strand strand{.rest = {{0, 0, 0}, {0, -1, 0}}};
    strand.positions[1] = strand.previous[1] = {std::sin(0.05), -std::cos(0.05), 0.0};
    const double h = 1.0 / 2000.0;
    int steps = 0;
    while (strand.positions[1].x > 0.0 && steps < 4000) {
        strand.step({0.0, -9.8, 0.0}, h, 0.9);
        ++steps;
    }
    const double quarter = 0.5 * std::numbers::pi * std::sqrt(1.0 / 9.8);
    EXPECT_NEAR(steps * h, quarter, 0.0005 + 0.0002 * quarter);
}

TEST(ReferenceFtl, PartsVerticesThatCoincide) {
    Strand strand = horizontal(1);
    strand.positions[1] = strand.previous[1] = strand.rest[0];
    strand.step(glm::dvec3(0.0), 0.01, 0.9);
    EXPECT_EQ(strand.positions[1], glm::dvec3(0.0, 1.0, 0.0));
}

}  // namespace
}  // namespace hair::simulation
