#include <cmath>
#include <numeric>
#include <tuple>

#include <gmock/gmock.h>

#include "benchmarks/physics/experiment.h"
#include "benchmarks/physics/kirchhoff.h"
#include "benchmarks/physics/theory.h"

namespace benchmarks::physics {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::Pointwise;

// Abramowitz and Stegun 1964, Handbook of mathematical functions, table 25.9: 12 digits.
TEST(PhysicsTheory, FindsTheTabulatedRootsOfLaguerre) {
    const std::pair<unsigned, std::vector<double>> tables[] = {
        {2, {0.585786437627, 3.414213562373}},
        {3, {0.415774556783, 2.294280360279, 6.289945082937}},
        {5, {0.263560319718, 1.413403059107, 3.596425771041, 7.085810005859, 12.640800844276}}};
    for (const auto& [n, roots] : tables)
        EXPECT_THAT(laguerreRoots(n), Pointwise(DoubleNear(1e-12), roots));
}

// One mass: sqrt(g / l). Two masses: w^2 = (2 -+ sqrt 2) g / l with amplitudes 1 : 1 +- sqrt 2.
TEST(PhysicsTheory, KnowsSimpleAndDoublePendulums) {
    const double base = std::sqrt(9.81 / 0.2) / (2.0 * kPi);
    EXPECT_NEAR(pendulumModes(1, 0.2, 9.81)[0].frequency, base, 1e-12);
    const auto modes = pendulumModes(2, 0.2, 9.81);
    EXPECT_NEAR(modes[0].frequency, base * std::sqrt(2.0 - std::sqrt(2.0)), 1e-12);
    EXPECT_NEAR(modes[1].frequency, base * std::sqrt(2.0 + std::sqrt(2.0)), 1e-12);
    EXPECT_THAT(
        modes[0].shape,
        ElementsAre(DoubleNear(std::sqrt(2.0) - 1.0, 1e-12), DoubleNear(1.0, 1e-12)));
    EXPECT_THAT(
        modes[1].shape,
        ElementsAre(DoubleNear(-1.0, 1e-12), DoubleNear(std::sqrt(2.0) - 1.0, 1e-12)));
}

// Modes of a symmetric problem with equal masses are orthogonal.
TEST(PhysicsTheory, GivesOrthogonalModes) {
    const auto modes = pendulumModes(5, 0.1, 9.81);
    for (std::size_t a = 0; a < 5; ++a)
        for (std::size_t b = 0; b < a; ++b)
            EXPECT_NEAR(
                std::inner_product(
                    modes[a].shape.begin(), modes[a].shape.end(), modes[b].shape.begin(), 0.0),
                0.0, 1e-12);
}

// Period 5.2255 sqrt(L / g). A chain of n = 100 masses is slower by 1 / (4 n), to first order in
// 1 / n.
TEST(PhysicsTheory, KnowsTheHangingChain) {
    EXPECT_NEAR(hangingChainPeriod(1.0, 1.0), 5.2255, 5e-5);
    const double many = 1.0 / pendulumModes(100, 0.01, 1.0)[0].frequency;
    EXPECT_NEAR(many / hangingChainPeriod(1.0, 1.0) - 1.0, 0.25 / 100.0, 1e-4);
}

// f1 = 3.5160 / (2 pi) sqrt(EI / (lambda L^4)), as in textbooks on vibrations. The mode is clamped
// at 0 and free at 1, with neither torque nor force.
TEST(PhysicsTheory, KnowsTheClampedBeam) {
    EXPECT_NEAR(cantileverFrequency(4.0, 1.0, 1.0), 2.0 * 3.5160 / (2.0 * kPi), 1e-5);
    EXPECT_NEAR(cantileverFrequency(1.0, 4.0, 2.0), 3.5160 / (2.0 * kPi) / 8.0, 1e-5);
    EXPECT_EQ(cantileverShape(0.0), 0.0);
    EXPECT_EQ(cantileverShape(1.0), 1.0);
    // Blevins 1979, Formulas for natural frequency and mode shape: 0.3395 at the middle.
    EXPECT_NEAR(cantileverShape(0.5), 0.3395, 5e-5);
    const double h = 1e-3;
    EXPECT_NEAR(cantileverShape(h) / h, 0.0, 2e-3);
    const auto shape = [&](int i) { return cantileverShape(1.0 + i * h); };
    EXPECT_NEAR((shape(1) - 2.0 * shape(0) + shape(-1)) / (h * h), 0.0, 1e-4);
    EXPECT_NEAR(
        (shape(2) - 2.0 * shape(1) + 2.0 * shape(-1) - shape(-2)) / (2.0 * h * h * h), 0.0, 1e-3);
}

// For a = 1 and a span of 2: length 2 sinh 1, sag cosh 1 - 1.
TEST(PhysicsTheory, HangsACatenary) {
    const Catenary catenary(2.0, 2.0 * std::sinh(1.0));
    EXPECT_NEAR(catenary.parameter(), 1.0, 1e-12);
    EXPECT_NEAR(catenary.at(0.0).x, 0.0, 1e-12);
    EXPECT_NEAR(catenary.at(0.0).y, 0.0, 1e-12);
    const glm::dvec2 lowest = catenary.at(std::sinh(1.0));
    EXPECT_NEAR(lowest.x, 1.0, 1e-12);
    EXPECT_NEAR(lowest.y, 1.0 - std::cosh(1.0), 1e-12);
    const glm::dvec2 half = catenary.at(std::sinh(1.0) - std::sinh(0.5));  // where x - 1 = -1/2
    EXPECT_NEAR(half.x, 0.5, 1e-12);
    EXPECT_NEAR(half.y, std::cosh(0.5) - std::cosh(1.0), 1e-12);
}

// Romero et al. 2021. The values come from a finite-difference Newton method and Richardson
// extrapolation.
TEST(PhysicsTheory, HangsAnElastica) {
    const std::pair<double, double> table[] = {{0.1, 0.01250},  {1.0, 0.12456}, {5.0, 0.58572},
                                               {10.0, 1.06680}, {50.0, 3.7056}, {100.0, 5.8881},
                                               {1000.0, 21.335}};
    for (const auto& [gamma, ratio] : table)
        EXPECT_NEAR(cantileverRatio(gamma) / ratio, 1.0, 5e-4) << gamma;
    EXPECT_NEAR(cantileverRatio(1e-3) / (1e-3 / 8.0), 1.0, 1e-4);
}

// Default hair of 70 um in air: published drag over weight, to two digits, is 3.9 at 1 m/s and 47
// at 5 m/s.
TEST(PhysicsTheory, KnowsTheDragOfAThinCylinder) {
    hair::SimulationSettings settings = freeHair(hair::Solver::rod);
    settings.material.radius = 35e-6f;
    const double weight =
        lineDensity(settings.material) * glm::length(glm::dvec3(settings.gravity));
    EXPECT_NEAR(dragPerLength(settings, 1.0) / weight, 3.9, 0.05);
    EXPECT_NEAR(dragPerLength(settings, 5.0) / weight, 47.0, 0.5);
    EXPECT_EQ(dragPerLength(settings, 0.0), 0.0);
    EXPECT_NEAR(dragPerLength(settings, terminalSpeed(settings)) / weight, 1.0, 1e-9);
}

// A beam under a uniform load has its tip at w = q L^4 / (8 EI). Its slope is 4/3 (w / L) (1 -
// (1 - s)^3), so it is shorter by the integral of half the squared slope, 4/7 w^2 / L. The next
// order in w / L is less than twice its square.
TEST(PhysicsTheory, DragsAStiffRodAsABeamUnderAnEvenLoad) {
    hair::SimulationSettings settings = freeHair(hair::Solver::rod);
    settings.gravity = {};
    const double length = 0.01;
    for (const double speed : {0.05, 0.2, 0.5}) {
        const double load = dragPerLength(settings, speed);
        const double beam =
            load * std::pow(length, 4.0) / (8.0 * bendingStiffness(settings.material));
        const glm::dvec2 tip = draggedTip(settings, speed, length);
        const double slope = beam / length;
        EXPECT_NEAR(tip.x / beam, 1.0, 2.0 * slope * slope + 1e-6) << speed;
        EXPECT_NEAR(-tip.y / length, 1.0 - 4.0 / 7.0 * slope * slope, 1e-6 + std::pow(slope, 4.0))
            << speed;
    }
}

// A long heavy hair hangs straight at the angle where wind and weight across it balance: f(U cos
// theta) = w sin theta. Near the clamp it bends within sqrt(EI / T) with T < w L, which is
// 1 / sqrt(Gamma) of its length. The bound is twice that.
TEST(PhysicsTheory, DragsALongRodToTheAngleWhereTheWeightIsBorne) {
    const hair::SimulationSettings settings = freeHair(hair::Solver::rod);
    const double speed = 1.0;
    const double weight = lineDensity(settings.material) * kGravity;
    double low = 0.0;
    double high = kPi / 2.0;
    for (int i = 0; i < 60; ++i) {
        const double angle = (low + high) / 2.0;
        const bool lifts =
            dragPerLength(settings, speed * std::cos(angle)) > weight * std::sin(angle);
        (lifts ? low : high) = angle;
    }
    for (const double gamma : {300.0, 1000.0}) {
        const double length = lengthOf(settings.material, gamma);
        const glm::dvec2 tip = draggedTip(settings, speed, length);
        EXPECT_NEAR(std::atan2(tip.x, -tip.y), low, 2.0 * low / std::sqrt(gamma)) << gamma;
        EXPECT_NEAR(std::hypot(tip.x, tip.y) / length, 1.0, 2.0 / std::sqrt(gamma)) << gamma;
    }
}

// Without weight and viscosity, only f L^3 / EI matters: a hair twice as long bends like the
// original in a wind 2^(3/2) times as strong.
TEST(PhysicsTheory, DragsRodsOfTheSameRatioOfWindToStiffnessToTheSameShape) {
    hair::SimulationSettings settings = freeHair(hair::Solver::rod);
    settings.gravity = {};
    settings.wind.air_viscosity = 0.0f;
    const glm::dvec2 small = draggedTip(settings, 4.0 * std::pow(2.0, 1.5), 0.05) / 0.05;
    const glm::dvec2 large = draggedTip(settings, 4.0, 0.1) / 0.1;
    EXPECT_NEAR(small.x, large.x, 1e-6);
    EXPECT_NEAR(small.y, large.y, 1e-6);
    EXPECT_GT(small.x, 0.5);
}

// Horizontal, deep and thin: q L^3 = 12.85 sqrt(B C), Timoshenko and Gere 1961, Theory of elastic
// stability, section 6.3. The other bending stiffness is a million times as large, so its effect is
// a millionth.
TEST(PhysicsTheory, ADeepCantileverFallsOverWherePrandtlHasIt) {
    for (const auto& [weak, twisting] : {std::pair{1.0, 1.0}, {2.0, 0.5}, {0.3, 3.0}}) {
        const ClampedRod rod{
            .section = {.strong = 1e6, .weak = weak, .twisting = twisting},
            .weight = 1.0,
            .length = 0.0,
            .clamp = kPi / 2.0};
        const auto length = bucklingLength(rod, 10.0);
        ASSERT_TRUE(length);
        EXPECT_NEAR(std::pow(*length, 3.0) / std::sqrt(weak * twisting), 12.85, 0.01);
    }
}

// Standing: q L^3 / B = 9/4 j^2 = 7.837 for any torsional stiffness, with j = 1.8664, the first
// root of the Bessel function of order -1/3 (Greenhill 1881). Hanging: never.
TEST(PhysicsTheory, AStandingRodFallsOverWhereGreenhillHasIt) {
    ClampedRod rod{
        .section = {.strong = 3.0, .weak = 1.0, .twisting = 0.7},
        .weight = 1.0,
        .length = 0.0,
        .clamp = kPi};
    const auto length = bucklingLength(rod, 4.0);
    ASSERT_TRUE(length);
    EXPECT_NEAR(std::pow(*length, 3.0), 7.837, 0.002);
    rod.clamp = 0.0;
    EXPECT_FALSE(bucklingLength(rod, 4.0));
}

// Beyond the critical weight w0 of the linear equations, Kirchhoff's equations have a state out of
// the plane. Its distance grows as the square root of the excess weight, so the line through two
// squared distances starts at w0, up to the second order of 0.02.
TEST(PhysicsTheory, ABuckledRodBeginsInItsPlane) {
    hair::MaterialSettings material;
    for (const float ellipticity : {1.8f, 4.0f}) {
        material.ellipticity = ellipticity;
        ClampedRod rod{
            .section = sectionStiffness(material),
            .weight = lineDensity(material) * kGravity,
            .length = 0.0,
            .clamp = kPi / 2.0};
        const auto critical = bucklingLength(rod, 0.3);
        ASSERT_TRUE(critical);
        const auto square = [&](double weight) {
            rod.length = *critical * std::cbrt(weight);
            const auto tip = buckledTip(rod);
            return tip ? std::pow(tip->z / rod.length, 2.0) : std::nan("");
        };
        const double near = square(1.01);
        const double far = square(1.02);
        EXPECT_NEAR(1.01 - near * 0.01 / (far - near), 1.0, 1e-3);
        EXPECT_GT(far, 1e-3);
        rod.length = 0.99 * *critical;
        EXPECT_FALSE(buckledTip(rod));
    }
    // A round hair never buckles.
    material.ellipticity = 1.0f;
    EXPECT_FALSE(bucklingLength(
        {.section = sectionStiffness(material),
         .weight = lineDensity(material) * kGravity,
         .length = 0.0,
         .clamp = kPi / 2.0},
        0.3));
}

TEST(PhysicsTheory, KnowsTheStiffnessOfARoundAndAFlatSection) {
    hair::MaterialSettings material;
    const SectionStiffness round = sectionStiffness(material);
    const double bending = bendingStiffness(material);
    EXPECT_NEAR(round.strong / bending, 1.0, 1e-12);
    EXPECT_NEAR(round.weak / bending, 1.0, 1e-12);
    // J = 2 I.
    const double ratio = double{material.shear_modulus} / double{material.youngs_modulus};
    EXPECT_NEAR(round.twisting / bending, 2.0 * ratio, 1e-12);
    material.ellipticity = 2.0f;
    const SectionStiffness flat = sectionStiffness(material);
    EXPECT_NEAR(flat.strong / bending, 2.0, 1e-12);
    EXPECT_NEAR(flat.weak / bending, 0.5, 1e-12);
    EXPECT_NEAR(flat.twisting / bending, 2.0 * ratio * 0.8, 1e-12);
}

// Euler's column, clamped and hinged: P = k^2, tan k = k, k = 4.49341. Near that, psi = c (cos k
// z - cos k) and y(1) = 1 - integral of psi^2 / 2. So Q / P is -cos k / (1 - cos k) of the tip's
// angle, and its square is 2 cos^2 k / (mean of (cos k z - cos k)^2) of the compression. The mean
// is 1/2 + sin 2k / 4k - 2 cos k sin k / k + cos^2 k.
TEST(PhysicsTheory, APressedRodBeginsAsEulersColumn) {
    constexpr double kRoot = 4.493409457909064;
    const double cosine = std::cos(kRoot);
    const double sine = std::sin(kRoot);
    const double mean =
        0.5 + std::sin(2.0 * kRoot) / (4.0 * kRoot) - 2.0 * cosine * sine / kRoot + cosine * cosine;
    const auto pressed = pressedRod(0.01);
    ASSERT_TRUE(pressed);
    EXPECT_NEAR(pressed->pressure, kRoot * kRoot, 1e-2);
    EXPECT_NEAR(pressed->shear / pressed->pressure, 0.01, 1e-9);
    EXPECT_NEAR(
        1e-4 / pressed->compression, 2.0 * cosine * cosine / mean, 2e-3 * cosine * cosine / mean);
    // Under more compression, the rod lies on the ground beside its tip.
    EXPECT_TRUE(pressedRod(0.3));
    EXPECT_FALSE(pressedRod(0.6));
}

// The same rods by shooting. Segments of length l are off by a part of the order of (l / L)^2,
// 2e-4.
TEST(PhysicsTheory, ARodOfSegmentsRestsAsByShooting) {
    hair::SimulationSettings settings = freeHair(hair::Solver::rod);
    PlanarRod level = planarHair(settings, 64, lengthOf(settings.material, 10.0));
    level.clamp = kPi / 2.0;
    const auto sagged = planarRest(level, std::vector<double>(64, kPi / 2.0));
    ASSERT_TRUE(sagged);
    const glm::dvec2 end = planarPoints(level, *sagged).back();
    EXPECT_NEAR(-end.y / end.x / cantileverRatio(10.0), 1.0, 1e-3);
    level.turn = -0.5;
    const auto curled = planarRest(level, *sagged);
    ASSERT_TRUE(curled);
    const glm::dvec2 lower = planarPoints(level, *curled).back();
    EXPECT_NEAR(-lower.y / lower.x / cantileverRatio(10.0, 0.5), 1.0, 1e-3);

    settings.wind.mode = hair::WindMode::drag;
    settings.wind.speed = 2.0f;
    const PlanarRod hair = planarHair(settings, 64, 0.1);
    const auto rest = planarRest(hair, std::vector<double>(64, 0.5));
    ASSERT_TRUE(rest);
    EXPECT_LT(
        glm::distance(planarPoints(hair, *rest).back(), draggedTip(settings, 2.0, 0.1)),
        1e-3 * 0.1);
}

// A standing rod falls over where Greenhill's column does, w L^3 / EI = 7.837; below, it swings
// without growth. In air with the pressure c u all its modes lose c / 2 lambda per second.
TEST(PhysicsTheory, ARodOfSegmentsGrowsAndDecaysAsTheoryHasIt) {
    const hair::SimulationSettings settings = freeHair(hair::Solver::rod);
    PlanarRod rod{};
    for (const double gamma : {7.7, 8.0}) {
        rod = planarHair(settings, 32, lengthOf(settings.material, gamma));
        rod.clamp = kPi;
        const double growth = planarGrowth(rod, std::vector<double>(32, kPi));
        if (gamma < 7.837)
            EXPECT_LT(growth, 0.01);
        else
            EXPECT_GT(growth, 0.1);
    }
    rod.clamp = 0.0;
    const double pressure = 1e-4;  // N s / m^2
    for (const double sign : {1.0, -1.0}) {
        rod.pressure = [&](double across) { return sign * pressure * across; };
        EXPECT_NEAR(
            planarGrowth(rod, std::vector<double>(32, 0.0)),
            -sign * pressure / (2.0 * lineDensity(settings.material)), 0.1);
    }
}

// A pendulum released at 90 degrees: T = 4 sqrt(l / g) K(sin 45), with K by the arithmetic and
// geometric mean of 1 and cos 45. Three masses keep their energy.
TEST(PhysicsTheory, AChainOfSegmentsSwingsFar) {
    PlanarRod chain{
        .stiffness = 0.0, .length = 0.2, .clamp = 0.0, .masses = {1.0}, .field = [](const auto&) {
            return glm::dvec2(0.0, -9.81);
        }};
    std::vector<double> angles{kPi / 2.0};
    std::vector<double> rates{0.0};
    double mean = 1.0;
    double other = std::cos(kPi / 4.0);
    for (int i = 0; i < 6; ++i)
        std::tie(mean, other) = std::pair((mean + other) / 2.0, std::sqrt(mean * other));
    const double quarter = kPi / (2.0 * mean) * std::sqrt(0.2 / 9.81);
    for (int i = 0; i < 1000; ++i) advancePlanar(chain, angles, rates, quarter / 1000.0);
    EXPECT_NEAR(angles[0], 0.0, 1e-9);

    chain.masses = {1.0, 2.0, 0.5};
    angles = {1.5, 1.0, 2.0};
    rates = {0.0, 0.0, 0.0};
    const auto energy = [&] {
        const auto points = planarPoints(chain, angles);
        double sum = 0.0;
        glm::dvec2 velocity(0.0);
        for (std::size_t i = 0; i < 3; ++i) {
            velocity += 0.2 / 3.0 * rates[i] * glm::dvec2(std::cos(angles[i]), std::sin(angles[i]));
            sum += chain.masses[i] * (0.5 * glm::dot(velocity, velocity) + 9.81 * points[i + 1].y);
        }
        return sum;
    };
    const double before = energy();
    for (int i = 0; i < 2000; ++i) advancePlanar(chain, angles, rates, 5e-4);
    EXPECT_NEAR(energy(), before, 1e-6);
}

// Two steps by hand: x1 = v h + a h^2, x2 = 2 x1 - x0 + a h^2.
TEST(PhysicsTheory, FliesLikeVerlet) {
    const glm::dvec3 v{1.0, 2.0, 0.0};
    const glm::dvec3 a{0.0, -8.0, 4.0};
    const double h = 0.5;
    const glm::dvec3 first = v * h + a * h * h;
    EXPECT_EQ(verletFlight(1, v, a, h), first);
    EXPECT_EQ(verletFlight(2, v, a, h), 2.0 * first + a * h * h);
}

TEST(PhysicsTheory, MeasuresTheFrequencyOfADampedCosine) {
    std::vector<double> samples;
    for (int i = 0; i < 200; ++i) {
        const double t = 0.01 * i;
        samples.push_back(std::exp(-0.5 * t) * std::cos(2.0 * kPi * 3.0 * t));
    }
    // Linear interpolation between 33 samples per period; damping shifts the crossings by
    // rate * interval.
    EXPECT_NEAR(*frequencyOf(samples, 0.01), 3.0, 3e-3);
    const std::vector<double> still(10, 1.0);
    EXPECT_FALSE(frequencyOf(still, 0.01));
}

}  // namespace
}  // namespace benchmarks::physics
