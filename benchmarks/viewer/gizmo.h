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

// What tools show: the gizmo that moves and turns, handles over the picture, a line of options.
namespace benchmarks::viewer {

// Three arrows that move something along the axes of the world, and three rings that turn it:
// where it is in a picture, and what dragging a part of it means. HeadTool draws it.
struct Gizmo {
    glm::vec3 origin{0.0f};
    std::array<glm::vec3, 3> turn_axes{};  // axes of the rings, unit length; right-handed turns
    float size = 1.0f;  // radius of the rings, m; arrows are shorter
};

struct GizmoPart {
    enum class Kind { arrow, ring };
    Kind kind = Kind::arrow;
    int axis = 0;  // 0 .. 2

    bool operator==(const GizmoPart&) const = default;
};

// The axis of an arrow: x, y or z of the world.
glm::vec3 moveAxis(int axis);

// Where an arrow ends.
glm::vec3 arrowTip(const Gizmo& gizmo, int axis);
// Whether an arrow is long enough in the picture to be dragged: one that points at the camera is
// not.
bool canBeDragged(const PictureView& view, const Gizmo& gizmo, int axis);

// The ring's half that is nearer to the camera, from end to end; all of a ring that faces it.
std::vector<glm::vec3> ringArc(const PictureView& view, const Gizmo& gizmo, int axis);

// The arrow that is nearest to a pixel, at most `reach` px from it; where there is none, the ring.
std::optional<GizmoPart>
pickGizmo(const PictureView& view, const Gizmo& gizmo, glm::vec2 pixel, float reach);

// m along an arrow's axis that dragging it from one pixel to another moves.
float moved(const PictureView& view, const Gizmo& gizmo, int axis, glm::vec2 from, glm::vec2 to);

// rad about a ring's axis, less than half a turn, that dragging it from one pixel to another turns.
float turned(const PictureView& view, const Gizmo& gizmo, int axis, glm::vec2 from, glm::vec2 to);

// Lines and dots over a picture, each with an outline that makes it stand out from bright and dark.
// Draws into the current window of Dear ImGui, within what is seen of the picture; all sizes scale
// with its font.
class Handles {
public:
    explicit Handles(const PictureRect& seen);
    ~Handles();
    Handles(const Handles&) = delete;
    Handles& operator=(const Handles&) = delete;

    using Color = std::uint32_t;  // IM_COL32
    static constexpr Color kPlain = 0xffffffff;
    static constexpr Color kFaint = 0x60ffffff;
    static constexpr Color kHot = 0xff40d8ff;  // under the mouse, or held: yellow
    static constexpr Color kAxes[] = {
        0xff6060ff, 0xff70e070, 0xffff9060};  // x red, y green, z blue

    // How near the mouse must be to a handle, px.
    static float reach();

    void line(glm::vec2 a, glm::vec2 b, Color color);
    void path(std::span<const glm::vec2> points, Color color);
    // Of many, without outlines.
    void thinPath(std::span<const glm::vec2> points, Color color);
    void circle(glm::vec2 center, float radius, Color color);
    void dot(glm::vec2 center, Color color);
    void arrow(glm::vec2 from, glm::vec2 tip, Color color);
    // Text beside a point, moved to where the picture has room for it.
    void label(glm::vec2 beside, const std::string& text);
    // Text at the top of the picture: what the user should know.
    void hint(const std::string& text);

private:
    void box(glm::vec2 corner, const std::string& text);

    PictureRect seen_;
    ImDrawList* list_;
};

// A tool's options: widgets in a line that goes on in the next one where the window has no more
// room.
class OptionsLine {
public:
    // True when it was pressed.
    bool button(const char* name, bool enabled, const char* tooltip);

    // A button of several of which the chosen one looks pressed.
    enum class Choice { open, chosen };
    bool choice(const char* name, Choice choice, const char* tooltip);

    // True where the value was changed. Ctrl+click takes a number beyond the slider's ends.
    bool slider(const char* name, float& value, float minimum, float maximum, const char* format);

    // Between groups of widgets that are in one line.
    void separator();

private:
    // Moves to where the next widget goes, which is `width` px wide.
    void place(float width);

    bool is_empty_ = true;
    bool separates_ = false;  // a separator goes before the next widget
};

}  // namespace benchmarks::viewer
