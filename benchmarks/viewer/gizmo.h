#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "benchmarks/viewer/picking.h"

struct ImDrawList;

// Elements of tools: the gizmo that moves and turns, handles over the picture, a line of options.
namespace benchmarks::viewer {

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
