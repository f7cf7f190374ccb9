#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
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
#include "benchmarks/report/text.h"
#include "engine/process.h"

// Invariance: whether hair moves the same for all steps, meshes and iterations. Work and precision:
// what an error costs.

namespace benchmarks::physics {
namespace {

// ---- Invariance to step, substeps, segments, iterations -----------------------------------------

// Default hair is released from the horizontal, or hangs at rest in a steady wind. The finest run
// is the reference.

constexpr double kInvarianceTolerance = 0.02;  // between 1/60 s and 1/480 s, promised for rods
constexpr std::uint32_t kInvarianceSegments = 16;
// For generalized_alpha from 8 substeps on. The reference in double precision has 0.0023 at 8, and
// halving the substep quarters that. The tolerance adds as much again for 32 bits.
constexpr double kSecondOrderTolerance = 0.005;

constexpr float kRestWind = 1.5f;  // m/s; the elastica of kTrajectoryLength is stable in it
constexpr double kRestFriction = 10.0;  // 1/s, to settle soon; it does not act at rest
constexpr double kRestPatience = 5.0;  // s
// A part of the length, promised for forces that are in balance at any step and iteration.
constexpr double kBalancedTolerance = 0.01;

// Plays the hair in a state and returns where it was.
struct State {
    const char* prefix;  // of quantities
    Trajectory (*play)(const engine::Device&, hair::SimulationSettings, std::uint32_t segments);
    bool rest;
};

constexpr State kMotion{
    "",
    [](const engine::Device& device, hair::SimulationSettings settings, std::uint32_t segments) {
        return playRelease(device, settings, segments);
    },
    false};

constexpr State kRest{
    "at rest, ",
    [](const engine::Device& device, hair::SimulationSettings settings, std::uint32_t segments) {
        settings.global.stiffness = 0.0f;
        settings.friction = frictionOf(kRestFriction);
        settings.wind.mode = hair::WindMode::drag;
        settings.wind.speed = kRestWind;
        return restTrajectory(device, settings, segments, kRestPatience);
    },
    true};

// Solvers whose forces are in balance at rest, at any step and with any number of iterations.
bool balances(const hair::SimulationSettings& settings) {
    return settings.solver == hair::Solver::rod ||
           (settings.solver == hair::Solver::shape &&
            settings.local.method == hair::LocalMethod::energy);
}

// Reports differences from the last run, as a curve and as single values.
void reportDifferences(
    Findings& findings, const State& state, const Parameter& varied,
    const std::vector<double>& values, const std::vector<Trajectory>& runs,
    std::optional<double> tolerance = {}) {
    std::vector<std::vector<double>> rows;
    for (std::size_t i = 0; i + 1 < runs.size(); ++i) {
        const double difference = differenceOf(runs[i], runs.back());
        findings.deviation(
            {std::string(state.prefix) + "difference from the finest / length",
             "1",
             {{varied.name, values[i], varied.unit},
              {"finest " + varied.name, values.back(), varied.unit}}},
            difference, tolerance);
        rows.push_back({values[i], difference});
    }
    findings.curve(
        std::string(state.prefix) + "difference from the finest",
        {{varied.name, varied.unit}, {"difference / length", "1"}}, std::move(rows));
}

void compareSteps(
    const engine::Device& device, const CheckedSolver& solver, const State& state,
    Findings& findings) {
    std::vector<double> steps;
    std::vector<Trajectory> runs;
    hair::SimulationSettings settings = defaultHair(solver);
    for (const double rate : {30.0, 60.0, 120.0, 240.0, 480.0, 1000.0}) {
        settings.time_step = static_cast<float>(1.0 / rate);
        steps.push_back(1.0 / rate);
        runs.push_back(state.play(device, settings, kInvarianceSegments));
    }
    if (state.rest)
        return reportDifferences(
            findings, state, {.name = "time_step", .unit = "s"}, steps, runs,
            balances(settings) ? std::optional(kBalancedTolerance) : std::nullopt);
    reportDifferences(findings, state, {.name = "time_step", .unit = "s"}, steps, runs);
    std::optional<double> tolerance;
    if (!lack(solver, Need::material)) tolerance = kInvarianceTolerance;
    findings.deviation(
        {"difference / length",
         "1",
         {{"time_step", steps[1], "s"}, {"other time_step", steps[4], "s"}}},
        differenceOf(runs[1], runs[4]), tolerance);

    // Drag acts in every substep, so the same promise holds with it.
    const auto playInAir = [&](double step) {
        settings.time_step = static_cast<float>(step);
        settings.wind.mode = hair::WindMode::drag;
        return playRelease(device, settings, kInvarianceSegments);
    };
    findings.deviation(
        {"difference in still air / length",
         "1",
         {{"time_step", steps[1], "s"}, {"other time_step", steps[4], "s"}}},
        differenceOf(playInAir(steps[1]), playInAir(steps[4])), tolerance);
}

void compareSubsteps(
    const engine::Device& device, const CheckedSolver& solver, const State& state,
    Findings& findings) {
    std::vector<double> counts;
    std::vector<Trajectory> runs;
    hair::SimulationSettings settings = defaultHair(solver);
    for (const std::uint32_t substeps : {1u, 2u, 4u, 8u, 16u, 32u, 64u}) {
        settings.substeps = substeps;
        counts.push_back(substeps);
        runs.push_back(state.play(device, settings, kInvarianceSegments));
    }
    reportDifferences(
        findings, state, {.name = "substeps", .unit = "count"}, counts, runs,
        state.rest && balances(settings) ? std::optional(kBalancedTolerance) : std::nullopt);
}

void compareSegments(
    const engine::Device& device, const CheckedSolver& solver, const State& state,
    Findings& findings) {
    std::vector<double> counts;
    std::vector<Trajectory> runs;
    for (const std::uint32_t segments : {8u, 16u, 32u, 64u, 128u}) {
        counts.push_back(segments);
        runs.push_back(state.play(device, defaultHair(solver), segments));
    }
    reportDifferences(findings, state, {.name = "segments", .unit = "count"}, counts, runs);
}

void compareIterations(
    const engine::Device& device, const CheckedSolver& solver, const State& state,
    Findings& findings) {
    if (const auto why = lack(solver, Need::iterations)) return findings.skip(*why);
    std::vector<double> counts;
    std::vector<Trajectory> runs;
    hair::SimulationSettings settings = defaultHair(solver);
    for (const std::uint32_t iterations : {1u, 2u, 4u, 8u, 16u, 32u}) {
        setIterations(settings, iterations);
        counts.push_back(iterations);
        runs.push_back(state.play(device, settings, kInvarianceSegments));
    }
    reportDifferences(
        findings, state, {.name = "iterations", .unit = "count"}, counts, runs,
        state.rest && balances(settings) ? std::optional(kBalancedTolerance) : std::nullopt);
}

}  // namespace

void checkStepInvariance(
    const engine::Device& device, const CheckedSolver& solver, Findings& findings) {
    compareSteps(device, solver, kMotion, findings);
}

// The effect of the substep's length alone: numerical damping.
void checkSubstepInvariance(
    const engine::Device& device, const CheckedSolver& solver, Findings& findings) {
    compareSubsteps(device, solver, kMotion, findings);
    if (solver != hair::Solver::rod) return;

    // A second-order method has less numerical damping. Its own finest run is the reference.
    const auto play = [&](std::uint32_t substeps) {
        hair::SimulationSettings settings = defaultHair(solver);
        settings.rod.integrator = hair::RodIntegrator::generalized_alpha;
        settings.substeps = substeps;
        return playRelease(device, settings, kInvarianceSegments);
    };
    const Trajectory finest = play(64);
    for (const std::uint32_t substeps : {4u, 8u, 16u})
        findings.deviation(
            {"difference with generalized_alpha / length",
             "1",
             {{"substeps", static_cast<double>(substeps), "count"},
              {"finest substeps", 64.0, "count"}}},
            differenceOf(play(substeps), finest),
            substeps >= 8 ? std::optional(kSecondOrderTolerance) : std::nullopt);
}

void checkSegmentInvariance(
    const engine::Device& device, const CheckedSolver& solver, Findings& findings) {
    compareSegments(device, solver, kMotion, findings);
}

void checkIterationInvariance(
    const engine::Device& device, const CheckedSolver& solver, Findings& findings) {
    compareIterations(device, solver, kMotion, findings);
}

namespace {

// ---- The table of all solvers -------------------------------------------------------------------

template <auto kCompare>
void compareInBothStates(
    const engine::Device& device, const CheckedSolver& solver, Findings& findings) {
    for (const State& state : {kRest, kMotion}) kCompare(device, solver, state, findings);
}

constexpr Check kInvarianceChecks[] = {
    {"step_invariance", compareInBothStates<compareSteps>},
    {"substep_invariance", compareInBothStates<compareSubsteps>},
    {"segment_invariance", compareInBothStates<compareSegments>},
    {"iteration_invariance", compareInBothStates<compareIterations>},
};

// Errors below this are rounding: positions of 0.15 m in 24 bits, in some thousand steps.
constexpr double kRounding = 1e-5;

// How fine a run is, relative to others of its kind: a step, or one over a count.
double coarseness(const Series& series, double value) {
    return series.unit == "count" ? 1.0 / value : value;
}

}  // namespace

std::span<const Check> invarianceChecks() { return kInvarianceChecks; }

std::vector<CheckedSolver> withVariants(std::span<const CheckedSolver> solvers) {
    std::vector<CheckedSolver> all;
    for (const CheckedSolver& solver : solvers) {
        all.push_back(solver);
        if (!solver.file.empty()) continue;
        if (solver == hair::Solver::shape) {
            all.push_back(solver);
            all.back().variant = " with energy";
            all.back().adjust = [](hair::SimulationSettings& settings) {
                settings = withEnergy(settings);
            };
        }
        if (solver == hair::Solver::rod) {
            all.push_back(solver);
            all.back().variant = " with generalized_alpha";
            all.back().adjust = [](hair::SimulationSettings& settings) {
                settings.rod.integrator = hair::RodIntegrator::generalized_alpha;
            };
        }
        if (solver == hair::Solver::stable_cosserat) {
            all.push_back(solver);
            all.back().variant = " with descent";
            all.back().adjust = [](hair::SimulationSettings& settings) {
                settings.stable_cosserat.method = hair::CosseratMethod::descent;
            };
        }
    }
    return all;
}

std::optional<double> observedOrder(
    const std::array<double, 2>& coarseness, const std::array<double, 2>& errors, double finest) {
    const auto ratio = [&](double order) {
        const double reference = std::pow(finest, order);
        return (std::pow(coarseness[0], order) - reference) /
               (std::pow(coarseness[1], order) - reference);
    };
    const double wanted = errors[0] / errors[1];
    double low = 1e-3;
    double high = 8.0;
    if (!(wanted > ratio(low)) || !(wanted < ratio(high))) return {};
    for (int i = 0; i < 60; ++i) {
        const double middle = (low + high) / 2.0;
        (ratio(middle) < wanted ? low : high) = middle;
    }
    return low;
}

std::string invarianceTables(const PhysicsReport& report) {
    std::string text;
    for (const Check& check : kInvarianceChecks) {
        bool headed = false;
        for (const Curve& curve : report.curves) {
            if (curve.check != check.name || curve.rows.empty()) continue;
            const Series& varied = curve.columns.front();
            const auto value = [&](double number) {
                return varied.unit == "count" ? report::plainNumber(number)
                                              : "1/" + report::plainNumber(1.0 / number);
            };
            if (!headed) {
                text += "\n| " + varied.name + " |";
                for (const auto& row : curve.rows) text += ' ' + value(row[0]) + " |";
                text += " order | promise |\n|---|";
                for (std::size_t i = 0; i < curve.rows.size() + 1; ++i) text += "---:|";
                text += "---|\n";
                headed = true;
            }
            const bool rest = curve.name.starts_with(kRest.prefix);
            text += "| " + curve.solver + (rest ? ", at rest |" : ", in motion |");
            for (const auto& row : curve.rows) text += ' ' + report::shortNumber(row[1]) + " |";

            std::optional<double> finest;
            std::optional<double> tolerance;
            std::string verdict;
            for (const Outcome& outcome : report.outcomes) {
                if (outcome.check != curve.check || outcome.solver != curve.solver) continue;
                if (outcome.quantity.name.starts_with(kRest.prefix) != rest) continue;
                for (const Parameter& parameter : outcome.quantity.parameters)
                    if (parameter.name == "finest " + varied.name)
                        finest = coarseness(varied, parameter.value);
                if (!outcome.tolerance) continue;
                tolerance = outcome.tolerance;
                if (verdict != "fail") verdict = verdictName(outcome.verdict);
            }
            // The middle of the orders between neighbouring runs, except those within rounding.
            std::vector<double> orders;
            for (std::size_t i = 1; finest && i < curve.rows.size(); ++i)
                if (curve.rows[i][1] > kRounding)
                    orders.push_back(observedOrder(
                                         {coarseness(varied, curve.rows[i - 1][0]),
                                          coarseness(varied, curve.rows[i][0])},
                                         {curve.rows[i - 1][1], curve.rows[i][1]}, *finest)
                                         .value_or(0.0));
            std::ranges::sort(orders);
            const double order = orders.empty() ? 0.0 : orders[orders.size() / 2];
            if (order > 0.0)
                text += ' ' + report::plainNumber(std::round(order * 10.0) / 10.0) + " |";
            else
                text += orders.empty() ? " rounding |" : " none |";
            text += tolerance ? ' ' + report::shareText(*tolerance) + ": " + verdict + " |\n"
                              : std::string(" |\n");
        }
    }
    return text;
}

namespace {

// ---- Work and precision -------------------------------------------------------------------------

// Two motions that every solver can play with 16 segments. Their references are much finer, of the
// same physics: `hair` is released from the horizontal (the rod with 64 segments, second order and
// 1/3840 s), a limp `chain` from a curve of 60 degrees (64 links in double precision). The time is
// that of 256 strands on the device, in the first motion.

constexpr std::uint32_t kFineSegments = 64;
constexpr std::uint32_t kFineSubsteps = 64;
constexpr std::uint32_t kTimedStrands = 256;
constexpr int kTimedRounds = 5;
constexpr double kChainAngle = kPi / 3.0;  // of the tip
constexpr double kErrors[] = {0.01, 0.05, 0.2};  // of the length

// Root mean square of the distances of all points at all times, over the length. NaN if they are
// not of one size.
double meanDifference(const Trajectory& a, const Trajectory& b) {
    if (a.size() != b.size()) return std::nan("");
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (a[i].size() != b[i].size()) return std::nan("");
        for (std::size_t point = 0; point < a[i].size(); ++point, ++count)
            sum += std::pow(glm::distance(a[i][point], b[i][point]), 2.0);
    }
    return std::sqrt(sum / count) / kTrajectoryLength;
}

std::vector<double> curvedAngles(std::uint32_t segments) {
    std::vector<double> angles;
    for (std::uint32_t i = 0; i < segments; ++i)
        angles.push_back(kChainAngle * (i + 0.5) / segments);
    return angles;
}

struct Motion {
    const char* name;
    hair::SimulationSettings (*settings)(const CheckedSolver&);
    Trajectory (*reference)(const engine::Device&);
    Trajectory (*play)(const engine::Device&, const hair::SimulationSettings&, std::uint32_t);
};

hair::SimulationSettings freelyFalling(const CheckedSolver& solver) {
    hair::SimulationSettings settings = freeHair(solver);
    settings.friction = defaultHair(solver).friction;
    return settings;
}

Trajectory finestHair(const engine::Device& device) {
    hair::SimulationSettings settings = freelyFalling(hair::Solver::rod);
    settings.rod.integrator = hair::RodIntegrator::generalized_alpha;
    settings.substeps = kFineSubsteps;
    return playRelease(device, settings, kFineSegments);
}

Trajectory playCurve(
    const engine::Device& device, const hair::SimulationSettings& settings,
    std::uint32_t segments) {
    Experiment experiment(
        device, straightStrand(segments, kTrajectoryLength, {0.0, -1.0, 0.0}), settings);
    const PlanarRod links = planarHair(settings, segments, kTrajectoryLength);
    std::vector<glm::dvec3> start;
    for (const glm::dvec2& point : planarPoints(links, curvedAngles(segments)))
        start.emplace_back(point, 0.0);
    experiment.place(start);
    return sampleTrajectory(experiment);
}

Trajectory finestChain(const engine::Device&) {
    PlanarRod links = planarHair(freeHair(hair::Solver::rod), kFineSegments, kTrajectoryLength);
    links.stiffness = 0.0;
    std::vector<double> angles = curvedAngles(kFineSegments);
    std::vector<double> rates(angles.size(), 0.0);
    constexpr int kStepsInSample = 64;
    Trajectory trajectory;
    for (int sample = 0; sample < kTrajectorySamples; ++sample) {
        for (int i = 0; i < kStepsInSample; ++i)
            advancePlanar(links, angles, rates, kTrajectoryInterval / kStepsInSample);
        std::vector<glm::dvec3> points;
        for (const glm::dvec2& point : planarPoints(links, angles)) points.emplace_back(point, 0.0);
        trajectory.push_back(eighthsOf(points));
    }
    return trajectory;
}

constexpr Motion kMotions[] = {
    {"hair", freelyFalling, finestHair,
     [](const engine::Device& device, const hair::SimulationSettings& settings,
        std::uint32_t segments) { return playRelease(device, settings, segments); }},
    {"chain", [](const CheckedSolver& solver) { return chain(solver, kTrajectoryLength); },
     finestChain, playCurve}};

// Time on the device of a strand's time step, us: the least of some rounds. A software device's is
// the program's CPU time, which other programs do not lengthen.
double strandTime(const engine::Device& device, const hair::SimulationSettings& settings) {
    const std::vector<double> lengths(kTimedStrands, kTrajectoryLength);
    Experiment experiment(
        device, straightStrands(kInvarianceSegments, lengths, {1.0, 0.0, 0.0}), settings);
    experiment.advance(1);
    const bool software = device.info().type == engine::DeviceType::cpu;
    const auto now = [&] {
        const std::chrono::duration<double, std::micro> wall =
            std::chrono::steady_clock::now().time_since_epoch();
        return software ? 1000.0 * engine::processUse().cpu : wall.count();
    };
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < kTimedRounds; ++i) {
        const double start = now();
        experiment.advance(1);
        least = std::min(least, now() - start);
    }
    return least / kTimedStrands;
}

