#include "benchmarks/viewer/tools/collider_handles.h"

#include <algorithm>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "benchmarks/viewer/tools/field_limits.h"

namespace benchmarks {

namespace {

glm::vec3
toWorld(const hair::Collider& collider, const hair::RigidMotion& head, const glm::vec3& point) {
    return collider.follows == hair::Follows::head ? glm::vec3(head(point)) : point;
}

// Across the capsule and the view, to where the rim's handle is.
glm::vec3 rimDirection(const ColliderAxis& axis, const PictureView& view) {
    const glm::vec3 side = glm::cross(axis.b - axis.a, view.back());
    const float length = glm::length(side);
    return length > 1e-6f ? side / length : view.right();
}

glm::vec3 allowedPoint(glm::vec3 point) { return allowed(&hair::Collider::a, point); }

}  // namespace

ColliderAxis axisOf(const hair::Collider& collider, const hair::RigidMotion& head) {
    return {toWorld(collider, head, collider.a), toWorld(collider, head, collider.b)};
}

std::vector<ColliderHandle> colliderHandles(
    const hair::Collider& collider, const hair::RigidMotion& head, const PictureView& view) {
    const ColliderAxis axis = axisOf(collider, head);
    const glm::vec3 middle = (axis.a + axis.b) / 2.0f;
    std::vector<ColliderHandle> handles{
        {ColliderPart::middle, middle},
        {ColliderPart::rim, middle + rimDirection(axis, view) * collider.radius}};
    if (collider.a == collider.b) {
        handles.push_back({ColliderPart::stretch, middle + view.up() * collider.radius});
    } else {
        handles.push_back({ColliderPart::end_a, axis.a});
        handles.push_back({ColliderPart::end_b, axis.b});
    }
    return handles;
}

hair::Collider withMoved(
    const hair::Collider& collider, const hair::RigidMotion& head, const PictureView& view,
    ColliderPart part, const glm::vec3& by) {
    hair::Collider after = collider;
    if (part == ColliderPart::rim) {
        const float wider = glm::dot(by, rimDirection(axisOf(collider, head), view));
        after.radius = allowed(&hair::Collider::radius, collider.radius + wider);
        return after;
    }
    const glm::vec3 local = collider.follows == hair::Follows::head
                                ? glm::vec3(glm::conjugate(head.rotation) * glm::dvec3(by))
                                : by;
    if (part == ColliderPart::middle || part == ColliderPart::end_a)
        after.a = allowedPoint(collider.a + local);
    if (part != ColliderPart::end_a) after.b = allowedPoint(collider.b + local);
    return after;
}

std::optional<std::size_t> pickCollider(
    const PictureView& view, std::span<const hair::Collider> colliders,
    const hair::RigidMotion& head, glm::vec2 pixel) {
    const Ray ray = view.ray(pixel);
    std::optional<std::size_t> best;
    double nearest = 0.0;
    for (std::size_t i = 0; i < colliders.size(); ++i) {
        const ColliderAxis axis = axisOf(colliders[i], head);
        const auto hit = pickCapsule(ray, axis.a, axis.b, colliders[i].radius);
        if (!hit || (best && *hit >= nearest)) continue;
        nearest = *hit;
        best = i;
    }
    return best;
}

hair::Collider colliderInFront(const Sphere& groom) {
    const float radius = allowed(&hair::Collider::radius, 0.2f * groom.radius);
    const glm::vec3 center =
        allowedPoint(groom.center + glm::vec3{0.0f, 0.0f, groom.radius + radius});
    return {.a = center, .b = center, .radius = radius, .follows = hair::Follows::head};
}

}  // namespace benchmarks
