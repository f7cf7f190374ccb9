#pragma once

#include <optional>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "benchmarks/viewer/tools/picture_rect.h"
#include "hair/settings.h"

namespace benchmarks {

struct Ray {
    glm::dvec3 from;
    glm::dvec3 direction;  // unit length
};

// A picture that is shown somewhere in the window: what of the scene is where. Pixels are Dear
// ImGui's coordinates, y down.
class PictureView {
public:
    // `render` gives the picture's proportions; `rect` shows all of it.
    PictureView(
        const hair::CameraSettings& camera, const hair::RenderSettings& render,
        const PictureRect& rect);

    // Where a point is shown, even outside of the picture; none behind the near plane.
    std::optional<glm::vec2> pixel(const glm::vec3& point) const;
    // From the camera through a pixel.
    Ray ray(glm::vec2 pixel) const;
    // What a pixel shows of the plane that faces the camera and goes through a point.
    glm::vec3 onPlane(glm::vec2 pixel, const glm::vec3& through) const;
    // How far a point goes in that plane while the mouse goes from one pixel to another.
    glm::vec3 dragged(const glm::vec3& point, glm::vec2 from, glm::vec2 to) const;
    // Of a length across the view at a point; 0 behind the camera.
    float pixelsPerMetre(const glm::vec3& at) const;
    // m along the view; negative: behind the camera.
    float depth(const glm::vec3& point) const;

    const PictureRect& rect() const { return rect_; }
    const glm::vec3& right() const { return right_; }
    const glm::vec3& up() const { return up_; }
    const glm::vec3& back() const { return back_; }  // from what is seen to the camera
    const glm::vec3& eye() const { return eye_; }

private:
    PictureRect rect_;
    glm::dmat4 projection_;  // world -> clip
    glm::dmat4 inverse_;
    glm::vec3 eye_, right_, up_, back_;
    float pixels_at_one_;  // of 1 m at a depth of 1 m
};

}  // namespace benchmarks
