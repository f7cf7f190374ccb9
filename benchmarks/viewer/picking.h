#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "hair/groom/mesh/mesh.h"
#include "hair/settings.h"
#include "hair/simulation/head_motion.h"

// Finds the scene's point at a pixel of a shown picture: views, rays and intersections.
namespace benchmarks::viewer {

// Rectangle of a picture in the window, in Dear ImGui coordinates.
struct PictureRect {
    glm::vec2 corner{0.0f};  // top left
    glm::vec2 size{1.0f};

    // Returns a window point's position in the picture, from (0, 0) top left to (1, 1) bottom
    // right.
    glm::vec2 share(glm::vec2 point) const { return (point - corner) / size; }
};

struct Ray {
    glm::dvec3 from;
    glm::dvec3 direction;  // unit length
};

// Projection between the scene and a picture in the window. Pixels are Dear ImGui coordinates, y
// down.
class PictureView {
public:
    // `render` gives the picture's aspect ratio; `rect` contains the whole picture.
    PictureView(
        const hair::CameraSettings& camera, const hair::RenderSettings& render,
        const PictureRect& rect);

    // Returns the pixel of a point, even outside the picture; nothing behind the near plane.
    std::optional<glm::vec2> pixel(const glm::vec3& point) const;
    // The ray from the camera through a pixel.
    Ray ray(glm::vec2 pixel) const;
    // Returns a point's movement in the plane through it that faces the camera, when the mouse
    // moves from one pixel to another.
    glm::vec3 dragged(const glm::vec3& point, glm::vec2 from, glm::vec2 to) const;
    // Returns the px per metre across the view at a point; 0 behind the camera.
    float pixelsPerMetre(const glm::vec3& at) const;
    // Returns the depth of a point along the view, m; negative behind the camera.
    float depth(const glm::vec3& point) const;

    const PictureRect& rect() const { return rect_; }
    const glm::vec3& right() const { return right_; }
    const glm::vec3& up() const { return up_; }
    const glm::vec3& back() const { return back_; }  // from the scene to the camera
    const glm::vec3& eye() const { return eye_; }

private:
    // Returns the point at a pixel in the plane that faces the camera and contains `through`.
    glm::vec3 onPlane(glm::vec2 pixel, const glm::vec3& through) const;

    PictureRect rect_;
    glm::dmat4 projection_;  // world -> clip
    glm::dmat4 inverse_;
    glm::vec3 eye_, right_, up_, back_;
    float pixels_at_one_;  // px per metre at a depth of 1 m
};

struct Sphere {
    glm::vec3 center{0.0f};
    float radius = 0.0f;
};

// Returns a sphere around points, centred in their bounding box. Needs at least one point.
Sphere sphereRound(std::span<const glm::vec3> points);

// A vertex of guides [guide][vertex] that is not a root.
struct GuideVertex {
    std::uint32_t guide = 0;
    std::uint32_t vertex = 1;
};

// Returns the vertex nearest to a pixel, at most `reach` px from it. Being `depth_scale` (m) nearer
// to the camera counts as much as being `reach` nearer to the pixel.
std::optional<GuideVertex> pickVertex(
    const PictureView& view, std::span<const glm::vec3> guides, std::uint32_t vertices_per_guide,
    glm::vec2 pixel, float reach, float depth_scale);

// Returns the point on a guide that is nearest to the camera among those at most `reach` px from a
// pixel.
std::optional<glm::vec3> pickHair(
    const PictureView& view, std::span<const glm::vec3> guides, std::uint32_t vertices_per_guide,
    glm::vec2 pixel, float reach);

// Returns the distance along the ray, m, to its first intersection with a moved mesh.
std::optional<double>
pickMesh(const Ray& ray, const hair::groom::Mesh& mesh, const hair::simulation::RigidMotion& moved);

// Returns the distance along the ray, m, to where it enters a capsule; nothing if it misses or
// starts inside.
std::optional<double>
pickCapsule(const Ray& ray, const glm::vec3& a, const glm::vec3& b, float radius);

// State of the mouse over a picture in one frame of the window.
struct Pointer {
    PictureView view;
    glm::vec2 at{0.0f};  // px in the window
    glm::vec2 moved{0.0f};  // px since the window's last frame
    bool hovers = false;  // over the picture
    bool pressed = false;  // the left button was just pressed on it
    bool holds = false;  // the left button was pressed on it and is still down
};

}  // namespace benchmarks::viewer
