#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "benchmarks/viewer/edit.h"
#include "benchmarks/viewer/gizmo.h"
#include "benchmarks/viewer/player.h"
#include "benchmarks/viewer/view_tools.h"
#include "hair/settings.h"
#include "hair/simulation/head_motion.h"

// Tools for the picture: each of them, and the line of buttons to choose one.
namespace benchmarks::viewer {

// ---- Tools for hair -----------------------------------------------------------------------------

// Hands that pull hair, the wind, and brushes.

// Pulls hair with the mouse: writes the path of an entry of /simulation/pulls while frames are
// played.
class GrabTool {
public:
    // `runs`: frames are being played.
    Edit update(
        const Pointer& pointer, Handles& handles, hair::Settings& settings, const Shown& played,
        bool runs);
    bool drags() const { return drag_.has_value(); }

    // Options in one line: the amount of hair to hold, and a button that clears all pulls.
    Edit options(OptionsLine& line, hair::Settings& settings);

private:
    struct Drag {
        const Shown* played;  // side of the picture under the mouse
        GuideVertex held;
        glm::vec3 start;  // position of the vertex
        glm::vec2 from;  // px
        std::optional<std::size_t> pull;  // the entry being written; absent until the mouse moves
    };
    Edit drag(const Pointer& pointer, hair::Settings& settings, const Shown& played);
    void draw(
        const Pointer& pointer, Handles& handles, const hair::Settings& settings,
        const Shown& played) const;

    float radius_ = hair::PullSettings{}.radius;  // m, for the next pull
    std::optional<Drag> drag_;
};

// Turns and stretches the wind's arrow by its tip.
class WindTool {
public:
    Edit
    update(const Pointer& pointer, Handles& handles, hair::Settings& settings, const Shown& played);
    bool drags() const { return drag_.has_value(); }

    // Options in one line: a slider for the wind, and a button for still air.
    static Edit options(OptionsLine& line, hair::Settings& settings);

private:
    struct Drag {
        const Shown* played;  // side of the picture under the mouse
        glm::vec3 tip;  // where the arrow was grabbed
        glm::vec2 from;  // px
    };
    std::optional<Drag> drag_;
};

// ---- The path of a hand -------------------------------------------------------------------------

// The mouse writes a path key by key while frames are played. Keys of played frames never change,
// so replaying the path gives the same hair.

// Returns the hand's position: linear between keys, constant before the first and after the last.
// `path` has at least one key.
glm::vec3 handAt(std::span<const hair::PullKey> path, float time);

// Puts the hand at `position` from the next frame on, where it stays.
void moveHand(std::vector<hair::PullKey>& path, const Moment& moment, glm::vec3 position);

// Ends the pull now. A pull without a played frame still pulls for the next frame. Clears a path
// that would begin after now, because time was set back.
void release(std::vector<hair::PullKey>& path, const Moment& moment);

// Whether a path has room for the keys of moveHand().
bool hasRoom(std::span<const hair::PullKey> path);

// ---- The wind's arrow ---------------------------------------------------------------------------

// The arrow points from the middle of the groom in the wind's direction. Its length grows with the
// logarithm of the wind, so that a breeze and a storm both fit a picture. In still air it keeps
// some length, so that it can be grabbed.

// Returns the wind that the arrow's length shows: strength, m/s^2, or in drag mode the mean speed,
// m/s.
float windOf(const hair::WindSettings& wind);

// Returns the end of a groom's arrow.
glm::vec3 windTip(const hair::WindSettings& wind, const Sphere& groom);

// Sets the wind from the arrow's end. A tip at the middle of the groom keeps the direction.
void setWindTip(hair::WindSettings& wind, const Sphere& groom, const glm::vec3& tip);
void setWind(hair::WindSettings& wind, float value);

// The grooming tool: brushes that comb, cut, lengthen, push and clump hair.

// Maps points from hair in its current state to hair at rest, on which brushes act. A point `now`
// maps to `toRest(now)`: it is turned back with the head, and moved back by the movement of the
// guide vertex nearest to `hit`.
class RestPlace {
public:
    // Needs Shown::has_guides.
    RestPlace(const Shown& shown, const glm::vec3& hit);

