#include <limits>

#include "benchmarks/physics/checks.h"
#include "benchmarks/physics/solver_settings.h"
#include "benchmarks/physics/vibrate.h"
#include "benchmarks/physics/vibration.h"

namespace benchmarks::physics {

namespace {

constexpr std::uint32_t kBendingSegments = 32;
constexpr double kBendingLength = 0.1;       // m
constexpr float kBendingTimeStep = 0.0005f;  // s; implicit steps damp by w h / 2 = 0.3 % a radian
constexpr double kBendingTolerance = 0.02;  // promised of `rod`

constexpr glm::dvec3 kBendingAlong{1.0, 0.0, 0.0};
constexpr glm::dvec3 kBendingSideways{0.0, 1.0, 0.0};

}  // namespace

void checkBendingFrequency(const engine::Device& device, hair::Solver solver, Findings& findings) {
    if (const auto why = lack(solver, Need::bending)) return findings.skip(*why);
    hair::SimulationSettings settings = freeHair(solver);
    settings.gravity = {};
    settings.time_step = kBendingTimeStep;
    settings.substeps = 1;
    const double expected = cantileverFrequency(
        bendingStiffness(settings.material), lineDensity(settings.material), kBendingLength);
    std::vector<double> shape;
    for (std::uint32_t i = 0; i <= kBendingSegments; ++i)
        shape.push_back(cantileverShape(static_cast<double>(i) / kBendingSegments));

    Experiment experiment(
        device, straightStrand(kBendingSegments, kBendingLength, kBendingAlong), settings);
    const auto frequency = measureFrequency(
        experiment, {.shape = shape,
                     .segment = kBendingLength / kBendingSegments,
                     .direction = kBendingAlong,
                     .sideways = kBendingSideways,
                     .expected_frequency = expected});
    std::optional<double> tolerance;
    if (!lack(solver, Need::material)) tolerance = kBendingTolerance;
    Outcome& outcome = findings.compare(
        {"first frequency",
         "Hz",
         {{"segments", double{kBendingSegments}, "count"}, {"length", kBendingLength, "m"}}},
        frequency.value_or(std::numeric_limits<double>::quiet_NaN()), expected, tolerance);
    if (!frequency) outcome.reason = "it does not swing";
}

}  // namespace benchmarks::physics
