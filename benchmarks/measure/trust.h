#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/frame_loop.h"

// Whether times of passes can be believed.
namespace benchmarks::measure {

// How far timings may be off and still be believed, as a ratio.
inline constexpr double kTrustTolerance = 0.1;

// The names of all passes, in the order of their first appearance: not every frame runs every pass.
std::vector<std::string> passNames(std::span<const engine::FrameRecord> frames);

// The times of one pass, of the frames that ran it, ms.
std::vector<double> passTimes(std::span<const engine::FrameRecord> frames, const std::string& pass);

// The sum of a frame's pass times, ms.
double passSum(const engine::FrameRecord& frame);

// Median over frames of (sum of the passes / wall clock from submission to completion). 1 if the
// passes are all of the frame, the timestamps are right, and submitting takes no time.
double passSumOverWall(std::span<const engine::FrameRecord> isolated);

// What submitting nothing and waiting for it takes: from empty isolated frames.
struct EmptySubmission {
    double median = 0.0;  // ms
    double spread = 0.0;  // ms, from the median to the 95th percentile
};
EmptySubmission emptySubmission(std::span<const engine::FrameRecord> empty);

// The sum of the passes of isolated frames against two clocks that know nothing of each other. Each
// is a median over frames, and absent where the frames have no timestamps.
struct PassSum {
    std::optional<double> over_wall;
    std::optional<double> over_device;  // over the device's own first-to-last stamp
    std::optional<double> over_work;  // over the wall clock less an empty submission
    // Whether the passes are not the whole of the frame: by more than kTrustTolerance of the
    // device's time, or of the wall clock by more than that and what submissions vary by.
    bool incomplete = false;
};
PassSum passSums(std::span<const engine::FrameRecord> isolated, const EmptySubmission& empty);

// What a submission and the wait for it may add to a pass by itself, ms.
inline constexpr double kSubmissionCost = 0.5;

// Share of the whole frame that a pass may be off by: less than that misleads nobody about where
// the time goes.
inline constexpr double kFrameShare = 0.02;

// What is wrong with a device's timestamps: isolated frames by timestamps against frames whose
// passes were submitted and waited for one by one, the fastest of each. A pass is named if it is
// off by more than kTrustTolerance, kSubmissionCost and kFrameShare together. Empty: the timestamps
// are right.
std::vector<std::string> timestampFaults(
    std::span<const engine::FrameRecord> isolated, std::span<const engine::FrameRecord> wall_clock);

}  // namespace benchmarks::measure
