#pragma once

#include "benchmarks/run/plan.h"
#include "engine/device.h"

// Estimates the cost of a run within seconds.
namespace benchmarks::measure {
class HairCache;
}  // namespace benchmarks::measure

namespace benchmarks::run {

// Amount of work in a frame of a case, from its settings alone.
struct FrameWork {
    double updates = 0.0;  // vertices of guides, in all substeps
    double segments = 0.0;  // drawn segments of strands
    double samples = 0.0;  // samples of the picture and the shadow maps
};
FrameWork frameWork(const hair::Settings& settings);

// Whether creating a case and drawing two frames takes about a second, on a device `speed` times as
// fast as a software device on two cores.
bool isSmall(const hair::Settings& settings, double speed);

// Reduces a case's settings until it is small on any device: fewer strands, guides, pixels and
// lights, no settling, coarse distance fields and shadows.
hair::Settings smaller(const hair::Settings& settings);

// Costs differ between kinds of cases: a trial of one kind tells nothing about another.
struct CaseKind {
    hair::Backend backend{};
    hair::ShadingModel shading{};
    hair::Solver solver{};

    auto operator<=>(const CaseKind&) const = default;
};
CaseKind kindOf(const hair::Settings& settings);

// Returns an upper bound of the ratio of frame times, `of` over `tried`, if times grow at most
// linearly with each part of the work: the sum of the parts then grows at most as much as the part
// that grows most.
double mostTimesLonger(const FrameWork& of, const FrameWork& tried);

// Prints an upper bound of the time of each case, from its creation to its last round, and the sum.
// Tries two frames of cases: first those with the most work of a sort, made smaller(), then one of
// each CaseKind, then the small cases unchanged until some seconds are over. Estimates the times of
// other cases from those of their kind by mostTimesLonger() and marks them as estimates. Memory is
// the device memory that a case held if it was tried unchanged, otherwise an upper bound
// (measure/memory_need.h). Cases that do not fit are not tried. Without a device, prints only the
// names and the reason. Returns the exit status.
int estimateRun(
    const RunPlan& plan, const engine::DeviceOptions& device, measure::HairCache& cache);

}  // namespace benchmarks::run
