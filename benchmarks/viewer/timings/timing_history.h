#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/frame_loop.h"

namespace benchmarks {

// What was measured of frames that were timed in one way, oldest first.
struct TimedFrames {
    std::vector<engine::FrameRecord> records;
    std::vector<std::uint32_t> numbers;  // of each frame in the simulation, from 0

    std::size_t size() const { return records.size(); }
};

// What was measured of the last frames that were drawn, by the way they were timed. Frames of
// different settings don't mix: who changes them clears it.
class TimingHistory {
public:
    static constexpr std::size_t kFrames = 300;  // of each way

    // `timing` is isolated or overlapped.
    void add(const engine::FrameRecord& frame, engine::Timing timing, std::uint32_t number);
    void clear();

    const TimedFrames& isolated() const { return isolated_; }
    const TimedFrames& overlapped() const { return overlapped_; }

    // Another one after each clear(): what was found out before it is of other settings.
    std::uint64_t revision() const { return revision_; }

private:
    TimedFrames isolated_;
    TimedFrames overlapped_;
    std::uint64_t revision_ = 0;
};

}  // namespace benchmarks
