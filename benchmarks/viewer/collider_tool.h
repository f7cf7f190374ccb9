#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "benchmarks/viewer/edit.h"
#include "benchmarks/viewer/gizmo.h"
#include "benchmarks/viewer/picking.h"
#include "benchmarks/viewer/player.h"
#include "hair/settings.h"
#include "hair/simulation/head_motion.h"

// The tool that moves, stretches, adds and removes colliders in the picture.
namespace benchmarks::viewer {

// What a capsule is held by. A sphere has no ends: its `stretch` makes it a capsule.
enum class ColliderPart { middle, end_a, end_b, stretch, rim };

// Where the parts of a collider are in the world; `head` is where the head is.
struct ColliderHandle {
    ColliderPart part = ColliderPart::middle;
    glm::vec3 point{0.0f};
};
std::vector<ColliderHandle> colliderHandles(
    const hair::Collider& collider, const hair::simulation::RigidMotion& head,
    const PictureView& view);

// The ends of a capsule's axis in the world.
struct ColliderAxis {
    glm::vec3 a, b;
};
ColliderAxis axisOf(const hair::Collider& collider, const hair::simulation::RigidMotion& head);

// The collider after one of its parts was moved through the world by so much.
hair::Collider withMoved(
    const hair::Collider& collider, const hair::simulation::RigidMotion& head,
    const PictureView& view, ColliderPart part, const glm::vec3& by);

// A sphere in front of the face of a groom, as it is on a head that has not moved (+z is where
// faces look); it follows the head.
hair::Collider colliderInFront(const Sphere& groom);

// Moves the capsules of /simulation/colliders with the mouse.
class ColliderTool {
public:
    Edit
    update(const Pointer& pointer, Handles& handles, hair::Settings& settings, const Shown& played);
    bool drags() const { return drag_.has_value(); }

    // Buttons that add a collider and remove the selected one, in one line.
    Edit options(OptionsLine& line, hair::Settings& settings, const Shown& played);

private:
    struct Drag {
        const Shown* played;  // whose picture the mouse is in
        ColliderHandle held;
        hair::Collider start;
        glm::vec2 from;  // px
    };
    std::optional<ColliderHandle>
    handleUnder(const Pointer& pointer, const hair::Settings& settings, const Shown& played) const;
    void press(
        const Pointer& pointer, std::optional<ColliderHandle> hot, const hair::Settings& settings,
        const Shown& played);

    std::optional<std::size_t> selected_;
    std::optional<Drag> drag_;
};

}  // namespace benchmarks::viewer
