#include "benchmarks/measure/check_timestamps.h"

#include <algorithm>
#include <iterator>

#include "benchmarks/trust.h"

namespace benchmarks {

namespace {

constexpr std::uint32_t kPairs = 2;  // between two looks
constexpr std::uint32_t kMostPairs = 16;

}  // namespace

std::vector<std::string> checkTimestamps(
    const engine::Device& device, const std::function<void(engine::FrameLoop&)>& play_frame) {
    engine::FrameLoop stamped(device, engine::Timing::isolated);
    engine::FrameLoop clocked(device, engine::Timing::wall_clock);
    std::vector<engine::FrameRecord> stamped_frames;
    std::vector<engine::FrameRecord> clocked_frames;
    std::vector<std::string> faults;
    do {
        for (std::uint32_t i = 0; i < kPairs; ++i) {
            play_frame(stamped);
            play_frame(clocked);
        }
        std::ranges::move(stamped.finish(), std::back_inserter(stamped_frames));
        std::ranges::move(clocked.finish(), std::back_inserter(clocked_frames));
        faults = timestampFaults(stamped_frames, clocked_frames);
    } while (!faults.empty() && stamped_frames.size() < kMostPairs);
    return faults;
}

}  // namespace benchmarks
