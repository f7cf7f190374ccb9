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

// A pose of the head, as in keyframes.
struct HeadPose {
    glm::vec3 rotation{0.0f};  // pitch, yaw and roll, deg
    glm::vec3 translation{0.0f};  // m

    bool operator==(const HeadPose&) const = default;
};

HeadPose headAt(const hair::MotionSettings& motion, double time);

// Returns a motion that is equal up to now, rests from then on and does not repeat. It keeps the
// existing keyframes if they give the same motion without those after now. Otherwise it has one per
// past frame of `frame_time` s, if the settings allow that many.
hair::MotionSettings
motionUntil(const hair::MotionSettings& motion, const Moment& moment, double frame_time);

// Gives the head a pose from the next frame on, in a motion that rests from now on. Returns false
// and does nothing if the head already has the pose or there is no room for more keyframes.
bool moveHead(hair::MotionSettings& motion, const Moment& moment, const HeadPose& pose);

// Moves the head with a gizmo at its pivot, by keyframes of /simulation/motion from now on.
class HeadTool {
public:
    // `runs`: frames are being played.
    Edit update(
        const Pointer& pointer, Handles& handles, hair::Settings& settings, const Shown& played,
        bool runs);
    bool drags() const { return drag_.has_value(); }

    // Options in one line: a button that clears the motion.
    Edit options(OptionsLine& line, hair::Settings& settings);

private:
    struct Drag {
        const Shown* played;  // side of the picture under the mouse
        GizmoPart part;
        Gizmo gizmo;  // at the start of the drag
        HeadPose start;
        HeadPose pose;  // the wanted pose
        glm::vec2 from;  // px
        glm::vec2 last;  // px
        float angle = 0.0f;  // total rad, can exceed a turn
        bool has_moved = false;
    };
    Edit drag(const Pointer& pointer, hair::Settings& settings, const Shown& played);

    std::optional<Drag> drag_;
};

// Returns the gizmo of a head in a pose. Its rings turn about the axes of a keyframe's angles, so
// that each ring changes one angle. `size`, m.
Gizmo headGizmo(const glm::vec3& pivot, const HeadPose& pose, float size);

}  // namespace benchmarks::viewer
