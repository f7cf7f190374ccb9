#pragma once

#include <optional>

#include <glm/vec3.hpp>

#include "benchmarks/viewer/edit.h"
#include "benchmarks/viewer/gizmo.h"
#include "benchmarks/viewer/picking.h"
#include "benchmarks/viewer/player.h"
#include "hair/settings.h"

// The tool that moves the head with a gizmo, by keyframes of its motion.
namespace benchmarks::viewer {

// A pose of the head, as keyframes have it.
struct HeadPose {
    glm::vec3 rotation{0.0f};  // pitch, yaw and roll, deg
    glm::vec3 translation{0.0f};  // m

    bool operator==(const HeadPose&) const = default;
};

HeadPose headAt(const hair::MotionSettings& motion, double time);

// A motion that is the same up to now and rests from then on, and does not repeat. It has the
// keyframes so far where these give the same motion without those after now, else one for each of
// the frames so far, which were `frame_time` long, as far as the settings allow so many.
hair::MotionSettings
motionUntil(const hair::MotionSettings& motion, const Moment& moment, double frame_time);

// Gives the head a pose from the next frame on, in a motion that rests from now on. False, and
// nothing is done, where the head has the pose already or there is no room for more keyframes.
bool moveHead(hair::MotionSettings& motion, const Moment& moment, const HeadPose& pose);

// Moves the head with a gizmo at its pivot: keyframes of /simulation/motion from now on.
class HeadTool {
public:
    // `runs`: whether frames are being played.
    Edit update(
        const Pointer& pointer, Handles& handles, hair::Settings& settings, const Shown& played,
        bool runs);
    bool drags() const { return drag_.has_value(); }

    // A button that clears the motion, in one line.
    Edit options(OptionsLine& line, hair::Settings& settings);

private:
    struct Drag {
        const Shown* played;  // whose picture the mouse is in
        GizmoPart part;
        Gizmo gizmo;     // when the drag began
        HeadPose start;
        HeadPose pose;   // that is wanted
        glm::vec2 from;  // px
        glm::vec2 last;  // px
        float angle = 0.0f;  // rad so far; more than a turn is possible
        bool has_moved = false;
    };
    Edit drag(const Pointer& pointer, hair::Settings& settings, const Shown& played);

    std::optional<Drag> drag_;
};

// The gizmo of a head in a pose: its rings turn about the axes that the angles of a keyframe have,
// so that each changes one of them. `size`, m.
Gizmo headGizmo(const glm::vec3& pivot, const HeadPose& pose, float size);

}  // namespace benchmarks::viewer
