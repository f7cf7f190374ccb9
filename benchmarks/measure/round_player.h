#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/case.h"
#include "benchmarks/measure.h"
#include "benchmarks/measure/busy_passes.h"
#include "engine/frame_loop.h"

namespace benchmarks {

// What a case's frames are played with.
struct Play {
    const engine::Device& device;
    Case& test_case;
    const hair::RunSettings& run;
    const MeasureHooks& hooks;
    BusyPass* busy = nullptr;  // null: no pass is slowed down
};

// Plays the next frame. Throws Interrupted where the user asks to stop.
void playFrame(engine::FrameLoop& loop, const Play& play);

// What a round ends with.
struct RoundEnd {
    std::vector<std::uint8_t> picture;  // [row][column] RGBA, top row first
    std::string picture_hash;
    std::string state_hash;
};

// Plays rounds of a case in one mode: each begins with the first frame, warms up for /run/warmup
// frames and plays /run/frames that count. So all rounds of all modes play the same frames, and
// must end with the same picture and state.
class RoundPlayer {
public:
    RoundPlayer(const Play& play, engine::Timing timing);

    // The frames that count.
    std::vector<engine::FrameRecord> round();

    // CPU ms from the start of recording the very first frame until it was complete.
    double firstFrame() const { return first_frame_; }

    // Of the first round, and of the last one so far. Reading them back takes time, so it is done
    // between rounds and for these two only.
    const RoundEnd& firstEnd();
    RoundEnd lastEnd();

private:
    RoundEnd readEnd() const;

    Play play_;
    engine::FrameLoop loop_;
    std::size_t rounds_ = 0;
    double first_frame_ = 0.0;
    std::optional<RoundEnd> first_end_;
};

}  // namespace benchmarks
