#pragma once

#include <cstdint>
#include <map>

#include "benchmarks/viewer/body_tools.h"
#include "benchmarks/viewer/edit.h"
#include "benchmarks/viewer/gizmo.h"
#include "benchmarks/viewer/hair_tools.h"
#include "benchmarks/viewer/player.h"
#include "benchmarks/viewer/view_tools.h"
#include "hair/settings.h"

// Tools for the picture: the selected one, and the line of buttons to choose it.
namespace benchmarks::viewer {

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
    camera,     // orbit, pan, zoom, focus
    wind,       // turns and stretches the wind's arrow
    grab,       // pulls at hair
    brush,      // grooms: strokes over the hair at rest
    head,       // moves the head: keyframes of its motion
    colliders,  // moves capsules
    lights,     // moves lights and turns the environment
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
