#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/measure/metrics.h"
#include "benchmarks/measure/stage.h"
#include "benchmarks/report/report.h"
#include "engine/frame_loop.h"

// Whether times of passes can be believed.
namespace benchmarks::measure {

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

// Something that plays frames in one timing mode.
struct PlayedFrames {
    std::function<void()> play;  // one frame
    std::function<std::vector<engine::FrameRecord>()> finish;  // waits; frames since the last call
};

// Plays isolated frames and frames whose passes are submitted and waited for one at a time, in
// turns, and returns what timestampFaults() finds. A fault of the device stays, a disturbance
// passes: while there are faults more pairs are played, up to 16 and while there `is_time`; empty:
// there is.
std::vector<std::string> checkTimestamps(
    const PlayedFrames& stamped, const PlayedFrames& clocked,
    const std::function<bool()>& is_time = {});

// The same for a case, and what is wrong with the timestamps' rate (trust.timestamp_rate), however
// long it takes. Passes of some microseconds are shorter than what submitting them takes: on a
// device that is no processor work of 10 ms is planted in one pass after another, and both clocks
// have to find it there, all of it, and nowhere else.
std::vector<std::string> checkTimestamps(Stage& stage, report::CaseResult& result);

// What is known of a case's timestamps.
struct TimestampJudgement {
    enum class Verdict { right, wrong, unchecked };
    Verdict verdict = Verdict::unchecked;
    std::vector<std::string> faults;  // found, of unchecked ones by frames that were not in turns
};

// Judges the timestamps of isolated frames. On a processor they are held against wall-clock frames
// that were played anyway; pairs are played in turns only where the two differ. On other devices
// planted work is looked for as in checkTimestamps(). Either takes at most `seconds`, and what has
// no time is unchecked: `known` keeps which passes were found right, and frames of the same passes
// are not checked again in a run but what was left is. It may be null.
TimestampJudgement judgeTimestamps(
    Stage& stage, std::span<const engine::FrameRecord> isolated,
    std::span<const engine::FrameRecord> wall_clock, double seconds, DeviceKnowledge* known,
    report::CaseResult& result);

}  // namespace benchmarks::measure
