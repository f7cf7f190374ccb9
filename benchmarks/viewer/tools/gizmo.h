#pragma once

#include <array>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "benchmarks/viewer/tools/picture_view.h"

namespace benchmarks {

// Three arrows that move something along the axes of the world, and three rings that turn it. Where
// it is in a picture, and what dragging a part of it means; drawing is elsewhere.
struct Gizmo {
    glm::vec3 origin{0.0f};
    std::array<glm::vec3, 3> turn_axes{};  // of the rings, unit length; right-handed turns
    float size = 1.0f;  // radius of the rings, m; arrows are shorter
};

struct GizmoPart {
    enum class Kind { arrow, ring };
    Kind kind = Kind::arrow;
    int axis = 0;  // 0 .. 2

    bool operator==(const GizmoPart&) const = default;
};

// x, y or z of the world.
glm::vec3 moveAxis(int axis);

// Where an arrow ends.
glm::vec3 arrowTip(const Gizmo& gizmo, int axis);
// Whether it is long enough in the picture to be dragged: one that points at the camera is not.
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

// px from a point to a line between two others.
float pixelsToSegment(glm::vec2 point, glm::vec2 a, glm::vec2 b);

}  // namespace benchmarks
