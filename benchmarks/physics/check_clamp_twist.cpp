#include <cmath>

#include "benchmarks/physics/checks.h"
#include "benchmarks/physics/experiment.h"
#include "benchmarks/physics/solver_settings.h"
#include "benchmarks/physics/vibration.h"

// Nothing holds a curl's free end, so in the end there is no torque and no twist in it: it must
// turn as far as its root does about its own axis.
namespace benchmarks::physics {

namespace {

constexpr std::uint32_t kTwistSegments = 32;
constexpr double kTwistLength = 0.1;      // m
constexpr double kTwistCurvature = 15.0;  // 1/m
constexpr double kTwistTurn = 90.0;       // deg, within 0.5 s
constexpr double kTwistTolerance = 0.02;  // as promised of the rod's statics

}  // namespace

void checkClampTwist(const engine::Device& device, hair::Solver solver, Findings& findings) {
    if (const auto why = lack(solver, Need::bending)) return findings.skip(*why);
    hair::SimulationSettings settings = freeHair(solver);
    settings.gravity = {};
    settings.friction = frictionOf(20.0);
    settings.motion.keyframes = {
        {.time = 0.0f},
        {.time = 0.5f,
         .rotation = {0.0f, static_cast<float>(kTwistTurn), 0.0f},
         .translation = {}}};
    Experiment experiment(
        device, curvedStrand(kTwistSegments, kTwistLength, kTwistCurvature), settings);
    experiment.advance(experiment.stepsIn(0.5));
    const bool still = experiment.settle(1e-5 * kTwistLength, 20.0);

    const glm::dvec3 tip = experiment.positions().back();  // at rest at x > 0, z = 0
    std::optional<double> tolerance;
    if (!lack(solver, Need::material)) tolerance = kTwistTolerance;
    Outcome& outcome = findings.compare(
        {"turn of the tip",
         "deg",
         {{"segments", double{kTwistSegments}, "count"}, {"curvature", kTwistCurvature, "1/m"}}},
        std::atan2(-tip.z, tip.x) * 180.0 / kPi, kTwistTurn, tolerance);
    if (!still && outcome.reason.empty()) outcome.reason = "still moving after 20 s";
}

}  // namespace benchmarks::physics
