#include "benchmarks/physics/checks.h"
#include "benchmarks/physics/experiment.h"
#include "benchmarks/physics/solver_settings.h"
#include "benchmarks/physics/worst.h"

// By the equivalence principle nothing acts on hair that falls together with its head. The head
// goes along a true parabola, with a keyframe at every step: in between, the harmonic mean of
// slopes v and v + dv is off by dv^2 / 4 v, which moves substeps by less than 1e-6 m at the speeds
// below.
namespace benchmarks::physics {

namespace {

constexpr double kFallLength = 0.15;       // m
constexpr double kFallInterval = 1.0 / 240.0;  // of a step, s
constexpr int kKeyframes = 145;            // to 0.6 s
constexpr double kFallStart = 0.1;         // s
constexpr double kFallEnd = 0.5;           // s
// Rounding of positions in single precision, 1.2e-7 m at 1 m, taken for motion in each of 96 steps:
// at most 96^2 / 2 times that, which is 0.4 % of the length, and a tenth of it by chance.
constexpr double kFallTolerance = 1e-3;

glm::dvec3 fallen(double time) {
    return time * glm::dvec3(0.5, -0.5, 0.3) + 0.5 * time * time * glm::dvec3(0.0, -kGravity, 0.0);
}

std::vector<glm::dvec3> moved(std::vector<glm::dvec3> points, const glm::dvec3& by) {
    for (glm::dvec3& point : points) point += by;
    return points;
}

}  // namespace

void checkFreeFall(const engine::Device& device, hair::Solver solver, Findings& findings) {
    hair::SimulationSettings settings = defaultHair(solver);
    settings.friction = 0.0f;  // against the air, which does not fall
    settings.time_step = static_cast<float>(kFallInterval);
    for (int i = 0; i < kKeyframes; ++i)
        settings.motion.keyframes.push_back(
            {.time = static_cast<float>(i * kFallInterval),
             .rotation = {},
             .translation = fallen(i * kFallInterval)});
    Experiment experiment(device, curvedStrand(15, kFallLength, 8.0), settings);
    const std::vector<glm::dvec3> rest = experiment.positions();

    experiment.advance(experiment.stepsIn(kFallStart));
    const double h = experiment.substep();
    const glm::dvec3 velocity = (fallen(kFallStart) - fallen(kFallStart - h)) / h;
    experiment.launch(
        moved(rest, fallen(kFallStart)), std::vector<glm::dvec3>(rest.size(), velocity));

    double farthest = 0.0;
    for (int i = 1; i <= 8; ++i) {
        experiment.advance(experiment.stepsIn((kFallEnd - kFallStart) / 8.0));
        const double time = kFallStart + i * (kFallEnd - kFallStart) / 8.0;
        farthest =
            worst(farthest, greatestDistance(experiment.positions(), moved(rest, fallen(time))));
    }
    findings.deviation(
        {"deformation / length", "1", {{"time_step", experiment.timeStep(), "s"}}},
        farthest / kFallLength, kFallTolerance);
}

}  // namespace benchmarks::physics
