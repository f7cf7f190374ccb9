#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "benchmarks/physics/checks.h"
#include "benchmarks/physics/experiment.h"
#include "benchmarks/physics/kirchhoff.h"
#include "benchmarks/physics/theory.h"
#include "benchmarks/report/text.h"

namespace benchmarks::physics {
namespace {

// ---- Deflection by wind -------------------------------------------------------------------------

// Hanging hairs of several lengths in a steady wind across them. Only the air brings them to rest,
// so the measurement does not depend on the solver's friction. The check covers only cases with a
// stable rest in theory: in 8 m/s, the elastica's steady state is unstable from some length between
// 5 and 10 cm on, and hair flutters. docs/physics.md has the growth rates.

constexpr std::uint32_t kWindSegments = 64;
constexpr std::array kWindLengths = {0.05, 0.1, 0.2};  // m
struct SteadyWind {
    double speed;  // m/s
    std::size_t lengths;  // the first of kWindLengths, those that come to rest
};
constexpr SteadyWind kSteadyWinds[] = {{0.5, 3}, {2.0, 3}, {8.0, 1}};
// Time steps, 1/s. Substeps of rods are the same in all except the last.
constexpr std::array kWindRates = {30.0, 60.0, 480.0, 1920.0};
constexpr double kWindPatience = 20.0;  // s
constexpr double kWindStill = 1e-6;  // m in a tenth of a second
constexpr double kDeflectionTolerance = 0.02;  // of the length, promised for `rod`
constexpr double kRestTolerance = 0.01;  // of the length, promised for `rod` and for an energy

hair::SimulationSettings inWind(const CheckedSolver& solver, double speed) {
    hair::SimulationSettings settings = freeHair(solver);
    settings.wind.mode = hair::WindMode::drag;
    settings.wind.speed = static_cast<float>(speed);
    return settings;
}

struct InWind {
    std::vector<glm::dvec3> tips;  // [strand], m from the root
    bool still;
};

InWind restInWind(
    const engine::Device& device, hair::SimulationSettings settings,
    std::span<const double> lengths, double time_step) {
    settings.time_step = static_cast<float>(time_step);
    Experiment experiment(
        device, straightStrands(kWindSegments, lengths, {0.0, -1.0, 0.0}), settings);
    InWind rest{.tips = {}, .still = experiment.settle(kWindStill, kWindPatience)};
    const std::vector<glm::dvec3> points = experiment.positions();
    for (std::size_t tip = kWindSegments; tip < points.size(); tip += kWindSegments + 1)
        rest.tips.push_back(points[tip] - points[tip - kWindSegments]);
    return rest;
}

std::vector<InWind> restAtEveryStep(
    const engine::Device& device, const hair::SimulationSettings& settings,
    std::span<const double> lengths) {
    std::vector<InWind> rests;
    for (const double rate : kWindRates)
        rests.push_back(restInWind(device, settings, lengths, 1.0 / rate));
    return rests;
}

// Reports the greatest distances between the tips of strands at rest.
void findApart(
    std::span<const InWind> rests, std::span<const double> lengths, double speed,
    const std::string& metric, std::optional<double> tolerance, Findings& findings) {
    const bool still = std::ranges::all_of(rests, &InWind::still);
    for (std::size_t strand = 0; strand < lengths.size(); ++strand) {
        double apart = 0.0;
        for (const InWind& rest : rests)
            apart = worst(
                apart,
                glm::distance(rest.tips[strand], rests.back().tips[strand]) / lengths[strand]);
        Outcome& outcome = findings.deviation(
            {metric, "1", {{"wind", speed, "m/s"}, {"length", lengths[strand], "m"}}}, apart,
            tolerance);
        if (!still && outcome.reason.empty()) outcome.reason = "still moving after 20 s";
    }
}

}  // namespace

void checkDragDeflection(
    const engine::Device& device, const CheckedSolver& solver, Findings& findings) {
    const bool elastic = !lack(solver, Need::material);
    const auto tolerance = [&](double of_rod) {
        return solver == hair::Solver::rod ? std::optional(of_rod) : std::nullopt;
    };
    std::vector<std::vector<double>> rows;
    for (const auto& [speed, count] : kSteadyWinds) {
        const auto lengths = std::span(kWindLengths).first(count);
        const hair::SimulationSettings settings = inWind(solver, speed);
        const std::vector<InWind> rests = restAtEveryStep(device, settings, lengths);
        findApart(
            rests, lengths, speed, "tip's distance between time steps / length",
            tolerance(kRestTolerance), findings);
        if (solver == hair::Solver::shape)
            findApart(
                restAtEveryStep(device, withEnergy(settings), lengths), lengths, speed,
                "with an energy, tip's distance between time steps / length", kRestTolerance,
                findings);
        if (!elastic) continue;
        const bool still = std::ranges::all_of(rests, &InWind::still);
        for (std::size_t strand = 0; strand < count; ++strand) {
            const double length = lengths[strand];
            const std::vector<Parameter> parameters{
                {"wind", speed, "m/s"}, {"length", length, "m"}};
            const glm::dvec3 expected(draggedTip(settings, speed, length), 0.0);
            double off = 0.0;
            for (std::size_t i = 0; i < rests.size(); ++i) {
                const glm::dvec3& tip = rests[i].tips[strand];
                off = worst(off, glm::distance(tip, expected) / length);
                rows.push_back({speed, length, 1.0 / kWindRates[i], tip.x, expected.x});
            }
            Outcome& outcome = findings.deviation(
                {"tip's distance from the elastica / length", "1", parameters}, off,
                tolerance(kDeflectionTolerance));
            if (!still && outcome.reason.empty()) outcome.reason = "still moving after 20 s";
        }
    }
    if (elastic)
        findings.curve(
            "deflection of the tip",
            {{"wind", "m/s"},
             {"length", "m"},
             {"time step", "s"},
             {"measured", "m"},
             {"theory", "m"}},
            std::move(rows));
}

namespace {

// ---- Steady drag and flutter --------------------------------------------------------------------

// The same hairs over more lengths and speeds, for all solvers, against the elastica. Not every
// steady state of the elastica is stable: air presses along the normal of the hair, so it is a
// follower force. The growth of small motions in the linear equations decides.

constexpr std::uint32_t kSteadySegments = 32;
constexpr float kSteadyStep = 1.0f / 60.0f;  // s
// Promised at 32 segments: shooting and a rod of 32 segments differ by 1e-3 at most. Stretch of
// `stable_cosserat` adds some of the same order.
constexpr double kRodSteadyTolerance = 0.005;
constexpr double kCosseratSteadyTolerance = 0.01;
// A flutter is limited by the hair's length, not by its growth.
constexpr double kFlutters = 0.05;  // of the length, promised for `rod`
// Implicit Euler takes w^2 h / 2 from a mode, so hair that barely flutters may rest. Cases between
// these growth rates are only reported.
constexpr double kSurelyRests = -0.5;  // 1/s
constexpr double kSurelyFlutters = 1.0;  // 1/s

struct Steady {
    glm::dvec3 tip;  // mean, m from the root
    double growth;  // 1/s
};

// The elastica at rest in air. A solver without bending stiffness is compared with a limp string.
std::optional<Steady>
steadyHair(const hair::SimulationSettings& settings, double length, std::vector<double>& angles) {
    PlanarRod rod = planarHair(settings, kSteadySegments, length);
    const bool limp = lack(settings.solver, Need::bending).has_value();
    if (limp) rod.stiffness = 0.0;
    const auto rest = planarRest(rod, angles);
    if (!rest) return {};
    angles = *rest;
    const glm::dvec2 tip = limp ? planarPoints(rod, angles).back()
                                : draggedTip(settings, double{settings.wind.speed}, length);
    return Steady{.tip = {tip, 0.0}, .growth = planarGrowth(rod, angles)};
}

// Tips over the last second, after the hair has come to rest or after 20 s.
struct LastSecond {
    std::vector<glm::dvec3> tips;  // m from the root
    bool still;

