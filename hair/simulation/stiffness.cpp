#include "hair/simulation/stiffness.h"

#include <algorithm>
#include <cmath>

#include "hair/simulation/head_motion.h"

namespace hair::simulation {
namespace {

// Factor from a joint that turns its lower segment to one that turns both: stiffness.h.
constexpr double kBendOfPull = 4.0;
constexpr double kShortestMean = 1e-5;  // of segments, m: K is a float

double substepRatio(const gpu::Step& step) { return double{step.sub} / kReferenceStep; }

}  // namespace

double velocityKept(const SimulationSettings& settings, const gpu::Step& step) {
    const double kept = 1.0 - double{settings.friction};
    if (settings.stiffness_scaling == StiffnessScaling::thesis) return kept;
    return std::pow(kept, substepRatio(step));
}

double globalStiffness(const SimulationSettings& settings, const gpu::Step& step) {
    const double k = settings.global.stiffness;
    if (settings.stiffness_scaling == StiffnessScaling::thesis || k >= 1.0) return k;
    const double c = k / (1.0 - k) * std::pow(substepRatio(step), 2.0);
    return c / (1.0 + c);
}

double
localStiffness(const SimulationSettings& settings, const gpu::Step& step, double segment_length) {
    const double k = std::min(double{settings.local.stiffness}, kGreatestLocalStiffness);
    if (k == 0.0 || settings.local.iterations == 0) return 0.0;
    if (settings.stiffness_scaling == StiffnessScaling::thesis) return k;
    if (segment_length <= 0.0) return kGreatestLocalStiffness;

    const double scale =
        std::pow(substepRatio(step), 2.0) * std::pow(kReferenceSegment / segment_length, 4.0);
    const double exponent = kReferenceIterations / settings.local.iterations * scale;
    return std::min(-std::expm1(exponent * std::log1p(-k)), kGreatestLocalStiffness);
}

double
bendStiffness(const SimulationSettings& settings, const gpu::Step& step, double segment_length) {
    const double k = std::min(double{settings.local.stiffness}, kGreatestLocalStiffness);
    const double pulls = -std::log1p(-k);
    if (settings.stiffness_scaling == StiffnessScaling::thesis)
        return kBendOfPull / 2.0 * settings.local.iterations * pulls;
    const double scale = std::pow(substepRatio(step), 2.0) *
                         std::pow(kReferenceSegment / std::max(segment_length, kShortestMean), 4.0);
    return kBendOfPull / 2.0 * kReferenceIterations * pulls * scale;
}

double bendDamping(const gpu::Step& step) { return std::max(1.0, 1.0 / substepRatio(step)); }

glm::dvec3 gravityOnGroom(const SimulationSettings& settings) {
    const RigidMotion head = HeadMotion(settings.motion).at(0.0);
    return glm::conjugate(head.rotation) * glm::dvec3(settings.gravity);
}

}  // namespace hair::simulation
