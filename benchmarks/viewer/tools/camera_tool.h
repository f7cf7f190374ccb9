#pragma once

#include "benchmarks/viewer/edit.h"
#include "benchmarks/viewer/play/player.h"
#include "benchmarks/viewer/tools/orbit_camera.h"
#include "benchmarks/viewer/tools/pointer.h"
#include "hair/settings.h"

namespace benchmarks {

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

}  // namespace benchmarks
