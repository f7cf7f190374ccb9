#pragma once

#include <span>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "hair/settings.h"

namespace benchmarks {

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

}  // namespace benchmarks