constexpr const char* kWorkCheck = "work_precision";

// The cheapest row of a curve of measureWork() with at most this error; null: there is none.
const std::vector<double>* cheapestRow(const Curve& curve, double error) {
    const std::vector<double>* cheapest = nullptr;
    for (const auto& row : curve.rows)
        if (row[2] <= error && (cheapest == nullptr || row[3] < (*cheapest)[3])) cheapest = &row;
    return cheapest;
}

}  // namespace

void checkWorkPrecision(
    const engine::Device& device, const CheckedSolver& solver,
    std::span<const std::uint32_t> substeps, std::span<const std::uint32_t> iterations,
    Findings& findings) {
    const bool counted = !lack(solver, Need::iterations).has_value();
    if (!counted) iterations = iterations.first(1);
    std::vector<double> times;  // [substeps][iterations]
    for (const Motion& motion : kMotions) {
        const Trajectory reference = motion.reference(device);
        std::vector<std::vector<double>> rows;
        hair::SimulationSettings settings = motion.settings(solver);
        for (const std::uint32_t count : substeps)
            for (const std::uint32_t repeated : iterations) {
                settings.substeps = count;
                if (counted) setIterations(settings, repeated);
                if (times.size() == rows.size()) times.push_back(strandTime(device, settings));
                rows.push_back(
                    {static_cast<double>(count), counted ? static_cast<double>(repeated) : 0.0,
                     meanDifference(motion.play(device, settings, kInvarianceSegments), reference),
                     times[rows.size()]});
            }
        findings.value(
            {std::string(motion.name) + ", least error / length", "1"},
            std::ranges::min(rows, {}, [](const auto& row) { return row[2]; })[2]);
        findings.curve(
            motion.name,
            {{"substeps", "count"},
             {"iterations", "count"},
             {"error / length", "1"},
             {"time of a strand in 1/60 s", "us"}},
            std::move(rows));
    }
}