    glm::dvec3 mean() const {
        glm::dvec3 sum(0.0);
        for (const glm::dvec3& tip : tips) sum += tip;
        return sum / static_cast<double>(tips.size());
    }
    double farthestFrom(const glm::dvec3& point) const {
        double farthest = 0.0;
        for (const glm::dvec3& tip : tips) farthest = worst(farthest, glm::distance(tip, point));
        return farthest;
    }
};

std::vector<LastSecond> lastSecond(
    const engine::Device& device, const hair::SimulationSettings& settings,
    std::span<const double> lengths) {
    Experiment experiment(
        device, straightStrands(kSteadySegments, lengths, {0.0, -1.0, 0.0}), settings);
    const bool still = experiment.settle(kWindStill, kWindPatience);
    std::vector<LastSecond> strands(lengths.size(), {.tips = {}, .still = still});
    for (std::uint32_t i = 0; i < (still ? 1u : experiment.stepsIn(1.0)); ++i) {
        experiment.advance(1);
        const std::vector<glm::dvec3> points = experiment.positions();
        for (std::size_t strand = 0; strand < strands.size(); ++strand) {
            const std::size_t root = strand * (kSteadySegments + 1);
            strands[strand].tips.push_back(points[root + kSteadySegments] - points[root]);
        }
    }
    return strands;
}

std::optional<double> steadyTolerance(hair::Solver solver) {
    if (solver == hair::Solver::rod) return kRodSteadyTolerance;
    if (solver == hair::Solver::stable_cosserat) return kCosseratSteadyTolerance;
    return {};
}

void compareSteady(
    const engine::Device& device, const hair::SimulationSettings& settings,
    std::span<const double> lengths, const std::string& prefix, Findings& findings) {
    const double speed = settings.wind.speed;
    const std::vector<LastSecond> strands = lastSecond(device, settings, lengths);
    std::vector<double> angles(kSteadySegments, 0.1);
    for (std::size_t i = 0; i < lengths.size(); ++i) {
        const double length = lengths[i];
        const auto theory = steadyHair(settings, length, angles);
        if (!theory) {
            findings.fail("the elastica's state at rest is not found");
            continue;
        }
        const std::vector<Parameter> parameters{
            {"wind", speed, "m/s"}, {"length", length, "m"}, {"growth", theory->growth, "1/s"}};
        const double swing = strands[i].farthestFrom(strands[i].mean()) / length;
        if (theory->growth > kSurelyFlutters) {
            if (settings.solver == hair::Solver::rod)
                findings.deviation(
                    {"swing of hair that flutters / length, shortfall below 0.05", "1", parameters},
                    worst(kFlutters - swing, 0.0), 0.0);
            findings.value(
                {prefix + "swing of hair that flutters / length", "1", parameters}, swing);
            continue;
        }
        const bool rests = theory->growth < kSurelyRests;
        Outcome& outcome = findings.deviation(
            {prefix + "tip's greatest distance from the elastica / length", "1", parameters},
            strands[i].farthestFrom(theory->tip) / length,
            rests && prefix.empty() ? steadyTolerance(settings.solver) : std::nullopt);
        if (outcome.reason.empty() && swing > 1e-3)
            outcome.reason = "swings by " + report::shortNumber(swing) + " of its length";
    }
}

}  // namespace

void checkSteadyDrag(
    const engine::Device& device, const CheckedSolver& solver, std::span<const double> speeds,
    std::span<const double> lengths, Findings& findings) {
    for (const double speed : speeds) {
        hair::SimulationSettings settings = inWind(solver, speed);
        settings.time_step = kSteadyStep;
        compareSteady(device, settings, lengths, "", findings);
        if (solver == hair::Solver::shape)
            compareSteady(device, withEnergy(settings), lengths, "with an energy, ", findings);
    }
}

namespace {

// ---- Terminal speed -----------------------------------------------------------------------------

// A level hair on a head that sinks through still air. When the air bears the weight, the hair
// stays level, whatever its stiffness. At a lower speed it droops, at a higher one it rises. The
// speed is found with the secant through the tip's rise relative to the head at two nearby speeds.

constexpr std::uint32_t kSinkingSegments = 32;
constexpr double kSinkingLength = 0.1;  // m
constexpr double kSinkingInterval = 0.1;  // s between keyframes; the head accelerates during the
                                          // first
constexpr int kSinkingKeyframes = 6;
constexpr double kSinkingTime = 0.2;  // s
constexpr double kSinkingBracket = 0.01;  // share of the speed, to either side
// The secant's error is a fraction of the bracket's square; the rest is rounding of positions.
constexpr double kSinkingTolerance = 1e-3;

// Rise of the tip, m.
double riseOf(const engine::Device& device, const CheckedSolver& solver, double speed) {
    hair::SimulationSettings settings = inWind(solver, 0.0);
    for (int i = 0; i < kSinkingKeyframes; ++i)
        settings.motion.keyframes.push_back(
            {.time = static_cast<float>(i * kSinkingInterval),
             .rotation = {},
             .translation = glm::dvec3(0.0, -speed * i * kSinkingInterval, 0.0)});
    const hair::groom::Groom groom =
        straightStrand(kSinkingSegments, kSinkingLength, {1.0, 0.0, 0.0});
    Experiment experiment(device, groom, settings);
    experiment.advance(experiment.stepsIn(kSinkingInterval));
    const glm::dvec3 velocity(0.0, -speed, 0.0);
    std::vector<glm::dvec3> points;
    for (const glm::vec3& point : groom.points)
        points.push_back(glm::dvec3(point) + kSinkingInterval * velocity);
    experiment.launch(points, std::vector<glm::dvec3>(points.size(), velocity));
    experiment.advance(experiment.stepsIn(kSinkingTime));
    const std::vector<glm::dvec3> after = experiment.positions();
    return after.back().y - after.front().y;
}

}  // namespace

void checkTerminalSpeed(
    const engine::Device& device, const CheckedSolver& solver, Findings& findings) {
    const double expected = terminalSpeed(inWind(solver, 0.0));
    const double slow = expected * (1.0 - kSinkingBracket);
    const double fast = expected * (1.0 + kSinkingBracket);
    const double droops = riseOf(device, solver, slow);
    const double rises = riseOf(device, solver, fast);
    const double level = slow - droops * (fast - slow) / (rises - droops);
    findings.compare(
        {"speed at which air bears the weight",
         "m/s",
         {{"segments", double{kSinkingSegments}, "count"}, {"length", kSinkingLength, "m"}}},
        level, expected, kSinkingTolerance);
}

namespace {

// ---- Drag along the hair ------------------------------------------------------------------------

constexpr float kDragAlong = 1.5f;  // of hair in 1 m/s
constexpr std::uint32_t kAlongSegments = 32;
constexpr float kAlongStep = 1.0f / 240.0f;  // s
constexpr glm::dvec3 kAlongDown{0.0, -1.0, 0.0};

hair::SimulationSettings inAirAlong(const CheckedSolver& solver, double speed) {
    hair::SimulationSettings settings = inWind(solver, speed);
    settings.wind.drag_along = kDragAlong;
    settings.time_step = kAlongStep;
    return settings;
}

// Vertices that nothing holds together fall as a straight strand along itself until air bears them.
constexpr double kAlongFall = 4.0;  // s; exp(-4.75/s 4 s) of the terminal speed is missing, 6e-9
constexpr double kAlongMeasured = 0.5;  // s
constexpr float kAlongFallStep = 1.0f / 60.0f;  // s
// The acceleration left over a step must exceed half of the rounding of a position, 2.4e-7 m at 4
// to 8 m, to change the speed: 9e-4 m/s^2 in 1/60 s, 9e-5 of gravity. Twice that is allowed.
constexpr double kAlongFallTolerance = 2e-4;

void compareFalls(const engine::Device& device, const CheckedSolver& solver, Findings& findings) {
    hair::SimulationSettings settings = inAirAlong(solver, 0.0);
    settings.time_step = kAlongFallStep;
    settings.local.iterations = 0;
    settings.length.iterations = 0;
    Experiment experiment(
        device, straightStrand(kAlongSegments, kSinkingLength, kAlongDown), settings);
    experiment.advance(experiment.stepsIn(kAlongFall));
    const double before = experiment.positions().back().y;
    experiment.advance(experiment.stepsIn(kAlongMeasured));
    findings.compare(
        {"speed of a straight strand that falls along itself",
         "m/s",
         {{"drag_along", double{kDragAlong}, "1"}}},
        (before - experiment.positions().back().y) / kAlongMeasured, terminalSpeedAlong(settings),
        kAlongFallTolerance);
    findings.value(
        {"the same, over the speed of a level strand", "1", {}},
        terminalSpeedAlong(settings) / terminalSpeed(settings));
}

// Air without density acts along hair only.
constexpr double kChainInAirLength = 0.3;  // m
// 32 links swing about 1 % slower than a chain: those of hanging_chain, 64, are 0.4 % slower, and
// here the tension, which grows half as fast, weights the tip more. Without drag along it, the
// period would be 13 % longer.
constexpr double kChainInAirTolerance = 0.02;

void compareChains(const engine::Device& device, const CheckedSolver& solver, Findings& findings) {
    hair::SimulationSettings settings = chain(solver, kChainInAirLength);
    settings.substeps = 1;
    settings.time_step = kAlongStep;
    settings.wind = inAirAlong(solver, 0.0).wind;
    settings.wind.air_density = 0.0f;
    settings.wind.direction = -kAlongDown;
    settings.wind.speed = static_cast<float>(0.5 * terminalSpeedAlong(settings));
    std::vector<double> shape;
    for (std::uint32_t i = 0; i <= kAlongSegments; ++i)
        shape.push_back(chainShapeInAir(1.0 - static_cast<double>(i) / kAlongSegments));
    const double period = chainPeriodInAir(kChainInAirLength, kGravity);
    Experiment experiment(
        device, straightStrand(kAlongSegments, kChainInAirLength, kAlongDown), settings);
    const auto frequency = measureFrequency(
        experiment, {.shape = shape,
                     .segment = kChainInAirLength / kAlongSegments,
                     .direction = kAlongDown,
                     .sideways = {1.0, 0.0, 0.0},
                     .expected_frequency = 1.0 / period});
    std::optional<double> tolerance;
    if (solver == hair::Solver::shape || solver == hair::Solver::rod)
        tolerance = kChainInAirTolerance;
    Outcome& outcome = findings.compare(
        {"first period of a chain in wind along it",
         "s",
         {{"segments", double{kAlongSegments}, "count"},
          {"wind", double{settings.wind.speed}, "m/s"}}},
        frequency ? 1.0 / *frequency : std::numeric_limits<double>::quiet_NaN(), period, tolerance);
    if (!frequency) outcome.reason = "it does not swing";
}

struct AlongCase {
    double speed;  // m/s
    double length;  // m
};
constexpr AlongCase kAlongCases[] = {{2.0, 0.1}, {8.0, 0.05}};

void compareElastica(
    const engine::Device& device, const CheckedSolver& solver, Findings& findings) {
    for (const auto& [speed, length] : kAlongCases) {
        const hair::SimulationSettings settings = inAirAlong(solver, speed);
        const InWind rest = restInWind(device, settings, std::array{length}, double{kAlongStep});
        const glm::dvec3 expected(draggedTip(settings, speed, length), 0.0);
        hair::SimulationSettings without = settings;
        without.wind.drag_along = 0.0f;
        const glm::dvec2 across = draggedTip(without, speed, length);
        const std::vector<Parameter> parameters{{"wind", speed, "m/s"}, {"length", length, "m"}};
        Outcome& outcome = findings.deviation(
            {"tip's distance from the elastica / length", "1", parameters},
            glm::distance(rest.tips.front(), expected) / length,
            solver == hair::Solver::rod ? std::optional(kRodSteadyTolerance) : std::nullopt);
        if (!rest.still && outcome.reason.empty()) outcome.reason = "still moving after 20 s";
        findings.value(
            {"effect of the drag along the hair on the elastica's tip / length", "1", parameters},
            glm::distance(glm::dvec2(expected), across) / length);
    }
}

}  // namespace

void checkDragAlong(const engine::Device& device, const CheckedSolver& solver, Findings& findings) {
    if (!lack(solver, Need::free_vertices)) compareFalls(device, solver, findings);
    compareChains(device, solver, findings);
    if (!lack(solver, Need::material)) compareElastica(device, solver, findings);
}

namespace {

// ---- Shelter ------------------------------------------------------------------------------------

// A bed of upright strands, in rows across the wind. Strands are about a cell apart, so the bed has
// no gaps on the grid. The strands in the middle are measured: the grid spreads hair by 1.5 cells,
// beyond the bed's faces, too.
constexpr std::uint32_t kBedRows = 24;
constexpr std::uint32_t kBedFiles = 9;
constexpr std::uint32_t kBedMiddle = 3;  // files on each side that are not measured
constexpr std::uint32_t kBedSegments = 16;
constexpr double kBedSpacing = 0.0025;  // m
constexpr double kBedHeight = 0.04;  // m
constexpr std::uint32_t kBedResolution = 64;  // cells of 2.4 mm

hair::groom::Groom bed() {
    hair::groom::Groom groom{
        .strand_count = kBedRows * kBedFiles, .vertices_per_strand = kBedSegments + 1};
    for (std::uint32_t row = 0; row < kBedRows; ++row)
        for (std::uint32_t file = 0; file < kBedFiles; ++file)
            for (std::uint32_t i = 0; i <= kBedSegments; ++i)
                groom.points.emplace_back(
                    row * kBedSpacing, -kBedHeight * i / kBedSegments, file * kBedSpacing);
    return groom;
}

// The bed's first row meets undisturbed air. Its hair has this frontal area, over that of its
// front.
hair::SimulationSettings inBed(hair::SimulationSettings settings, double area) {
    const double guide = kBedSpacing / (2.0 * double{settings.material.radius});
    settings.hair_hair.resolution = kBedResolution;
    settings.hair_hair.shelter = static_cast<float>(area * guide / kBedRows);
    return settings;
}

// Index of a vertex of a strand in the bed's middle.
std::size_t inMiddle(std::uint32_t row, std::uint32_t file, std::uint32_t vertex) {
    return std::size_t{row * kBedFiles + file} * (kBedSegments + 1) + vertex;
}

// The speed of the air, m/s, that accelerates a vertex at rest to `gained` in a time step:
// dragPerLength() with the velocity at the step's end.
double speedOfAir(const hair::SimulationSettings& settings, double gained) {
    double slow = 0.0;
    double fast = 2.0 * double{settings.wind.speed};
    for (int i = 0; i < 60; ++i) {
        const double speed = (slow + fast) / 2.0;
        const double rate = dragPerLength(settings, speed) / lineDensity(settings.material) / speed;
        const double part = double{settings.time_step} * rate;
        (part / (1.0 + part) * speed > gained ? fast : slow) = speed;
    }
    return slow;
}

struct Bed {
    double speed;  // of the wind, m/s
    double viscosity;  // Pa s
    double area;  // frontal, over that of its front
};
// Almost without viscosity, the profile is exponential. With that of air at 1 m/s, air stops.
constexpr Bed kBeds[] = {{8.0, 1e-7, 3.0}, {8.0, 1.8e-5, 1.5}, {1.0, 1.8e-5, 1.0}};
// Rows take momentum one by one: a row takes up to an eighth, and the sum over rows differs from
// the integral by the square of that over 24, 7e-4. The rest is for the density of strands on a
// grid of another spacing.
constexpr double kBedTolerance = 0.003;

void compareBeds(const engine::Device& device, const CheckedSolver& solver, Findings& findings) {
    std::vector<std::vector<double>> rows;
    for (const auto& [speed, viscosity, area] : kBeds) {
        hair::SimulationSettings settings = inWind(solver, speed);
        settings.gravity = glm::vec3(0.0f);
        settings.time_step = 1.0f / 480.0f;
        settings.substeps = 1;
        settings.local.iterations = 0;
        settings.length.iterations = 0;
        settings.wind.air_viscosity = static_cast<float>(viscosity);
        settings = inBed(settings, area);
        Experiment experiment(device, bed(), settings);
        const std::vector<glm::dvec3> before = experiment.positions();
        experiment.advance(1);
        const std::vector<glm::dvec3> after = experiment.positions();
        const std::vector<Parameter> parameters{
            {"wind", speed, "m/s"}, {"viscosity", viscosity, "Pa s"}, {"area", area, "1"}};
        double off = 0.0;
        double drag = 0.0;
        for (std::uint32_t row = 0; row < kBedRows; ++row) {
            double moved = 0.0;
            for (std::uint32_t vertex = kBedSegments / 3; vertex < kBedSegments * 2 / 3; ++vertex)
                moved += (after[inMiddle(row, kBedFiles / 2, vertex)].x -
                          before[inMiddle(row, kBedFiles / 2, vertex)].x) /
                         (kBedSegments * 2 / 3 - kBedSegments / 3);
            const double measured = speedOfAir(settings, moved / experiment.timeStep());
            const double passed = area * (row + 0.5) / kBedRows;
            const double expected = shelteredSpeed(settings, speed, passed);
            off = worst(off, std::abs(measured - expected) / speed);
            drag += dragPerLength(settings, measured) / kBedRows;
            rows.push_back({speed, viscosity, passed, measured, expected});
        }
        findings.deviation(
            {"air's greatest error in a bed of hair / wind", "1", parameters}, off, kBedTolerance);
        const double behind = shelteredSpeed(settings, speed, area);
        const double taken =
            double{settings.wind.air_density} / 2.0 * (speed * speed - behind * behind);
        findings.compare(
            {"drag of the bed / drag of its strands alone", "1", parameters},
            drag / dragPerLength(settings, speed),
            2.0 * double{settings.material.radius} * taken / area / dragPerLength(settings, speed),
            kBedTolerance);
    }
    findings.curve(
        "air in a bed of hair",
        {{"wind", "m/s"},
         {"viscosity", "Pa s"},
         {"area passed", "1"},
         {"measured", "m/s"},
         {"theory", "m/s"}},
        std::move(rows));
}

// Hair at rest in the bed, in a wind that bends the first row by a tenth of its length. Rows keep
// their order, so each has the same hair in front of it.
constexpr double kBentWind = 0.5;  // m/s
constexpr double kBentArea = 0.4;
constexpr double kBentPatience = 5.0;  // s
// A rod of 16 segments differs by 4e-3 from the elastica, as in steady_drag. Bent hair has more
// length for its height: 1 - cos(0.1), 0.5 % of the force.
constexpr double kBentTolerance = 0.01;

void compareBent(const engine::Device& device, const CheckedSolver& solver, Findings& findings) {
    hair::SimulationSettings settings = inBed(inWind(solver, kBentWind), kBentArea);
    settings.time_step = kSteadyStep;
    Experiment experiment(device, bed(), settings);
    const bool still = experiment.settle(kWindStill, kBentPatience);
    const std::vector<glm::dvec3> points = experiment.positions();
    double off = 0.0;
    for (std::uint32_t row = 0; row < kBedRows; ++row) {
        const double speed =
            shelteredSpeed(settings, kBentWind, kBentArea * (row + 0.5) / kBedRows);
        const glm::dvec3 expected(draggedTip(settings, speed, kBedHeight), 0.0);
        const glm::dvec3 tip = points[inMiddle(row, kBedFiles / 2, kBedSegments)] -
                               points[inMiddle(row, kBedFiles / 2, 0)];
        off = worst(off, glm::distance(tip, expected) / kBedHeight);
    }
    Outcome& outcome = findings.deviation(
        {"tips' greatest distance from the elastica in sheltered air / length",
         "1",
         {{"wind", kBentWind, "m/s"}, {"area", kBentArea, "1"}}},
        off, solver == hair::Solver::rod ? std::optional(kBentTolerance) : std::nullopt);
    if (!still && outcome.reason.empty()) outcome.reason = "still moving after 5 s";
}

}  // namespace

void checkShelter(const engine::Device& device, const CheckedSolver& solver, Findings& findings) {
    if (lack(solver, Need::free_vertices) && lack(solver, Need::material))
        return findings.skip("it has neither free vertices nor a modulus");
    if (!lack(solver, Need::free_vertices)) compareBeds(device, solver, findings);
    if (!lack(solver, Need::material)) compareBent(device, solver, findings);
}

}  // namespace benchmarks::physics
