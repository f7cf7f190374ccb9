#include <limits>

#include "benchmarks/physics/checks.h"
#include "benchmarks/physics/solver_settings.h"
#include "benchmarks/physics/vibrate.h"
#include "benchmarks/physics/vibration.h"

namespace benchmarks::physics {

namespace {

constexpr double kPendulumLink = 0.05;  // m
// w h. Projection along the predicted links lowers the frequency by (w h)^2 / 3, 8e-4. A much
// smaller step, or many iterations, would measure single precision instead: of a correction along a
// hanging link, the part down the link is lost when it is below the rounding of the position, while
// the part across still counts, in every iteration.
constexpr double kPhasePerStep = 0.05;
constexpr std::uint32_t kPendulumIterations = 32;  // five links take about ten
// The above, the amplitude (6e-5), and rounding for as much again.
constexpr double kPendulumTolerance = 0.005;

constexpr glm::dvec3 kPendulumDown{0.0, -1.0, 0.0};
constexpr glm::dvec3 kPendulumSideways{1.0, 0.0, 0.0};

}  // namespace

void checkPendulum(
    const engine::Device& device, hair::Solver solver, std::span<const unsigned> masses,
    Findings& findings) {
    if (const auto why = lack(solver, Need::equal_masses)) return findings.skip(*why);
    for (const unsigned count : masses) {
        hair::SimulationSettings settings = chain(solver, count * kPendulumLink);
        settings.length.iterations = kPendulumIterations;
        settings.substeps = 1;
        unsigned number = 0;
        for (PendulumMode& mode : pendulumModes(count, kPendulumLink, kGravity)) {
            settings.time_step = static_cast<float>(kPhasePerStep / (2.0 * kPi * mode.frequency));
            mode.shape.insert(mode.shape.begin(), 0.0);  // the root
            Experiment experiment(
                device, straightStrand(count, count * kPendulumLink, kPendulumDown), settings);
            const auto frequency = measureFrequency(
                experiment, {.shape = mode.shape,
                             .segment = kPendulumLink,
                             .direction = kPendulumDown,
                             .sideways = kPendulumSideways,
                             .expected_frequency = mode.frequency});
            std::optional<double> tolerance;
            if (solver == hair::Solver::shape) tolerance = kPendulumTolerance;
            Outcome& outcome = findings.compare(
                {"frequency",
                 "Hz",
                 {{"masses", static_cast<double>(count), "count"},
                  {"mode", static_cast<double>(++number), "count"}}},
                frequency.value_or(std::numeric_limits<double>::quiet_NaN()), mode.frequency,
                tolerance);
            if (!frequency) outcome.reason = "it does not swing";
        }
    }
}

}  // namespace benchmarks::physics