    glm::vec3 toRest(const glm::vec3& now) const;

private:
    hair::simulation::RigidMotion head_;
    glm::vec3 moved_{0.0f};  // from rest, without the head's motion
};

// Writes strokes to /groom/edits, one per press of the button.
class StrokeTool {
public:
    Edit
    update(const Pointer& pointer, Handles& handles, hair::Settings& settings, const Shown& played);
    bool drags() const { return drag_.has_value(); }

    // Options in one line: brushes, radius and strength, and a button that removes all strokes.
    Edit options(OptionsLine& line, hair::Settings& settings);

private:
    struct Drag {
        const Shown* played;  // side of the picture under the mouse
        RestPlace rest;
        glm::vec3 place;  // of the brush, on the current hair
        glm::vec2 at;  // px, position of the mouse for that place
        std::size_t stroke;  // the entry being written
        // The guides at rest after the stroke, [guide][vertex]; empty: unknown.
        std::vector<glm::vec3> guides;
    };
    Edit press(const Pointer& pointer, hair::Settings& settings, const Shown& played);
    Edit drag(const Pointer& pointer, hair::Settings& settings, const Shown& played);
    void predict(const hair::Settings& settings, const Shown& played);
    void draw(const Pointer& pointer, Handles& handles, const Shown& played);
    void resize();

    hair::BrushTool brush_ = hair::BrushTool::comb;
    float radius_ = hair::StrokeSettings{}.radius;  // m
    float strength_ = hair::StrokeSettings{}.strength;
    std::optional<Drag> drag_;
    std::optional<glm::vec3> under_;  // last point of hair under the mouse
};

// ---- Tools for bodies ---------------------------------------------------------------------------

// Moving, stretching, adding and removing colliders, and moving the head.

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

// ---- The chosen tool ----------------------------------------------------------------------------

// Whether frames are being played, judged by their numbers: a device that is too slow counts as
// paused.
class RunningClock {
public:
    // `seconds` of the window's clock. The Shown of a side must keep its address.
    bool runs(const Shown& shown, double seconds);

private:
    struct Seen {
        std::uint32_t frame = 0;
        double since = -1e9;  // when the frame last changed
    };
    std::map<const Shown*, Seen> seen_;
};

// Action of the mouse in the picture. Away from handles, it moves the camera.
enum class Tool {
    camera,  // orbit, pan, zoom, focus
    wind,  // turns and stretches the wind's arrow
    grab,  // pulls at hair
    brush,  // grooms: strokes over the hair at rest
    head,  // moves the head: keyframes of its motion
    colliders,  // moves capsules
    lights,  // moves lights and turns the environment
};

// Mouse and keys over a picture, and the handles that are drawn over it.
class PictureTools {
public:
    Tool tool = Tool::camera;

    // Shows buttons for the tools, and options of the chosen one, such as the camera's presets, in
    // as many lines as needed within the current window.
    Edit toolbar(hair::Settings& settings, const Shown& played);

    // Handles mouse and keys over the picture in `rect`, with the visible part `clip`, and draws
    // handles into the current window. `hovered`: the mouse is over the picture; `held`: a button
    // that was pressed on it is down. Drags change settings.
    Edit update(
        const PictureRect& rect, const PictureRect& clip, bool hovered, bool held,
        hair::Settings& settings, const Shown& played);

    // Whether an edit continues without an active widget: keys or the wheel move the camera.
    bool isBusy() const { return camera_.isMoving(); }

    // Looks at the whole groom from the current direction.
    Edit frameGroom(hair::Settings& settings, const Shown& played) const;
    // Looks at the whole groom from a preset's direction.
    Edit look(hair::Settings& settings, const Shown& played, const CameraPreset& preset) const;

private:
    bool drags() const;
    Edit
    handle(const Pointer& pointer, Handles& handles, hair::Settings& settings, const Shown& played);

    CameraTool camera_;
    WindTool wind_;
    GrabTool grab_;
    StrokeTool brush_;
    HeadTool head_;
    ColliderTool colliders_;
    LightTool lights_;
    RunningClock clock_;
};

}  // namespace benchmarks::viewer
