#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "hair/groom/mesh/mesh.h"
#include "hair/settings.h"
#include "hair/simulation/head_motion.h"

// Finds the scene's point at a pixel of a shown picture: views, rays and intersections.

struct ImDrawList;

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
    glm::vec2 at{0.0f};  // px in the window; dragPoint() while a button is down
    glm::vec2 moved{0.0f};  // dragged()
    bool hovers = false;  // over the picture
    bool pressed = false;  // the left button was just pressed on it
    bool holds = false;  // the left button was pressed on it and is still down
};

// Elements of tools: the gizmo that moves and turns, handles over the picture, a line of options.

// Three arrows that move an object along the world axes, and three rings that turn it. Computes
// their place in a picture and the effect of a drag. HeadTool draws it.
struct Gizmo {
    glm::vec3 origin{0.0f};
    std::array<glm::vec3, 3> turn_axes{};  // axes of the rings, unit length; right-handed
    float size = 1.0f;  // radius of the rings, m; arrows are shorter
};

struct GizmoPart {
    enum class Kind { arrow, ring };
    Kind kind = Kind::arrow;
    int axis = 0;  // 0 .. 2

    bool operator==(const GizmoPart&) const = default;
};

// Returns the axis of an arrow: x, y or z of the world.
glm::vec3 moveAxis(int axis);

// Returns the end of an arrow.
glm::vec3 arrowTip(const Gizmo& gizmo, int axis);
// Whether an arrow is long enough in the picture to be dragged. An arrow that points at the camera
// is not.
bool canBeDragged(const PictureView& view, const Gizmo& gizmo, int axis);

// Returns the nearer half of a ring, from end to end, or all of a ring that faces the camera.
std::vector<glm::vec3> ringArc(const PictureView& view, const Gizmo& gizmo, int axis);

// Returns the arrow nearest to a pixel, at most `reach` px away, or else the nearest such ring.
std::optional<GizmoPart>
pickGizmo(const PictureView& view, const Gizmo& gizmo, glm::vec2 pixel, float reach);

// Returns the movement, m, along an arrow's axis for a drag between two pixels.
float moved(const PictureView& view, const Gizmo& gizmo, int axis, glm::vec2 from, glm::vec2 to);

// Returns the turn, rad, about a ring's axis for a drag between two pixels; less than half a turn.
float turned(const PictureView& view, const Gizmo& gizmo, int axis, glm::vec2 from, glm::vec2 to);

// Lines and dots over a picture, outlined so that they stand out from bright and dark areas. Draws
// into the current Dear ImGui window, within the visible part of the picture. All sizes scale with
// the font.
class Handles {
public:
    explicit Handles(const PictureRect& seen);
    ~Handles();
    Handles(const Handles&) = delete;
    Handles& operator=(const Handles&) = delete;

    using Color = std::uint32_t;  // IM_COL32
    static constexpr Color kPlain = 0xffffffff;
    static constexpr Color kFaint = 0x60ffffff;
    static constexpr Color kHot = 0xff40d8ff;  // under the mouse or held: yellow
    static constexpr Color kAxes[] = {
        0xff6060ff, 0xff70e070, 0xffff9060};  // x red, y green, z blue

    // Maximum distance from the mouse to a handle, px.
    static float reach();

    void line(glm::vec2 a, glm::vec2 b, Color color);
    void path(std::span<const glm::vec2> points, Color color);
    // A path without an outline, for use when there are many paths.
    void thinPath(std::span<const glm::vec2> points, Color color);
    void circle(glm::vec2 center, float radius, Color color);
    void dot(glm::vec2 center, Color color);
    void arrow(glm::vec2 from, glm::vec2 tip, Color color);
    // Text beside a point, moved to a place with enough room in the picture.
    void label(glm::vec2 beside, const std::string& text);
    // A message at the top of the picture.
    void hint(const std::string& text);

private:
    void box(glm::vec2 corner, const std::string& text);

    PictureRect seen_;
    ImDrawList* list_;
};

// A tool's options: widgets in one line, which wraps if the window is too narrow.
class OptionsLine {
public:
    // Returns whether it was pressed.
    bool button(const char* name, bool enabled, const char* tooltip);

    // One button of a group; the chosen one looks pressed.
    enum class Choice { open, chosen };
    bool choice(const char* name, Choice choice, const char* tooltip);

    // Returns whether the value changed. Ctrl+click accepts numbers beyond the slider's ends.
    bool slider(const char* name, float& value, float minimum, float maximum, const char* format);

    // Separates groups of widgets on one line.
    void separator();

private:
    // Moves to the place of the next widget, of `width` px.
    void place(float width);

    bool is_empty_ = true;
    bool separates_ = false;  // a separator goes before the next widget
};

}  // namespace benchmarks::viewer
