#include <cmath>

#include "benchmarks/physics/catenary.h"
#include "benchmarks/physics/checks.h"
#include "benchmarks/physics/experiment.h"
#include "benchmarks/physics/solver_settings.h"

namespace benchmarks::physics {

namespace {

constexpr std::uint32_t kSegments = 32;
constexpr double kLength = 0.2;  // m
constexpr double kSpan = 0.1;    // m
// Of 32 links instead of a chain: l^2 / (8 a L) at the lowest point, 0.04 %; the rest is for the
// solver's stretch, and a rod's stiffness at its clamp.
constexpr double kTolerance = 0.01;

// Two straight halves from pin to pin.
hair::Groom vee() {
    const double depth = std::sqrt(kLength * kLength - kSpan * kSpan) / 2.0;
    hair::Groom groom = straightStrand(kSegments, kLength, {0.0, -1.0, 0.0});
    for (std::uint32_t i = 0; i <= kSegments; ++i) {
        const double s = 2.0 * i / kSegments;
        groom.points[i] = {kSpan / 2.0 * s, -depth * (s < 1.0 ? s : 2.0 - s), 0.0};
    }
    return groom;
}

}  // namespace

void checkCatenary(const engine::Device& device, hair::Solver solver, Findings& findings) {
    if (const auto why = lack(solver, Need::pinned_tip)) return findings.skip(*why);
    hair::SimulationSettings settings = chain(solver, kLength);
    settings.time_step = 1.0f / 480.0f;
    settings.substeps = 1;
    settings.friction = frictionOf(std::sqrt(kGravity / kLength) * 2.0);
    Experiment experiment(device, vee(), settings);
    experiment.pin(kSegments);
    const bool still = experiment.settle(1e-5 * kLength, 10.0);

    const Catenary catenary(kSpan, kLength);
    std::vector<glm::dvec3> expected;
    for (std::uint32_t i = 0; i <= kSegments; ++i)
        expected.emplace_back(catenary.at(kLength * i / kSegments), 0.0);
    Outcome& outcome = findings.deviation(
        {"deviation / length",
         "1",
         {{"segments", double{kSegments}, "count"}, {"span / length", kSpan / kLength, "1"}}},
        greatestDistance(experiment.positions(), expected) / kLength, kTolerance);
    if (!still && outcome.reason.empty()) outcome.reason = "still moving after 10 s";
}

}  // namespace benchmarks::physics
