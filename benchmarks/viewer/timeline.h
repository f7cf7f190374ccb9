#pragma once

#include <cstdint>
#include <vector>

#include "benchmarks/viewer/player.h"
#include "hair/settings.h"

// The bar of a scene's frames: what happens when, and a scrubber.
namespace benchmarks::viewer {

// What a scene does at a time.
struct TimelineMark {
    enum class Kind { keyframe, pull };
    Kind kind = Kind::keyframe;
    float from = 0.0f;  // frames: 0 is the end of frame 0; -1 is the start
    float to = 0.0f;  // where a pull ends; as `from` for a keyframe
};

// The keyframes of the head's motion and the pulls of hands, in their order. None where frames
// advance by no time.
std::vector<TimelineMark> timelineMarks(const hair::Settings& settings);

// The last frame of the bar: at least the one that is shown, those that were, all marks, and two
// seconds' worth.
std::uint32_t
timelineEnd(const hair::Settings& settings, std::uint32_t frame, std::uint32_t furthest);

// The bar, as wide as the current window has room; nothing where that is little. Dragging it pauses
// and sets PlayState::scrub.
void timeline(PlayState& state, const Shown& shown);

}  // namespace benchmarks::viewer
