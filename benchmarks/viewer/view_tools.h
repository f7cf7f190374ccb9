#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "benchmarks/viewer/edit.h"
#include "benchmarks/viewer/gizmo.h"
#include "benchmarks/viewer/player.h"
#include "hair/settings.h"

// Orbits, pans, zooms and flies the camera by mouse and keys, and has its presets.

namespace benchmarks::viewer {

struct CameraPreset {
    const char* name;
    glm::vec3 direction;  // from the target to the camera
    // Height of the camera over the target sphere; at 1, the sphere fills the picture. The camera
    // is never inside the sphere, whatever the field of view.
    float height;
};
std::span<const CameraPreset> cameraPresets();

// These functions keep /camera/up and never look along it. They turn an impossible camera, such as
// one that looks along it, into a possible one. `pixels` are px in a picture of `height` px, x to
// the right and y down.

// Turns the camera about the target: half a turn for a drag over the picture's height.
void orbit(hair::CameraSettings& camera, glm::vec2 pixels, float height);

// Moves the camera parallel to the picture's plane, so that the target stays under the mouse.
void pan(hair::CameraSettings& camera, glm::vec2 pixels, float height);

// Moves the camera towards the target by `steps` of a tenth of the distance, or away if negative.
// Keeps it beyond the near plane.
void zoom(hair::CameraSettings& camera, float steps);

// Moves camera and target right, up and forward, in multiples of the distance to the target.
void fly(hair::CameraSettings& camera, glm::vec3 distances);

// Looks at a sphere from the current direction or from a preset's, so that it fills most of a
// picture with the aspect ratio `aspect`, width over height.
void frameSphere(hair::CameraSettings& camera, glm::vec3 center, float radius, float aspect = 1.0f);
void look(
    hair::CameraSettings& camera, const CameraPreset& preset, glm::vec3 center, float radius,
    float aspect = 1.0f);

// Looks at a point from the current position, unless it is too near or along /camera/up.
void focus(hair::CameraSettings& camera, glm::vec3 point);

// Returns the point of the hair or the head at a pixel, if any. Hair means guides at most `reach`
// px away. Reads the head's mesh from its file.
std::optional<glm::vec3>
pointUnder(const PictureView& view, glm::vec2 pixel, float reach, const Shown& played);

// Moves /camera with the mouse and keys.
class CameraTool {
public:
    // The target of drags with the left button.
    enum class Left { camera, handle };

    // `held`: a button is down that was pressed on the picture.
    Edit update(
        const Pointer& pointer, Left left, bool held, hair::Settings& settings,
        const Shown& played);

    // Whether keys or the wheel move the camera, or moved it a moment ago. All these moves are one
    // edit.
    bool isMoving() const;

private:
    Edit mouse(const Pointer& pointer, Left left, hair::CameraSettings& camera) const;
    bool takesKeys(const Pointer& pointer);
    Edit keys(const Pointer& pointer, hair::CameraSettings& camera);

    int hovered_in_ = -2;  // last frame of the window in which the mouse was over a picture
    int keyed_in_ = -2;  // last frame in which a picture got keys without the mouse over it
    double moving_until_ = 0.0;  // s of the window's clock
};

// The tool for the lights of /shading/lights and the environment.

// ---- Where light comes from ---------------------------------------------------------------------

// Returns the unit vector from the groom's middle to a light; for a directional light, against its
// direction.
glm::vec3 lightDirection(const hair::LightSettings& light, const Sphere& groom);

// Moves a light around the groom's middle at its distance. A directional light then shines from
// there through the middle, and a rectangle still faces it.
void setLightDirection(hair::LightSettings& light, const Sphere& groom, const glm::vec3& direction);

// Returns the distance from the groom's middle, m; nothing for a directional light.
std::optional<float> lightDistance(const hair::LightSettings& light, const Sphere& groom);
void setLightDistance(hair::LightSettings& light, const Sphere& groom, float distance);

// Turns the environment by `degrees`, and keeps its angle within -180 to 180.
void turnEnvironment(hair::RenderSettings& render, float degrees);

// ---- The tool -----------------------------------------------------------------------------------

// A handle for each light, on a sphere around the groom in the direction of the light, which may
// itself be far outside the picture. A ring turns the environment.
class LightTool {
public:
    Edit
    update(const Pointer& pointer, Handles& handles, hair::Settings& settings, const Shown& played);
    bool drags() const { return drag_.has_value() || turn_.has_value(); }

    // Options in one line: the chosen light's strength and distance, and the environment's turn.
    Edit options(OptionsLine& line, hair::Settings& settings, const Shown& played);

private:
    struct Drag {
        const Shown* played;  // side of the picture under the mouse
        glm::vec3 handle;  // where it was grabbed
        glm::vec2 from;  // px
    };
    struct Turn {
        const Shown* played;
        glm::vec2 from;  // px
        float start;  // deg
    };
    Edit dragLight(const Pointer& pointer, hair::Settings& settings, const Sphere& groom);
    Edit dragEnvironment(const Pointer& pointer, hair::Settings& settings, const Gizmo& ring);

    std::size_t selected_ = 0;
    std::optional<Drag> drag_;
    std::optional<Turn> turn_;
};

}  // namespace benchmarks::viewer
