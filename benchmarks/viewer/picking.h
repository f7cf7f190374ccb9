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

// Which point of the scene a pixel of a shown picture stands for: views, rays and what they hit.
namespace benchmarks::viewer {

// Where a picture is in the window, in Dear ImGui's coordinates.
struct PictureRect {
    glm::vec2 corner{0.0f};  // top left
    glm::vec2 size{1.0f};

    // Where a point of the window is in the picture: (0, 0) top left to (1, 1) bottom right.
    glm::vec2 share(glm::vec2 point) const { return (point - corner) / size; }
};

struct Ray {
    glm::dvec3 from;
    glm::dvec3 direction;  // unit length
};

// Where what of the scene is in a picture that is shown in the window. Pixels are Dear ImGui's
// coordinates, y down.
class PictureView {
public:
    // `render` gives the picture's proportions; `rect` shows all of it.
    PictureView(
        const hair::CameraSettings& camera, const hair::RenderSettings& render,
        const PictureRect& rect);

    // Where a point is shown, even outside of the picture; none behind the near plane.
    std::optional<glm::vec2> pixel(const glm::vec3& point) const;
    // The ray from the camera through a pixel.
    Ray ray(glm::vec2 pixel) const;
    // How far a point goes, in the plane through it that faces the camera, while the mouse goes
    // from one pixel to another.
    glm::vec3 dragged(const glm::vec3& point, glm::vec2 from, glm::vec2 to) const;
    // px that 1 m across the view has at a point; 0 behind the camera.
    float pixelsPerMetre(const glm::vec3& at) const;
    // m along the view to a point; negative: behind the camera.
    float depth(const glm::vec3& point) const;

    const PictureRect& rect() const { return rect_; }
    const glm::vec3& right() const { return right_; }
    const glm::vec3& up() const { return up_; }
    const glm::vec3& back() const { return back_; }  // from what is seen to the camera
    const glm::vec3& eye() const { return eye_; }

private:
    // What a pixel shows of the plane that faces the camera and goes through a point.
    glm::vec3 onPlane(glm::vec2 pixel, const glm::vec3& through) const;

    PictureRect rect_;
    glm::dmat4 projection_;  // world -> clip
    glm::dmat4 inverse_;
    glm::vec3 eye_, right_, up_, back_;
    float pixels_at_one_;  // px of 1 m at a depth of 1 m
};

struct Sphere {
    glm::vec3 center{0.0f};
    float radius = 0.0f;
};

// A sphere round points, about the middle of their bounding box. There is at least one point.
Sphere sphereRound(std::span<const glm::vec3> points);

// A vertex that is no root, of guides [guide][vertex].
struct GuideVertex {
    std::uint32_t guide = 0;
    std::uint32_t vertex = 1;
};

// The vertex nearest to a pixel, at most `reach` px from it: a vertex that is nearer to the camera
// by `depth_scale` (m) counts as if it were nearer to the pixel by `reach`.
std::optional<GuideVertex> pickVertex(
    const PictureView& view, std::span<const glm::vec3> guides, std::uint32_t vertices_per_guide,
    glm::vec2 pixel, float reach, float depth_scale);

// The point on a guide that is nearest to the camera among those at most `reach` px from a pixel.
std::optional<glm::vec3> pickHair(
    const PictureView& view, std::span<const glm::vec3> guides, std::uint32_t vertices_per_guide,
    glm::vec2 pixel, float reach);

// m along the ray to where it first meets a mesh that was moved.
std::optional<double>
pickMesh(const Ray& ray, const hair::groom::Mesh& mesh, const hair::simulation::RigidMotion& moved);

// m along the ray to where it enters a capsule; none where it misses it or begins inside.
std::optional<double>
pickCapsule(const Ray& ray, const glm::vec3& a, const glm::vec3& b, float radius);

// The mouse over a picture, in one frame of the window.
struct Pointer {
    PictureView view;
    glm::vec2 at{0.0f};  // px in the window
    glm::vec2 moved{0.0f};  // px since the last frame of the window
    bool hovers = false;  // over the picture
    bool pressed = false;  // the left button has just gone down on it
    bool holds = false;  // the left button went down on it and is down
};

}  // namespace benchmarks::viewer
