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

// Checks whether times of passes can be trusted.
namespace benchmarks::measure {

// Greatest time that a submission and the wait for it add to a pass by itself, ms.
inline constexpr double kSubmissionCost = 0.5;

// Largest error of a pass, as a share of the whole frame. A smaller error does not mislead about
// where the time goes.
inline constexpr double kFrameShare = 0.02;

// Faults of a device's timestamps: compares isolated frames by timestamps with frames whose passes
// were submitted and waited for one by one, using the fastest of each. A pass is named if it
// differs by more than report::kTrustTolerance, kSubmissionCost and kFrameShare together. Empty:
// the timestamps are right.
std::vector<std::string> timestampFaults(
    std::span<const engine::FrameRecord> isolated, std::span<const engine::FrameRecord> wall_clock);

// Plays frames in one timing mode.
struct PlayedFrames {
    std::function<void()> play;  // one frame
    std::function<std::vector<engine::FrameRecord>()> finish;  // waits; frames since the last call
};

// Alternates isolated frames with frames whose passes are submitted and waited for one at a time,
// and returns the result of timestampFaults(). A fault of the device persists, but a disturbance
// passes: while there are faults, more pairs are played, up to 16 and while `is_time` is true. An
// empty `is_time` sets no limit.
std::vector<std::string> checkTimestamps(
    const PlayedFrames& timestamped, const PlayedFrames& clocked,
    const std::function<bool()>& is_time = {});

// Checks the timestamps of a case in the same way, and their rate too (trust.timestamp_rate),
// without a time limit. Passes of some microseconds are shorter than their submission. On a GPU,
// work of 10 ms is therefore planted in one pass after another, and both clocks must find all of it
// there and nowhere else.
std::vector<std::string> checkTimestamps(Stage& stage, report::CaseResult& result);

// The verdict on a case's timestamps.
struct TimestampJudgement {
    enum class Verdict { right, wrong, unchecked };
    Verdict verdict = Verdict::unchecked;
    std::vector<std::string> faults;  // for an unchecked case, from frames that were not alternated
};

// Judges the timestamps of isolated frames. On a processor they are compared with wall-clock frames
// that were played anyway; alternating pairs are played only if the two differ. On other devices
// planted work is used as in checkTimestamps(). Both take at most `seconds`; whatever does not fit
// is unchecked. `known` remembers the passes found right. In a run, frames of the same passes are
// not checked again, and unchecked passes are checked later. It may be null.
TimestampJudgement judgeTimestamps(
    Stage& stage, std::span<const engine::FrameRecord> isolated,
    std::span<const engine::FrameRecord> wall_clock, double seconds, DeviceKnowledge* known,
    report::CaseResult& result);

}  // namespace benchmarks::measure
