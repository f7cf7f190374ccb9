#include <cmath>

#include "benchmarks/physics/catenary.h"
#include "benchmarks/physics/checks.h"
#include "benchmarks/physics/experiment.h"
#include "benchmarks/physics/solver_settings.h"

namespace benchmarks::physics {

namespace {

constexpr std::uint32_t kCatenarySegments = 32;
constexpr double kCatenaryLength = 0.2;  // m
constexpr double kCatenarySpan = 0.1;    // m
// Of 32 links instead of a chain: l^2 / (8 a L) at the lowest point, 0.04 %; the rest is for the
// solver's stretch, and a rod's stiffness at its clamp.
constexpr double kCatenaryTolerance = 0.01;

// Two straight halves from pin to pin.
hair::Groom vee() {
    const double depth =
        std::sqrt(kCatenaryLength * kCatenaryLength - kCatenarySpan * kCatenarySpan) / 2.0;
    hair::Groom groom = straightStrand(kCatenarySegments, kCatenaryLength, {0.0, -1.0, 0.0});
    for (std::uint32_t i = 0; i <= kCatenarySegments; ++i) {
        const double s = 2.0 * i / kCatenarySegments;
        groom.points[i] = {kCatenarySpan / 2.0 * s, -depth * (s < 1.0 ? s : 2.0 - s), 0.0};
    }
    return groom;
}

}  // namespace

void checkCatenary(const engine::Device& device, hair::Solver solver, Findings& findings) {
    if (const auto why = lack(solver, Need::pinned_tip)) return findings.skip(*why);
    hair::SimulationSettings settings = chain(solver, kCatenaryLength);
    settings.time_step = 1.0f / 480.0f;
    settings.substeps = 1;
    settings.friction = frictionOf(std::sqrt(kGravity / kCatenaryLength) * 2.0);
    Experiment experiment(device, vee(), settings);
    experiment.pin(kCatenarySegments);
    const bool still = experiment.settle(1e-5 * kCatenaryLength, 10.0);

    const Catenary catenary(kCatenarySpan, kCatenaryLength);
    std::vector<glm::dvec3> expected;
    for (std::uint32_t i = 0; i <= kCatenarySegments; ++i)
        expected.emplace_back(catenary.at(kCatenaryLength * i / kCatenarySegments), 0.0);
    Outcome& outcome = findings.deviation(
        {"deviation / length",
         "1",
         {{"segments", double{kCatenarySegments}, "count"},
          {"span / length", kCatenarySpan / kCatenaryLength, "1"}}},
        greatestDistance(experiment.positions(), expected) / kCatenaryLength, kCatenaryTolerance);
    if (!still && outcome.reason.empty()) outcome.reason = "still moving after 10 s";
}

}  // namespace benchmarks::physics
