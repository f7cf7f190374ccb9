#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "benchmarks/viewer/edit.h"
#include "benchmarks/viewer/gizmo.h"
#include "benchmarks/viewer/player.h"
#include "hair/settings.h"
#include "hair/simulation/head_motion.h"

// The tool that moves, stretches, adds and removes colliders in the picture.

namespace benchmarks::viewer {

// The handles of a capsule. A sphere has no ends; `stretch` turns it into a capsule.
enum class ColliderPart { middle, end_a, end_b, stretch, rim };

// World positions of a collider's handles. `head` is the head's motion.
struct ColliderHandle {
    ColliderPart part = ColliderPart::middle;
    glm::vec3 point{0.0f};
};
std::vector<ColliderHandle> colliderHandles(
    const hair::Collider& collider, const hair::simulation::RigidMotion& head,
    const PictureView& view);

// The ends of a capsule's axis in world space.
struct ColliderAxis {
    glm::vec3 a, b;
};
ColliderAxis axisOf(const hair::Collider& collider, const hair::simulation::RigidMotion& head);

// Returns the collider after one of its handles has moved by `by` in world space.
hair::Collider withMoved(
    const hair::Collider& collider, const hair::simulation::RigidMotion& head,
    const PictureView& view, ColliderPart part, const glm::vec3& by);

// Returns a sphere in front of the face of a groom (+z) on a head that has not moved. It follows
// the head.
hair::Collider colliderInFront(const Sphere& groom);

// Edits the capsules of /simulation/colliders with the mouse.
class ColliderTool {
public:
    Edit
    update(const Pointer& pointer, Handles& handles, hair::Settings& settings, const Shown& played);
    bool drags() const { return drag_.has_value(); }

    // Buttons in one line: add a collider, remove the selected one.
    Edit options(OptionsLine& line, hair::Settings& settings, const Shown& played);

private:
    struct Drag {
        const Shown* played;  // side of the picture under the mouse
        ColliderHandle held;
        hair::Collider start;
        glm::vec2 from;  // px
    };
    std::optional<ColliderHandle>
    handleUnder(const Pointer& pointer, const hair::Settings& settings, const Shown& played) const;
    void press(
        const Pointer& pointer, std::optional<ColliderHandle> hot, const hair::Settings& settings,
        const Shown& played);

    std::optional<std::size_t> selected_;
    std::optional<Drag> drag_;
};

// The tool that moves the head with a gizmo, by keyframes of its motion.

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
