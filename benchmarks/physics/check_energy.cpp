#include <cmath>
#include <limits>

#include "benchmarks/physics/checks.h"
#include "benchmarks/physics/energy.h"
#include "benchmarks/physics/experiment.h"
#include "benchmarks/physics/solver_settings.h"
#include "benchmarks/physics/worst.h"
#include "hair/simulation/solver.h"

// A hair let go from the horizontal. What its energy is compared with is the weight's at half its
// length: what it loses from there to hanging down.
namespace benchmarks::physics {

namespace {

constexpr std::uint32_t kEnergySegments = 16;
constexpr double kEnergyLength = 0.15;  // m
constexpr double kEnergyWindow = 0.25;  // s
// The sampled energy of one window may pass that of the one before by rounding and by what the
// samples miss of the true maximum.
constexpr double kEnergyTolerance = 1e-3;

std::vector<double>
energies(const engine::Device& device, const hair::SimulationSettings& settings, double seconds) {
    Experiment experiment(
        device, straightStrand(kEnergySegments, kEnergyLength, {1.0, 0.0, 0.0}), settings);
    const double scale =
        lineDensity(settings.material) * kGravity * kEnergyLength * kEnergyLength / 2.0;
    std::vector<double> samples;
    std::vector<glm::dvec3> before = experiment.positions();
    for (std::uint32_t i = 0; i < experiment.stepsIn(seconds); ++i) {
        experiment.advance(1);
        std::vector<glm::dvec3> after = experiment.positions();
        samples.push_back(energyOf(before, after, settings, kEnergyLength) / scale);
        before = std::move(after);
    }
    return samples;
}

// Slope of the straight line through the samples (least squares), per interval.
double slopeOf(std::span<const double> samples) {
    const double middle = static_cast<double>(samples.size() - 1) / 2.0;
    double products = 0.0;
    double squares = 0.0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double t = static_cast<double>(i) - middle;
        products += t * samples[i];
        squares += t * t;
    }
    return products / squares;
}

// By how much the greatest energy of a window passes that of the window before.
double greatestGrowth(std::span<const double> samples, std::size_t window) {
    double growth = 0.0;
    double before = std::numeric_limits<double>::infinity();
    for (std::size_t start = 0; start + window <= samples.size(); start += window) {
        double greatest = samples[start];
        for (const double sample : samples.subspan(start, window))
            greatest = worst(greatest, sample);
        growth = worst(growth, greatest - before);
        before = greatest;
    }
    return growth;
}

}  // namespace

void checkEnergy(const engine::Device& device, hair::Solver solver, Findings& findings) {
    // A solver step at a time, or what happens between two looks would be averaged.
    hair::SimulationSettings settings = freeHair(solver);
    settings.time_step = hair::stepOf(settings).sub;
    settings.substeps = 1;
    // Shape constraints have no energy that could be counted, nor has what segments are too long
    // by.
    settings.local.stiffness = 0.0f;
    settings.length.iterations = 64;
    const double step = settings.time_step;
    const std::vector<Parameter> parameters{{"time_step", step, "s"}};
    findings.value(
        {"drift without friction, per second", "1/s", parameters},
        slopeOf(energies(device, settings, 2.0)) / step);

    settings.friction = defaultHair(solver).friction;
    findings.deviation(
        {"growth from window to window with friction", "1", parameters},
        greatestGrowth(
            energies(device, settings, 4.0),
            static_cast<std::size_t>(std::lround(kEnergyWindow / step))),
        kEnergyTolerance);
}

}  // namespace benchmarks::physics
