#pragma once

#include <span>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "benchmarks/viewer/picking.h"
#include "benchmarks/viewer/player.h"
#include "hair/settings.h"

namespace benchmarks::viewer {

struct CameraPreset {
    const char* name;
    glm::vec3 direction;  // from what is looked at to the camera
    // Of the camera over the sphere that is looked at; 1: so high that it fills the picture. Never
    // inside it, whatever the field of view.
    float height;
};
std::span<const CameraPreset> cameraPresets();

// What the mouse and keys do to a camera. `pixels` are of a picture that is `height` px high, x to
// the right and y down. All keep /camera/up, and never look along it. A camera that can't be, such
// as one that does, becomes one that can.

// About the target: half a turn for as many pixels as the picture is high.
void orbit(hair::CameraSettings& camera, glm::vec2 pixels, float height);

// Along the picture's plane, so that the target stays under the mouse.
void pan(hair::CameraSettings& camera, glm::vec2 pixels, float height);

// Nearer to the target by `steps` of a tenth; negative: farther. Never nearer than the near plane.
void zoom(hair::CameraSettings& camera, float steps);

// Along right, up and forward, in distances to the target; the target goes along.
void fly(hair::CameraSettings& camera, glm::vec3 distances);

// Looks at a sphere from where the camera is, or from a preset's direction, so that it fills most
// of a picture that is `aspect` times as wide as high.
void frameSphere(hair::CameraSettings& camera, glm::vec3 center, float radius, float aspect = 1.0f);
void look(
    hair::CameraSettings& camera, const CameraPreset& preset, glm::vec3 center, float radius,
    float aspect = 1.0f);

// Looks at a point from where the camera is, unless that is along /camera/up or too near.
void focus(hair::CameraSettings& camera, glm::vec3 point);

// What the mouse and keys do to the camera.
class CameraTool {
public:
    // Who has the left button.
    enum class Left { camera, handle };

    // `held`: a button that went down on the picture is down.
    Edit update(
        const Pointer& pointer, Left left, bool held, hair::Settings& settings,
        const Player& player);

    // Whether keys or the wheel move the camera, or did a moment ago: all that is one edit.
    bool isMoving() const;

private:
    Edit mouse(const Pointer& pointer, Left left, hair::CameraSettings& camera) const;
    bool takesKeys(const Pointer& pointer);
    Edit keys(const Pointer& pointer, hair::CameraSettings& camera);

    // Frames of the window: in which the mouse was over a picture, and in which one had keys
    // without it.
    int hovered_in_ = -2;
    int keyed_in_ = -2;
    double moving_until_ = 0.0;  // s of the window's clock
};

// The point of the hair or the head that a pixel shows; none where it shows neither.
std::optional<glm::vec3>
pointUnder(const PictureView& view, glm::vec2 pixel, float reach, const Player& player);

}  // namespace benchmarks::viewer
