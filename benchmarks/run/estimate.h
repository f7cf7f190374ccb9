#pragma once

#include "benchmarks/run/plan.h"
#include "engine/device.h"

// What a run would take, found out in seconds.
namespace benchmarks::measure {
class HairCache;
}  // namespace benchmarks::measure

namespace benchmarks::run {

// How much there is to do in a frame of a case, by its settings alone.
struct FrameWork {
    double updates = 0.0;  // of guides' vertices, in all substeps
    double segments = 0.0;  // of strands, drawn
    double samples = 0.0;  // of the picture's pixels
};
FrameWork frameWork(const hair::Settings& settings);

// Whether making a case and drawing two frames takes a second or so on a device that is so many
// times faster than a software device on two cores.
bool isSmall(const hair::Settings& settings, double speed);

// A case's settings with less of what takes time, so that it is small on any device: fewer strands,
// guides, pixels and lights, no settling, coarse distance fields and shadows.
hair::Settings smaller(const hair::Settings& settings);

// How many times longer a frame of `of` takes than one of `tried` at most, if times grow with each
// part of the work and not faster: a sum of such parts grows no more than the part that grows most.
double mostTimesLonger(const FrameWork& of, const FrameWork& tried);

// Prints each case with how long measuring it takes at most, and the sum. Cases are tried by two of
// their frames: those with the most work of a kind made smaller(), then those that are small as
// they are, until some seconds are over. Other cases' times are estimated from those by
// mostTimesLonger(), and said to be. The memory is the device's that cases held which were tried as
// they are, and of others what they need at most (measure/memory_need.h); those that do not fit are
// not tried. Where there is no device, names alone and why. Returns the exit status.
int estimateRun(
    const RunPlan& plan, const engine::DeviceOptions& device, measure::HairCache& cache);

}  // namespace benchmarks::run
