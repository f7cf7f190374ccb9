#include "benchmarks/viewer/collider_tool.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <imgui.h>

#include "benchmarks/viewer/edit.h"

namespace benchmarks::viewer {
namespace {

// ---- Handles of a collider ----------------------------------------------------------------------

glm::vec3 toWorld(
    const hair::Collider& collider, const hair::simulation::RigidMotion& head,
    const glm::vec3& point) {
    return collider.follows == hair::Follows::head ? glm::vec3(head(point)) : point;
}

// Returns the unit vector perpendicular to the capsule and the view, from its axis to the rim's
// handle.
glm::vec3 rimDirection(const ColliderAxis& axis, const PictureView& view) {
    const glm::vec3 side = glm::cross(axis.b - axis.a, view.back());
    const float length = glm::length(side);
    return length > 1e-6f ? side / length : view.right();
}

glm::vec3 allowedPoint(glm::vec3 point) { return allowed(&hair::Collider::a, point); }

// ---- The tool -----------------------------------------------------------------------------------

// Maximum number of drawn outlines; more would hide the picture. All colliders can still be
// selected.
constexpr std::size_t kMostOutlines = 200;

const char* tooltipOf(ColliderPart part) {
    switch (part) {
    case ColliderPart::middle:
        return "Drag: moves the collider.";
    case ColliderPart::end_a:
    case ColliderPart::end_b:
        return "Drag: moves this end.";
    case ColliderPart::stretch:
        return "Drag: stretches the sphere to a capsule.";
    case ColliderPart::rim:
        return "Drag: changes the radius.";
    }
    return "";
}

// Returns the radius of a sphere's outline in px. The camera's rays touch the sphere there, so it
// is wider than the sphere's cross-section through its centre. 0 if the camera is inside.
float outlineRadius(const PictureView& view, const glm::vec3& center, float radius) {
    const float distance = glm::length(view.eye() - center);
    if (distance <= radius) return 0.0f;
    const float touching = std::sqrt(distance * distance - radius * radius) / distance;
    return radius / touching * view.pixelsPerMetre(center);
}

// Draws a capsule's outline: two circles and the lines that touch both.
void outline(
    const PictureView& view, Handles& handles, const ColliderAxis& axis, float radius,
    Handles::Color color) {
    const auto a = view.pixel(axis.a), b = view.pixel(axis.b);
    if (!a || !b) return;
    const float at_a = outlineRadius(view, axis.a, radius);
    const float at_b = outlineRadius(view, axis.b, radius);
    if (at_a <= 0.0f || at_b <= 0.0f) return;
    handles.circle(*a, at_a, color);
    const float length = glm::length(*b - *a);
    if (length < 1.0f) return;
    handles.circle(*b, at_b, color);
    const glm::vec2 along = (*b - *a) / length;
    const glm::vec2 across{-along.y, along.x};
    for (const float side : {-1.0f, 1.0f})
        handles.line(*a + across * (side * at_a), *b + across * (side * at_b), color);
}

std::string textOf(const hair::Collider& collider, std::size_t index) {
    std::array<char, 80> text{};
    std::snprintf(
        text.data(), text.size(), "collider %zu, radius %.1f cm", index,
        static_cast<double>(collider.radius) * 100.0);
    return text.data();
}

glm::vec3 toHead(const glm::vec3& point, const hair::simulation::RigidMotion& head) {
    return glm::conjugate(head.rotation) * (glm::dvec3(point) - head.translation);
}

bool same(const hair::Collider& a, const hair::Collider& b) {
    return a.a == b.a && a.b == b.b && a.radius == b.radius;
}

// Returns the frontmost collider under a pixel.
std::optional<std::size_t> pickCollider(
    const PictureView& view, std::span<const hair::Collider> colliders,
    const hair::simulation::RigidMotion& head, glm::vec2 pixel) {
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

}  // namespace

// ---- Handles of a collider ----------------------------------------------------------------------

ColliderAxis axisOf(const hair::Collider& collider, const hair::simulation::RigidMotion& head) {
    return {toWorld(collider, head, collider.a), toWorld(collider, head, collider.b)};
}

std::vector<ColliderHandle> colliderHandles(
    const hair::Collider& collider, const hair::simulation::RigidMotion& head,
    const PictureView& view) {
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
    const hair::Collider& collider, const hair::simulation::RigidMotion& head,
    const PictureView& view, ColliderPart part, const glm::vec3& by) {
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

hair::Collider colliderInFront(const Sphere& groom) {
    const float radius = allowed(&hair::Collider::radius, 0.2f * groom.radius);
    const glm::vec3 center =
        allowedPoint(groom.center + glm::vec3{0.0f, 0.0f, groom.radius + radius});
    return {.a = center, .b = center, .radius = radius, .follows = hair::Follows::head};
}

// ---- The tool -----------------------------------------------------------------------------------

std::optional<ColliderHandle> ColliderTool::handleUnder(
    const Pointer& pointer, const hair::Settings& settings, const Shown& played) const {
    if (!selected_ || !pointer.hovers) return {};
    std::optional<ColliderHandle> best;
    float nearest = Handles::reach();
    for (const ColliderHandle& handle :
         colliderHandles(settings.simulation.colliders[*selected_], played.head, pointer.view)) {
        const auto shown = pointer.view.pixel(handle.point);
        if (!shown || glm::length(*shown - pointer.at) >= nearest) continue;
        nearest = glm::length(*shown - pointer.at);
        best = handle;
    }
    return best;
}

void ColliderTool::press(
    const Pointer& pointer, std::optional<ColliderHandle> hot, const hair::Settings& settings,
    const Shown& played) {
    const auto& colliders = settings.simulation.colliders;
    drag_.reset();
    if (!hot) {
        selected_ = pickCollider(pointer.view, colliders, played.head, pointer.at);
        if (!selected_) return;
        hot = colliderHandles(colliders[*selected_], played.head, pointer.view).front();
    }
    drag_ = {&played, *hot, colliders[*selected_], pointer.at};
}

Edit ColliderTool::update(
    const Pointer& pointer, Handles& handles, hair::Settings& settings, const Shown& played) {
    const PictureView& view = pointer.view;
    const hair::simulation::RigidMotion head = played.head;
    std::vector<hair::Collider>& colliders = settings.simulation.colliders;
    if (selected_ && *selected_ >= colliders.size()) {
        selected_.reset();
        drag_.reset();
    }
    std::optional<ColliderHandle> hot = handleUnder(pointer, settings, played);
    if (pointer.pressed) press(pointer, hot, settings, played);
    const bool drags = drag_ && drag_->played == &played;
    Edit edit;
    if (drags) {
        hair::Collider& collider = colliders[*selected_];
        const hair::Collider before = collider;
        if (pointer.at != drag_->from)
            collider = withMoved(
                drag_->start, head, view, drag_->held.part,
                view.dragged(drag_->held.point, drag_->from, pointer.at));
        edit = {.changed = !same(before, collider), .continues = true};
        hot = drag_->held;
        if (!pointer.holds) drag_.reset();
    }
    for (std::size_t i = 0; i < std::min(colliders.size(), kMostOutlines); ++i)
        if (i != selected_)
            outline(
                view, handles, axisOf(colliders[i], head), colliders[i].radius, Handles::kFaint);
    if (!selected_) {
        handles.hint(
            colliders.empty() ? "There is no collider." : "Click on a collider to select it.");
        return edit;
    }
    const hair::Collider& chosen = colliders[*selected_];
    outline(view, handles, axisOf(chosen, head), chosen.radius, Handles::kHot);
    for (const ColliderHandle& handle : colliderHandles(chosen, head, view)) {
        const auto shown = view.pixel(handle.point);
        if (!shown) continue;
        const bool is_hot = hot && hot->part == handle.part;
        handles.dot(*shown, is_hot ? Handles::kHot : Handles::kPlain);
        if (handle.part == ColliderPart::rim) handles.label(*shown, textOf(chosen, *selected_));
    }
    if (hot && !drags) ImGui::SetTooltip("%s", tooltipOf(hot->part));
    return edit;
}

Edit ColliderTool::options(OptionsLine& line, hair::Settings& settings, const Shown& played) {
    std::vector<hair::Collider>& colliders = settings.simulation.colliders;
    const bool has_room = colliders.size() < mostOf(&hair::SimulationSettings::colliders);
    if (line.button(
            "Add collider", has_room,
            "Adds a sphere in front of the face, which moves with the head")) {
        Sphere groom = groomNow(played);
        groom.center = toHead(groom.center, played.head);
        colliders.push_back(colliderInFront(groom));
        selected_ = colliders.size() - 1;
        return {.changed = true};
    }
    const bool is_selected = selected_ && *selected_ < colliders.size();
    if (!line.button("Remove collider", is_selected, "Removes the selected collider")) return {};
    colliders.erase(colliders.begin() + static_cast<std::ptrdiff_t>(*selected_));
    selected_.reset();
    drag_.reset();
    return {.changed = true};
}

}  // namespace benchmarks::viewer