std::span<const Check> workChecks() {
    static constexpr std::uint32_t kSubsteps[] = {1, 2, 4, 8, 16, 32};
    static constexpr std::uint32_t kIterations[] = {1, 2, 4, 8};
    static constexpr Check kChecks[] = {
        {kWorkCheck,
         [](const engine::Device& device, const CheckedSolver& solver, Findings& findings) {
             checkWorkPrecision(device, solver, kSubsteps, kIterations, findings);
         }}};
    return kChecks;
}

void recommendSolvers(PhysicsReport& report) {
    for (const Motion& motion : kMotions)
        for (const double error : kErrors) {
            Outcome cheapest{
                .check = kWorkCheck,
                .quantity = {std::string(motion.name) + ", cheapest solver", "us"}};
            for (const Curve& curve : report.curves) {
                if (curve.check != kWorkCheck || curve.name != motion.name) continue;
                const std::vector<double>* const row = cheapestRow(curve, error);
                if (row == nullptr || cheapest.measured <= (*row)[3]) continue;
                cheapest.measured = (*row)[3];
                cheapest.solver = curve.solver;
                cheapest.quantity.parameters = {
                    {"error / length at most", error, "1"},
                    {"substeps", (*row)[0], "count"},
                    {"iterations", (*row)[1], "count"},
                    {"error / length", (*row)[2], "1"}};
            }
            if (!cheapest.solver.empty()) report.outcomes.push_back(std::move(cheapest));
        }
}

std::string workTables(const PhysicsReport& report) {
    std::string text;
    for (const Motion& motion : kMotions) {
        text += std::string("\n| ") + motion.name + ": us of a strand in 1/60 s | least error |";
        for (const double error : kErrors) text += " error " + report::shareText(error) + " |";
        text += "\n|---|---:|";
        for (std::size_t i = 0; i < std::size(kErrors); ++i) text += "---:|";
        text += '\n';
        for (const Curve& curve : report.curves) {
            if (curve.check != kWorkCheck || curve.name != motion.name || curve.rows.empty())
                continue;
            const double least =
                std::ranges::min(curve.rows, {}, [](const auto& row) { return row[2]; })[2];
            text += "| " + curve.solver + " | " + report::shareText(least) + " |";
            for (const double error : kErrors) {
                const std::vector<double>* const row = cheapestRow(curve, error);
                if (row != nullptr) {
                    text += ' ' + report::shortNumber((*row)[3]) + " (" +
                            report::plainNumber((*row)[0]);
                    if ((*row)[1] > 0.0) text += " x " + report::plainNumber((*row)[1]);
                    text += ')';
                }
                text += " |";
            }
            text += '\n';
        }
    }
    return text;
}

}  // namespace benchmarks::physics
