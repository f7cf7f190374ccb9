#pragma once

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
// passes are all of the frame and the timestamps are right.
double passSumOverWall(std::span<const engine::FrameRecord> isolated);

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
