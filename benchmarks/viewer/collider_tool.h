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

// The handles of a capsule. A sphere has no ends; `stretch` turns it into a capsule.
enum class ColliderPart { middle, end_a, end_b, stretch, rim };

// World positions of a collider's handles. `head` is the head's motion.
struct ColliderHandle {
    ColliderPart part = ColliderPart::middle;
    glm::vec3 point{0.0f};
};
std::vector<ColliderHandle> colliderHandles(
    const hair::Collider& collider, const hair::simulation::RigidMotion& head,
    const PictureView& view);

// The ends of a capsule's axis in world space.
struct ColliderAxis {
    glm::vec3 a, b;
};
ColliderAxis axisOf(const hair::Collider& collider, const hair::simulation::RigidMotion& head);

// Returns the collider after one of its handles has moved by `by` in world space.
hair::Collider withMoved(
    const hair::Collider& collider, const hair::simulation::RigidMotion& head,
    const PictureView& view, ColliderPart part, const glm::vec3& by);

// Returns a sphere in front of the face of a groom (+z) on a head that has not moved. It follows
// the head.
hair::Collider colliderInFront(const Sphere& groom);

// Edits the capsules of /simulation/colliders with the mouse.
class ColliderTool {
public:
    Edit
    update(const Pointer& pointer, Handles& handles, hair::Settings& settings, const Shown& played);
    bool drags() const { return drag_.has_value(); }

    // Buttons in one line: add a collider, remove the selected one.
    Edit options(OptionsLine& line, hair::Settings& settings, const Shown& played);

private:
    struct Drag {
        const Shown* played;  // side of the picture under the mouse
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
