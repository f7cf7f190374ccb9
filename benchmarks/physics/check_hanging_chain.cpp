#include <limits>

#include "benchmarks/physics/checks.h"
#include "benchmarks/physics/solver_settings.h"
#include "benchmarks/physics/vibrate.h"
#include "benchmarks/physics/vibration.h"

namespace benchmarks::physics {

namespace {

constexpr std::uint32_t kHangingSegments = 64;
constexpr double kHangingLength = 0.3;       // m
constexpr float kHangingTimeStep = 0.001f;   // s
constexpr glm::dvec3 kHangingDown{0.0, -1.0, 0.0};
constexpr glm::dvec3 kHangingSideways{1.0, 0.0, 0.0};

// 64 equal masses swing 0.4 % slower than a chain does; a rod of Gamma = 10^6 swings 0.1 % faster.
constexpr double kHangingTolerance = 0.01;

}  // namespace

void checkHangingChain(const engine::Device& device, hair::Solver solver, Findings& findings) {
    hair::SimulationSettings settings = chain(solver, kHangingLength);
    settings.time_step = kHangingTimeStep;
    settings.substeps = 1;
    const double segment = kHangingLength / kHangingSegments;
    std::vector<double> shape = pendulumModes(kHangingSegments, segment, kGravity).front().shape;
    shape.insert(shape.begin(), 0.0);  // the root
    const double period = hangingChainPeriod(kHangingLength, kGravity);

    Experiment experiment(
        device, straightStrand(kHangingSegments, kHangingLength, kHangingDown), settings);
    const auto frequency = measureFrequency(
        experiment, {.shape = shape,
                     .segment = segment,
                     .direction = kHangingDown,
                     .sideways = kHangingSideways,
                     .expected_frequency = 1.0 / period});
    std::optional<double> tolerance;
    if (solver != hair::Solver::ftl) tolerance = kHangingTolerance;
    Outcome& outcome = findings.compare(
        {"first period",
         "s",
         {{"segments", double{kHangingSegments}, "count"}, {"length", kHangingLength, "m"}}},
        frequency ? 1.0 / *frequency : std::numeric_limits<double>::quiet_NaN(), period, tolerance);
    if (!frequency) outcome.reason = "it does not swing";
}

}  // namespace benchmarks::physics
