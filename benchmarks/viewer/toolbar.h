#pragma once

#include "benchmarks/viewer/camera_tool.h"
#include "benchmarks/viewer/collider_tool.h"
#include "benchmarks/viewer/edit.h"
#include "benchmarks/viewer/grab_tool.h"
#include "benchmarks/viewer/head_tool.h"
#include "benchmarks/viewer/light_tool.h"
#include "benchmarks/viewer/picking.h"
#include "benchmarks/viewer/player.h"
#include "benchmarks/viewer/stroke_tool.h"
#include "hair/settings.h"

// The tools for the picture: which one the mouse has, and the line of buttons to choose it.
namespace benchmarks::viewer {

// What the mouse does in the picture; where it is on no handle, it moves the camera.
enum class Tool {
    camera,     // orbit, pan, zoom, focus
    wind,       // turns and stretches the wind's arrow
    grab,       // pulls at hair
    brush,      // grooms: strokes over the hair at rest
    head,       // moves the head: keyframes of its motion
    colliders,  // moves capsules
    lights,     // moves lights and turns the environment
};

// The mouse and keys over a picture, and what is drawn over it for them.
class PictureTools {
public:
    Tool tool = Tool::camera;

    // Buttons of the tools and what the chosen one has, such as the camera's presets, in a line (or
    // more where there is no room) within the current window.
    Edit toolbar(hair::Settings& settings, const Shown& played);

    // Takes the mouse and keys over the picture shown in `rect`, of which `clip` is seen, and draws
    // handles into the current window. `hovered`: the mouse is over the picture; `held`: a button
    // that was pressed on it is down. What is dragged changes settings.
    Edit update(
        const PictureRect& rect, const PictureRect& clip, bool hovered, bool held,
        hair::Settings& settings, const Shown& played);

    // Whether an edit goes on without a widget that is active: keys or the wheel move the camera.
    bool isBusy() const { return camera_.isMoving(); }

    // Looks at the whole groom from where the camera is.
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
