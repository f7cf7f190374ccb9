#pragma once

#include <cstdint>
#include <vector>

#include "benchmarks/viewer/player.h"
#include "hair/settings.h"

// The timeline: a bar of the scene's frames with marks of events, and a scrubber.
namespace benchmarks::viewer {

// An event of a scene.
struct TimelineMark {
    enum class Kind { keyframe, pull };
    Kind kind = Kind::keyframe;
    float from = 0.0f;  // in frames: 0 is the end of frame 0; -1 is the start
    float to = 0.0f;  // end of a pull; equal to `from` for a keyframe
};

// Returns the keyframes of the head's motion and the pulls of hands, in their order; none if frames
// advance by no time.
std::vector<TimelineMark> timelineMarks(const hair::Settings& settings);

// Returns the last frame of the bar: it covers the shown frame, all frames shown before, all marks
// and at least two seconds.
std::uint32_t
timelineEnd(const hair::Settings& settings, std::uint32_t frame, std::uint32_t furthest);

// Shows the bar across the rest of the current window, or nothing if that is narrow. Dragging it
// pauses and sets PlayState::scrub.
void timeline(PlayState& state, const Shown& shown);

}  // namespace benchmarks::viewer
