#include <cmath>

#include <glm/geometric.hpp>

#include "benchmarks/physics/checks.h"
#include "benchmarks/physics/lively.h"
#include "benchmarks/physics/worst.h"
#include "benchmarks/statistics.h"

namespace benchmarks::physics {

namespace {

constexpr double kStretchTolerance = 0.01;  // of the worst segment, promised of `rod`

}  // namespace

void checkLength(const engine::Device& device, hair::Solver solver, Findings& findings) {
    const hair::SimulationSettings settings = livelyHair(solver);
    const hair::Groom groom = livelyGroom();
    const double rest = kLivelyLength / groom.segmentsPerStrand();
    Experiment experiment(device, groom, settings);

    std::vector<double> errors;  // of every segment after every step
    double greatest = 0.0;
    double squares = 0.0;
    for (std::uint32_t step = 0; step < experiment.stepsIn(2.0); ++step) {
        experiment.advance(1);
        const std::vector<glm::dvec3> points = experiment.positions();
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (i % groom.vertices_per_strand == 0) continue;
            errors.push_back(std::abs(glm::distance(points[i], points[i - 1]) / rest - 1.0));
            greatest = worst(greatest, errors.back());
            squares += errors.back() * errors.back();
        }
    }
    const std::vector<Parameter> parameters{{"time_step", experiment.timeStep(), "s"}};
    std::optional<double> tolerance;
    if (solver == hair::Solver::rod) tolerance = kStretchTolerance;
    findings.deviation(
        {"greatest error of a segment's length", "1", parameters}, greatest, tolerance);
    findings.deviation(
        {"99th percentile", "1", parameters},
        std::isnan(greatest) ? greatest : quantile(errors, 0.99));
    findings.deviation(
        {"root mean square", "1", parameters},
        std::sqrt(squares / static_cast<double>(errors.size())));
}

}  // namespace benchmarks::physics
