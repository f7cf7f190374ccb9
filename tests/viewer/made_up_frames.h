#pragma once

#include <vector>

#include "benchmarks/viewer/timings.h"

namespace benchmarks::viewer {

// An isolated frame with two passes that took `rest` ms more than both.
inline engine::FrameRecord isolatedFrame(double wind, double strands, double rest = 0.0) {
    engine::FrameRecord frame;
    frame.passes = {{"wind", wind, {}}, {"strands", strands, {}}};
    frame.device = wind + strands;
    frame.wall = wind + strands + rest;
    frame.record = 2.0;
    frame.submit = 1.0;
    frame.wait = frame.wall - frame.submit;
    frame.use = {2.0 * frame.wall, std::nullopt};
    return frame;
}

inline engine::FrameRecord overlappedFrame(double device) {
    engine::FrameRecord frame;
    frame.interval = 1000.0;  // includes a wait for the device, unlike the runner's frames
    frame.device = device;
    frame.record = 3.0;
    frame.submit = 0.5;
    return frame;
}

// Medians in ms: wind 2, strands 20, both together 23 (of 11, 23, 62), the frame 25 (of 12, 25,
// 63), overlapped on the device 18 (of 17, 18, 22). Frames 4 ... 9.
inline TimingHistory madeUpHistory() {
    TimingHistory history;
    history.add(isolatedFrame(1.0, 10.0, 1.0), engine::Timing::isolated, 4);
    history.add(overlappedFrame(22.0), engine::Timing::overlapped, 5);
    history.add(isolatedFrame(3.0, 20.0, 2.0), engine::Timing::isolated, 6);
    history.add(overlappedFrame(17.0), engine::Timing::overlapped, 7);
    history.add(isolatedFrame(2.0, 60.0, 1.0), engine::Timing::isolated, 8);
    history.add(overlappedFrame(18.0), engine::Timing::overlapped, 9);
    return history;
}

}  // namespace benchmarks::viewer
