#include <cmath>
#include <functional>
#include <random>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include "hair/reference/wind.h"
#include "tests/largest_difference.h"
#include "tests/simulation/strands.h"

namespace hair::simulation {
namespace {

using reference::curlNoise;
using reference::turbulence;

// Returns points in cells without common corners, so that noise is independent between points.
std::vector<glm::dvec3> apart(int side) {
    std::vector<glm::dvec3> points;
    std::mt19937 random(3);
    for (int x = 0; x < side; ++x)
        for (int y = 0; y < side; ++y)
            for (int z = 0; z < side; ++z)
                points.push_back(
                    3.0 * glm::dvec3(x - side / 2, y, z) + 0.5 + 0.5 * randomVector(random));
    return points;
}

double
meanSquare(const std::vector<glm::dvec3>& points, const std::function<glm::dvec3(glm::dvec3)>& f) {
    double sum = 0.0;
    for (const glm::dvec3& point : points) sum += glm::dot(f(point), f(point)) / 3.0;
    return sum / static_cast<double>(points.size());
}

// Rows: derivatives by x, y, z.
glm::dmat3 derivatives(const glm::dvec3& point) {
    constexpr double kStep = 1e-5;
    glm::dmat3 result;
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 step{0.0};
        step[axis] = kStep;
        result[axis] = (reference::turbulence(point + step, 3, 1) -
                        reference::turbulence(point - step, 3, 1)) /
                       (2.0 * kStep);
    }
    return result;
}

// The error of a central difference is step^2 / 6 = 2e-11 times a third derivative of some
// thousands. Across a cell's face it is step / 4 times the jump of the second derivative, some
// hundreds. Values above 1e-6 are left out (1 in 5,000 points and component).
TEST(Turbulence, HasNoSourcesButEddies) {
    Extremes sources;
    double vorticity = 0.0;
    int straddling = 0;
    const auto points = apart(12);
    for (const glm::dvec3& point : points) {
        const glm::dmat3 d = derivatives(point);
        const double divergence = std::abs(d[0].x + d[1].y + d[2].z);
        if (divergence > 1e-6)
            ++straddling;
        else
            sources.add(divergence);
        const glm::dvec3 curl{d[1].z - d[2].y, d[2].x - d[0].z, d[0].y - d[1].x};
        vorticity += glm::dot(curl, curl) / static_cast<double>(points.size());
    }
    EXPECT_LT(straddling, 6);
    EXPECT_LT(sources.greatest(), 1e-6);
    EXPECT_GT(std::sqrt(vorticity), 1.0);  // eddies of size 1 and less with velocities of 1
}

// For n independent samples of variance 1 the mean is within 4 / sqrt n, and the mean square is
// within 4 sqrt(2 / n), as are the products of two components. (The fourth moment exceeds a normal
// distribution's at most by the variance's own variation over a cell, some 10 %.)
TEST(Turbulence, HasMeanZeroAndUnitVariance) {
    const auto points = apart(24);
    const auto count = static_cast<double>(points.size());
    for (const std::uint32_t octaves : {1u, 3u, 8u}) {
        glm::dvec3 mean{0.0};
        glm::dmat3 products{0.0};
        for (const glm::dvec3& point : points) {
            const glm::dvec3 w = reference::turbulence(point, octaves, 5);
            mean += w / count;
            products += glm::outerProduct(w, w) / count;
        }
        for (int i = 0; i < 3; ++i) {
            EXPECT_NEAR(mean[i], 0.0, 4.0 / std::sqrt(count)) << octaves;
            for (int j = 0; j < 3; ++j)
                EXPECT_NEAR(products[i][j], i == j ? 1.0 : 0.0, 4.5 * std::sqrt(2.0 / count))
                    << octaves;
        }
    }
}

// Compares velocity and its derivative on both sides of cells' faces.
TEST(Turbulence, IsSmooth) {
    std::mt19937 random(9);
    for (int i = 0; i < 300; ++i) {
        glm::dvec3 face = 5.0 * randomVector(random);
        const int axis = i % 3;
        face[axis] = std::round(face[axis]);
        glm::dvec3 step{0.0};
        step[axis] = 1e-6;
        const auto at = [&](int steps) {
            return reference::curlNoise(face + static_cast<double>(steps) * step, 1);
        };
        // First derivatives are a few tens, second ones a few hundred.
        EXPECT_LT(glm::distance(at(-1), at(1)), 1e-4);
        EXPECT_LT(glm::distance((at(2) - at(1)) / 1e-6, (at(-1) - at(-2)) / 1e-6), 1e-2);
    }
}

// Tests the part that the next octave adds, without the normalisation to r.m.s. 1.
TEST(Turbulence, HasOctavesAsInKolmogorovsSpectrum) {
    const auto points = apart(16);
    double energy = 0.0;
    for (std::uint32_t octaves = 0; octaves < 5; ++octaves) {
        const double amplitude = std::exp2(-static_cast<double>(octaves) / 3.0);
        const double next = energy + amplitude * amplitude;
        const double added = meanSquare(points, [&](const glm::dvec3& point) {
            glm::dvec3 less{0.0};
            if (octaves > 0) less = std::sqrt(energy) * reference::turbulence(point, octaves, 1);
            return std::sqrt(next) * reference::turbulence(point, octaves + 1, 1) - less;
        });
        // The tolerance for the mean of three components of n samples, and half of that for the
        // root.
        const double tolerance = 2.0 * std::sqrt(2.0 / (3.0 * static_cast<double>(points.size())));
        EXPECT_NEAR(std::sqrt(added) / amplitude, 1.0, tolerance) << octaves;
        energy = next;
    }
}

// Kolmogorov's 2/3 law: the mean square of the difference of velocities l apart grows as l^(2/3),
// for l well within the eddies' sizes, here 1 to 1/128. The missing eddies above 1 and below 1/128
// change it by 10 % from 1/32 to 1/4, which is 0.05 in the exponent.
TEST(Turbulence, FollowsTheTwoThirdsLaw) {
    const auto points = apart(16);
    const auto difference = [&](double distance) {
        return meanSquare(points, [&](const glm::dvec3& point) {
            return reference::turbulence(point + glm::dvec3(distance, 0, 0), 8, 1) -
                   reference::turbulence(point, 8, 1);
        });
    };
    const double exponent = std::log(difference(0.25) / difference(1.0 / 32.0)) / std::log(8.0);
    EXPECT_NEAR(exponent, 2.0 / 3.0, 0.1);
}

TEST(Turbulence, DependsOnTheSeed) {
    const auto points = apart(12);
    const double apart_by = meanSquare(points, [](const glm::dvec3& point) {
        return reference::turbulence(point, 3, 1) - reference::turbulence(point, 3, 2);
    });
    // For independent fields it is 2. With n = 1728 and three components the tolerance is 4 sqrt(2
    // / 3n) of it.
    EXPECT_NEAR(apart_by, 2.0, 2.0 * 0.08);
}

// Taylor's hypothesis: at the time t, x + U t d has the velocity that x had at the start.
TEST(Wind, CarriesItsTurbulence) {
    const WindSettings settings{
        .mode = WindMode::drag, .direction = {1, 2, -2}, .speed = 7.0f, .turbulence = 0.5f};
    const glm::dvec3 mean = 7.0 * glm::dvec3(1, 2, -2) / 3.0;
    for (const glm::dvec3& point : apart(4))
        for (const double time : {0.1, 12.3, 1500.0}) {
            const glm::dvec3 start = reference::airVelocity(settings, 1, point, 0.0);
            const glm::dvec3 later = reference::airVelocity(settings, 1, point + time * mean, time);
            EXPECT_LT(glm::distance(start, later), 1e-9);  // 1e4 m are rounded to 2e-12 m
        }
}

TEST(Wind, FluctuatesByItsTurbulence) {
    const WindSettings settings{
        .mode = WindMode::drag,
        .direction = {0, 0, 2},
        .speed = 7.0f,
        .turbulence = 0.5f,
        .turbulence_scale = 0.25f};
    std::vector<glm::dvec3> points = apart(16);
    for (glm::dvec3& point : points) point *= 0.25;
    const double square = meanSquare(points, [&](const glm::dvec3& point) {
        return reference::airVelocity(settings, 1, point, 3.0) - glm::dvec3(0, 0, 7);
    });
    EXPECT_NEAR(std::sqrt(square), 3.5, 3.5 * 2.0 * std::sqrt(2.0 / (3.0 * 4096.0)));
}

TEST(Wind, IsStillWithoutSpeed) {
    const WindSettings settings{
        .mode = WindMode::drag, .direction = glm::vec3(0.0f), .turbulence = 2.0f};
    EXPECT_EQ(reference::airVelocity(settings, 1, {1, 2, 3}, 4.0), glm::dvec3(0.0));
}

}  // namespace
}  // namespace hair::simulation
