#include <cmath>

#include "benchmarks/physics/checks.h"
#include "benchmarks/physics/experiment.h"
#include "benchmarks/physics/solver_settings.h"
#include "benchmarks/physics/worst.h"

// The set-up of the bend-twist test of Romero et al. 2021: a curl that hangs from a clamp stays in
// its plane where its weight rules, and winds out of it where its curvature does; cbrt(Gamma) /
// (curvature times length) tells which. No value of the boundary is stated here, so none is asked
// for.
namespace benchmarks::physics {

namespace {

constexpr std::uint32_t kBendTwistSegments = 64;
constexpr double kBendTwistGamma = 100.0;
constexpr double kBendTwistPush = 0.05;  // out of the plane at the tip, m/s

}  // namespace

void checkBendTwist(const engine::Device& device, hair::Solver solver, Findings& findings) {
    if (const auto why = lack(solver, Need::material)) return findings.skip(*why);
    hair::SimulationSettings settings = freeHair(solver);
    const double length = lengthOf(settings.material, kBendTwistGamma);
    settings.friction = frictionOf(2.0 * std::sqrt(kGravity / length));
    std::vector<std::vector<double>> rows;
    for (const double turn : {2.0, 4.0, 8.0, 16.0}) {
        Experiment experiment(
            device, curvedStrand(kBendTwistSegments, length, turn / length), settings);
        std::vector<glm::dvec3> push;
        for (std::uint32_t i = 0; i <= kBendTwistSegments; ++i)
            push.emplace_back(0.0, 0.0, kBendTwistPush * i / kBendTwistSegments);
        experiment.launch(experiment.positions(), push);
        const bool still = experiment.settle(1e-5 * length, 20.0);
        double extent = 0.0;
        for (const glm::dvec3& point : experiment.positions())
            extent = worst(extent, std::abs(point.z) / length);
        const double ratio = std::cbrt(kBendTwistGamma) / turn;
        Outcome& outcome = findings.value(
            {"distance from its plane / length",
             "1",
             {{"gamma", kBendTwistGamma, "1"}, {"curvature * length", turn, "rad"}}},
            extent);
        if (!still && outcome.reason.empty()) outcome.reason = "still moving after 20 s";
        rows.push_back({ratio, extent});
    }
    findings.curve(
        "distance from its plane, gamma 100",
        {{"cbrt(gamma) / (curvature * length)", "1"}, {"distance / length", "1"}}, std::move(rows));
}

}  // namespace benchmarks::physics
