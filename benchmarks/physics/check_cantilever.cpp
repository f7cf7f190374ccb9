#include <cmath>
#include <limits>

#include "benchmarks/physics/checks.h"
#include "benchmarks/physics/experiment.h"
#include "benchmarks/physics/solver_settings.h"
#include "benchmarks/physics/theory.h"
#include "benchmarks/physics/vibration.h"
#include "benchmarks/physics/worst.h"

// Romero et al. 2021, Physical validation of simulators in computer graphics, section 4.1: a
// straight hair, clamped horizontally, under its weight.
namespace benchmarks::physics {

namespace {

constexpr std::uint32_t kCantileverSegments = 64;
constexpr std::uint32_t kThesisSegments = 7;
constexpr double kCantileverPatience = 20.0;  // s

struct Sag {
    double ratio;  // H / W: drop over reach; not a number if it hangs straight down
    bool hangs;
    bool still;
};

// Damped critically at the first frequency, which stiffness and weight make together, to come to
// rest soon.
Sag sagOf(
    const engine::Device& device, hair::SimulationSettings settings, std::uint32_t segments,
    double length) {
    const double stiff =
        2.0 * kPi *
        cantileverFrequency(
            bendingStiffness(settings.material), lineDensity(settings.material), length);
    const double heavy = 2.0 * kPi / hangingChainPeriod(length, kGravity);
    settings.friction = frictionOf(2.0 * std::hypot(stiff, heavy));
    Experiment experiment(device, straightStrand(segments, length, {1.0, 0.0, 0.0}), settings);
    const bool still = experiment.settle(1e-5 * length, kCantileverPatience);
    const glm::dvec3 tip = experiment.positions().back();
    const bool hangs = tip.x < 1e-3 * length;
    return {hangs ? std::numeric_limits<double>::quiet_NaN() : -tip.y / tip.x, hangs, still};
}

void remark(const Sag& sag, Outcome& outcome) {
    if (sag.hangs)
        outcome.reason = "hangs straight down";
    else if (!sag.still && outcome.reason.empty())
        outcome.reason = "still moving after 20 s";
}

// Promised of `rod` alone, with 64 segments. At Gamma = 1000 nearly all of the bend is within three
// segments of the clamp.
std::optional<double> toleranceOf(hair::Solver solver, double gamma) {
    if (solver != hair::Solver::rod) return {};
    return gamma <= 100.0 ? 0.02 : 0.05;
}

}  // namespace

void checkCantilever(
    const engine::Device& device, hair::Solver solver, std::span<const double> gammas,
    Findings& findings) {
    if (const auto why = lack(solver, Need::bending)) return findings.skip(*why);
    const hair::SimulationSettings settings = freeHair(solver);
    // The thesis's stiffness is for its own few segments; with more, iterations don't get far.
    std::vector<std::uint32_t> segment_counts{kCantileverSegments};
    if (lack(solver, Need::material)) segment_counts.push_back(kThesisSegments);
    for (const std::uint32_t segments : segment_counts) {
        std::vector<std::vector<double>> rows;
        for (const double gamma : gammas) {
            const double length = lengthOf(settings.material, gamma);
            const Sag sag = sagOf(device, settings, segments, length);
            const double expected = cantileverRatio(gamma);
            Outcome& outcome = findings.compare(
                {"H / W",
                 "1",
                 {{"gamma", gamma, "1"},
                  {"segments", static_cast<double>(segments), "count"},
                  {"length", length, "m"}}},
                sag.ratio, expected, toleranceOf(solver, gamma));
            remark(sag, outcome);
            rows.push_back({gamma, sag.ratio, expected});
        }
        findings.curve(
            "H / W, " + std::to_string(segments) + " segments",
            {{"gamma", "1"}, {"measured", "1"}, {"theory", "1"}}, std::move(rows));
    }
}

// Second-order methods quarter the error with every doubling; what is asked is that it falls, down
// to what single precision and the settling leave.
void checkConvergence(const engine::Device& device, hair::Solver solver, Findings& findings) {
    if (const auto why = lack(solver, Need::material)) return findings.skip(*why);
    constexpr double kGamma = 10.0;
    constexpr double kFloor = 2e-4;
    const hair::SimulationSettings settings = freeHair(solver);
    const double expected = cantileverRatio(kGamma);
    std::optional<double> tolerance;  // the coarsest has nothing to be better than
    std::vector<std::vector<double>> rows;
    for (const std::uint32_t segments : {8u, 16u, 32u, 64u, 128u}) {
        const Sag sag = sagOf(device, settings, segments, lengthOf(settings.material, kGamma));
        Outcome& outcome = findings.compare(
            {"H / W",
             "1",
             {{"gamma", kGamma, "1"}, {"segments", static_cast<double>(segments), "count"}}},
            sag.ratio, expected, tolerance);
        remark(sag, outcome);
        const double error = std::abs(sag.ratio / expected - 1.0);
        tolerance = worst(error, kFloor);
        rows.push_back({static_cast<double>(segments), error});
    }
    findings.curve(
        "error of H / W at gamma 10", {{"segments", "count"}, {"error", "1"}}, std::move(rows));
}

}  // namespace benchmarks::physics
