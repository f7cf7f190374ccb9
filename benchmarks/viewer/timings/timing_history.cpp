#include "benchmarks/viewer/timings/timing_history.h"

namespace benchmarks {

void TimingHistory::add(
    const engine::FrameRecord& frame, engine::Timing timing, std::uint32_t number) {
    TimedFrames& frames = timing == engine::Timing::overlapped ? overlapped_ : isolated_;
    if (frames.size() == kFrames) {
        frames.records.erase(frames.records.begin());
        frames.numbers.erase(frames.numbers.begin());
    }
    frames.records.push_back(frame);
    frames.numbers.push_back(number);
}

void TimingHistory::clear() {
    isolated_ = {};
    overlapped_ = {};
    ++revision_;
}

}  // namespace benchmarks
