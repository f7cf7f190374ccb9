#include <glm/geometric.hpp>

#include "benchmarks/physics/checks.h"
#include "benchmarks/physics/experiment.h"
#include "benchmarks/physics/free_flight.h"
#include "benchmarks/physics/solver_settings.h"
#include "benchmarks/physics/worst.h"

namespace benchmarks::physics {

namespace {

// n steps of Verlet in single precision at up to 4 m add up to about 1.5e-4 m of rounding, or 3e-5
// of the drop (a random walk of velocity, 0.3 ulp a step); three times that.
constexpr double kProjectileTolerance = 1e-4;

}  // namespace

void checkProjectile(const engine::Device& device, hair::Solver solver, Findings& findings) {
    if (const auto why = lack(solver, Need::free_vertices)) return findings.skip(*why);

    hair::SimulationSettings settings = freeHair(solver);
    settings.time_step = 1.0f / 240.0f;
    settings.local.iterations = 0;
    settings.length.iterations = 0;
    Experiment experiment(device, straightStrand(1, 0.15, {0.0, -1.0, 0.0}), settings);

    const glm::dvec3 velocity{1.0, 3.0, -2.0};
    const glm::dvec3 start = experiment.positions()[1];
    experiment.launch(experiment.positions(), std::vector<glm::dvec3>{glm::dvec3(0.0), velocity});
    const std::uint32_t steps = experiment.stepsIn(1.0);
    const std::uint32_t part = 24;
    double farthest = 0.0;
    for (std::uint32_t n = part; n <= steps; n += part) {
        experiment.advance(part);
        const glm::dvec3 flown = verletFlight(n, velocity, settings.gravity, experiment.substep());
        farthest = worst(farthest, glm::distance(experiment.positions()[1], start + flown));
    }
    const double drop = 0.5 * kGravity;  // in 1 s
    findings.deviation(
        {"deviation from the parabola / drop", "1", {{"time_step", experiment.timeStep(), "s"}}},
        farthest / drop, kProjectileTolerance);
}

}  // namespace benchmarks::physics
