#include "benchmarks/physics/checks.h"
#include "benchmarks/physics/solver_settings.h"
#include "benchmarks/physics/trajectory.h"

// Does hair move the same whatever the step, the number of segments and of iterations? Default hair
// let go from the horizontal; the finest run is the reference.
namespace benchmarks::physics {

namespace {

constexpr double kInvarianceTolerance = 0.02;  // between 1/60 s and 1/480 s, promised of `rod`
constexpr std::uint32_t kInvarianceSegments = 16;

// Differences from the last run, as a curve and a value each.
void reportDifferences(
    Findings& findings, const Parameter& varied, const std::vector<double>& values,
    const std::vector<Trajectory>& runs) {
    std::vector<std::vector<double>> rows;
    for (std::size_t i = 0; i + 1 < runs.size(); ++i) {
        const double difference = differenceOf(runs[i], runs.back());
        findings.deviation(
            {"difference from the finest / length",
             "1",
             {{varied.name, values[i], varied.unit},
              {"finest " + varied.name, values.back(), varied.unit}}},
            difference);
        rows.push_back({values[i], difference});
    }
    findings.curve(
        "difference from the finest", {{varied.name, varied.unit}, {"difference / length", "1"}},
        std::move(rows));
}

}  // namespace

void checkStepInvariance(const engine::Device& device, hair::Solver solver, Findings& findings) {
    std::vector<double> steps;
    std::vector<Trajectory> runs;
    for (const double rate : {30.0, 60.0, 120.0, 240.0, 480.0, 1000.0}) {
        hair::SimulationSettings settings = defaultHair(solver);
        settings.time_step = static_cast<float>(1.0 / rate);
        steps.push_back(1.0 / rate);
        runs.push_back(playRelease(device, settings, kInvarianceSegments));
    }
    reportDifferences(findings, {.name = "time_step", .unit = "s"}, steps, runs);
    std::optional<double> tolerance;
    if (solver == hair::Solver::rod) tolerance = kInvarianceTolerance;
    findings.deviation(
        {"difference / length",
         "1",
         {{"time_step", steps[1], "s"}, {"other time_step", steps[4], "s"}}},
        differenceOf(runs[1], runs[4]), tolerance);

    // Air acts on hair once in a time step, however many substeps a solver takes: no promise holds.
    const auto playInAir = [&](double step) {
        hair::SimulationSettings settings = defaultHair(solver);
        settings.time_step = static_cast<float>(step);
        settings.wind.mode = hair::WindMode::drag;
        return playRelease(device, settings, kInvarianceSegments);
    };
    findings.deviation(
        {"difference in still air / length",
         "1",
         {{"time_step", steps[1], "s"}, {"other time_step", steps[4], "s"}}},
        differenceOf(playInAir(steps[1]), playInAir(steps[4])));
}

// What the length of a substep does by itself: numerical damping.
void checkSubstepInvariance(const engine::Device& device, hair::Solver solver, Findings& findings) {
    std::vector<double> counts;
    std::vector<Trajectory> runs;
    for (const std::uint32_t substeps : {1u, 2u, 4u, 8u, 16u, 32u, 64u}) {
        hair::SimulationSettings settings = defaultHair(solver);
        settings.substeps = substeps;
        counts.push_back(substeps);
        runs.push_back(playRelease(device, settings, kInvarianceSegments));
    }
    reportDifferences(findings, {.name = "substeps", .unit = "count"}, counts, runs);
}

void checkSegmentInvariance(const engine::Device& device, hair::Solver solver, Findings& findings) {
    std::vector<double> counts;
    std::vector<Trajectory> runs;
    for (const std::uint32_t segments : {8u, 16u, 32u, 64u, 128u}) {
        counts.push_back(segments);
        runs.push_back(playRelease(device, defaultHair(solver), segments));
    }
    reportDifferences(findings, {.name = "segments", .unit = "count"}, counts, runs);
}

void checkIterationInvariance(
    const engine::Device& device, hair::Solver solver, Findings& findings) {
    if (const auto why = lack(solver, Need::iterations)) return findings.skip(*why);
    std::vector<double> counts;
    std::vector<Trajectory> runs;
    for (const std::uint32_t iterations : {1u, 2u, 4u, 8u, 16u, 32u}) {
        hair::SimulationSettings settings = defaultHair(solver);
        setIterations(settings, iterations);
        counts.push_back(iterations);
        runs.push_back(playRelease(device, settings, kInvarianceSegments));
    }
    reportDifferences(findings, {.name = "iterations", .unit = "count"}, counts, runs);
}

}  // namespace benchmarks::physics
