#pragma once

#include <optional>
#include <span>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "benchmarks/viewer/edit.h"
#include "benchmarks/viewer/picking.h"
#include "benchmarks/viewer/player.h"
#include "hair/settings.h"

// Orbit, pan, zoom and flight of the camera, its presets, and the mouse and keys that move it.
namespace benchmarks::viewer {

struct CameraPreset {
    const char* name;
    glm::vec3 direction;  // from what is looked at to the camera
    // Height of the camera over the sphere that is looked at; 1: the sphere fills the picture.
    // Never inside the sphere, whatever the field of view.
    float height;
};
std::span<const CameraPreset> cameraPresets();

// The functions that move a camera keep /camera/up, and never look along it. A camera that is
// impossible, such as one that does, becomes possible. `pixels` are of a picture that is `height`
// px high, x to the right and y down.

// Turns the camera about the target: half a turn for as many pixels as the picture is high.
void orbit(hair::CameraSettings& camera, glm::vec2 pixels, float height);

// Moves the camera along the picture's plane, so that the target stays under the mouse.
void pan(hair::CameraSettings& camera, glm::vec2 pixels, float height);

// Moves the camera nearer to the target by `steps` of a tenth; negative: farther. Never nearer than
// the near plane.
void zoom(hair::CameraSettings& camera, float steps);

// Moves camera and target along right, up and forward, in distances to the target.
void fly(hair::CameraSettings& camera, glm::vec3 distances);

// Looks at a sphere from where the camera is, or from a preset's direction, so that it fills most
// of a picture that is `aspect` times as wide as high.
void frameSphere(hair::CameraSettings& camera, glm::vec3 center, float radius, float aspect = 1.0f);
void look(
    hair::CameraSettings& camera, const CameraPreset& preset, glm::vec3 center, float radius,
    float aspect = 1.0f);

// Looks at a point from where the camera is, unless that is along /camera/up or too near.
void focus(hair::CameraSettings& camera, glm::vec3 point);

// The point of the hair or the head that a pixel shows; none where it shows neither. Hair is its
// guides, at most `reach` px away. Reads the head's mesh from its file.
std::optional<glm::vec3>
pointUnder(const PictureView& view, glm::vec2 pixel, float reach, const Shown& played);

// Moves /camera with the mouse and keys.
class CameraTool {
public:
    // What the left button drags.
    enum class Left { camera, handle };

    // `held`: a button that went down on the picture is down.
    Edit update(
        const Pointer& pointer, Left left, bool held, hair::Settings& settings,
        const Shown& played);

    // Whether keys or the wheel move the camera, or did a moment ago: until then it is one edit.
    bool isMoving() const;

private:
    Edit mouse(const Pointer& pointer, Left left, hair::CameraSettings& camera) const;
    bool takesKeys(const Pointer& pointer);
    Edit keys(const Pointer& pointer, hair::CameraSettings& camera);

    int hovered_in_ = -2;  // last frame of the window in which the mouse was over a picture
    int keyed_in_ = -2;  // last frame in which a picture got the keys without the mouse over it
    double moving_until_ = 0.0;  // s of the window's clock
};

}  // namespace benchmarks::viewer
