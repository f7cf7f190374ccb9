#include "benchmarks/viewer/toolbar.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <imgui.h>

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

// ---- The head -----------------------------------------------------------------------------------

namespace {

// ---- Keyframes ----------------------------------------------------------------------------------

// Poses count as equal within these differences: some rounding steps of the keyframes' floats, far
// below visible changes.
constexpr float kDegrees = 1e-3f;
constexpr float kMetres = 1e-6f;

constexpr std::size_t kKeysOfAMove = 2;  // the present and the next frame

std::size_t mostKeys() { return mostOf(&hair::MotionSettings::keyframes); }

bool same(const hair::Keyframe& a, const hair::Keyframe& b) {
    for (int i = 0; i < 3; ++i) {
        // Angles that differ by whole turns are the same pose.
        if (std::abs(std::remainder(a.rotation[i] - b.rotation[i], 360.0f)) > kDegrees)
            return false;
        if (std::abs(a.translation[i] - b.translation[i]) > kMetres) return false;
    }
    return true;
}

hair::Keyframe keyOf(const HeadPose& pose, float time) {
    return {.time = time, .rotation = pose.rotation, .translation = pose.translation};
}

HeadPose poseOf(const hair::Keyframe& key) { return {key.rotation, key.translation}; }

// Returns the key with angles shifted by whole turns to lie nearest to those of the key before.
hair::Keyframe unwound(hair::Keyframe key, const hair::Keyframe& before) {
    for (int i = 0; i < 3; ++i)
        key.rotation[i] =
            before.rotation[i] + std::remainder(key.rotation[i] - before.rotation[i], 360.0f);
    return key;
}

// Cuts a motion after the present and adds a keyframe there.
void cut(hair::MotionSettings& motion, float now) {
    const hair::Keyframe present = keyOf(headAt(motion, double{now}), now);
    motion.repeat = false;
    std::erase_if(motion.keyframes, [&](const hair::Keyframe& key) { return key.time > now; });
    if (motion.keyframes.empty() || motion.keyframes.back().time < now)
        motion.keyframes.push_back(present);
}

// ---- The tool -----------------------------------------------------------------------------------

constexpr float kSize = 5.0f;  // radius of the gizmo, in font heights
// Maximum size of the gizmo as shares of the picture's height and of the distance to the camera.
// Otherwise it would fill small pictures and wide views.
constexpr float kMostShare = 0.3f;
constexpr float kMostDepth = 0.4f;
constexpr const char* kMoves[] = {"x", "y", "z"};
constexpr const char* kTurns[] = {"nod", "turn", "tilt"};

std::string textOf(GizmoPart part, const HeadPose& pose) {
    std::array<char, 64> text{};
    if (part.kind == GizmoPart::Kind::arrow)
        std::snprintf(
            text.data(), text.size(), "%s %+.1f cm", kMoves[part.axis],
            static_cast<double>(pose.translation[part.axis]) * 100.0);
    else
        std::snprintf(
            text.data(), text.size(), "%s %+.1f°", kTurns[part.axis],
            static_cast<double>(pose.rotation[part.axis]));
    return text.data();
}

std::string tooltipOf(GizmoPart part) {
    const std::string end = " by keyframes from now on.";
    if (part.kind == GizmoPart::Kind::arrow)
        return std::string("Drag: moves the head along ") + kMoves[part.axis] + end;
    return std::string("Drag round: the head's ") + kTurns[part.axis] + "," + end;
}

void draw(
    const PictureView& view, Handles& handles, const Gizmo& gizmo, std::optional<GizmoPart> hot) {
    const auto colorOf = [&](GizmoPart part) {
        return hot == part ? Handles::kHot : Handles::kAxes[part.axis];
    };
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<glm::vec2> arc;
        for (const glm::vec3& point : ringArc(view, gizmo, axis))
            if (const auto pixel = view.pixel(point)) arc.push_back(*pixel);
        handles.path(arc, colorOf({GizmoPart::Kind::ring, axis}));
    }
    const auto origin = view.pixel(gizmo.origin);
    if (!origin) return;
    for (int axis = 0; axis < 3; ++axis) {
        const auto tip = view.pixel(arrowTip(gizmo, axis));
        if (tip && canBeDragged(view, gizmo, axis))
            handles.arrow(*origin, *tip, colorOf({GizmoPart::Kind::arrow, axis}));
    }
    handles.dot(*origin, Handles::kPlain);
}

}  // namespace

// ---- Keyframes ----------------------------------------------------------------------------------

HeadPose headAt(const hair::MotionSettings& motion, double time) {
    return poseOf(hair::simulation::HeadMotion(motion).keyframeAt(time));
}

hair::MotionSettings
motionUntil(const hair::MotionSettings& motion, const Moment& moment, double frame_time) {
    hair::MotionSettings until = motion;
    if (motion.keyframes.empty()) return until;
    cut(until, moment.now);
    if (frame_time <= 0.0) return until;
    const hair::simulation::HeadMotion before(motion), after(until);
    std::vector<hair::Keyframe> keys;
    bool is_same = true;
    for (double frame = 1.0; static_cast<float>(frame * frame_time) <= moment.now; frame += 1.0) {
        const double time = frame * frame_time;
        const hair::Keyframe key = before.keyframeAt(time);
        is_same &= same(key, after.keyframeAt(time));
        keys.push_back(keys.empty() ? key : unwound(key, keys.back()));
    }
    if (!is_same && keys.size() + kKeysOfAMove <= mostKeys()) until.keyframes = std::move(keys);
    return until;
}

bool moveHead(hair::MotionSettings& motion, const Moment& moment, const HeadPose& pose) {
    const HeadPose wanted{
        allowed(&hair::Keyframe::rotation, pose.rotation),
        allowed(&hair::Keyframe::translation, pose.translation)};
    if (wanted == headAt(motion, double{moment.next})) return false;
    if (motion.keyframes.size() + kKeysOfAMove > mostKeys()) return false;
    cut(motion, moment.now);
    motion.keyframes.push_back(keyOf(wanted, moment.next));
    return true;
}

// ---- The tool -----------------------------------------------------------------------------------

Gizmo headGizmo(const glm::vec3& pivot, const HeadPose& pose, float size) {
    const glm::quat yaw = glm::angleAxis(glm::radians(pose.rotation.y), glm::vec3{0, 1, 0});
    const glm::quat pitch = glm::angleAxis(glm::radians(pose.rotation.x), glm::vec3{1, 0, 0});
    return {
        .origin = pivot + pose.translation,
        .turn_axes =
            {yaw * glm::vec3{1, 0, 0}, glm::vec3{0, 1, 0}, yaw * pitch * glm::vec3{0, 0, 1}},
        .size = size};
}

Edit HeadTool::drag(const Pointer& pointer, hair::Settings& settings, const Shown& played) {
    Drag& drag = *drag_;
    const int axis = drag.part.axis;
    if (drag.part.kind == GizmoPart::Kind::arrow) {
        drag.pose.translation[axis] = drag.start.translation[axis] +
                                      moved(pointer.view, drag.gizmo, axis, drag.from, pointer.at);
    } else {
        drag.angle += turned(pointer.view, drag.gizmo, axis, drag.last, pointer.at);
        drag.pose.rotation[axis] = drag.start.rotation[axis] + glm::degrees(drag.angle);
    }
    drag.last = pointer.at;
    Edit edit{.changed = false, .continues = true};
    const Moment moment = momentOf(played);
    if (!drag.has_moved && drag.pose != drag.start) {
        drag.has_moved = true;
        settings.simulation.motion = motionUntil(
            played.settings.simulation.motion, moment, double{played.settings.run.frame_time});
        edit.changed = true;
    }
    if (drag.has_moved) edit.changed |= moveHead(settings.simulation.motion, moment, drag.pose);
    return edit;
}

Edit HeadTool::update(
    const Pointer& pointer, Handles& handles, hair::Settings& settings, const Shown& played,
    bool runs) {
    const PictureView& view = pointer.view;
    const hair::MotionSettings& motion = played.settings.simulation.motion;
    const Moment moment = momentOf(played);
    // While paused, an edit takes effect in the next frame, but the gizmo shows it now.
    HeadPose pose = headAt(motion, double{runs ? moment.now : moment.next});
    bool drags = drag_ && drag_->played == &played;
    if (drags && !pointer.pressed) pose = drag_->pose;
    Gizmo gizmo = headGizmo(motion.pivot, pose, 0.0f);
    const float scale = view.pixelsPerMetre(gizmo.origin);
    if (scale <= 0.0f || !view.pixel(gizmo.origin)) {
        handles.hint("The head's pivot is behind the camera.");
        if (drags) drag_.reset();
        return {};
    }
    gizmo.size = std::min(
        std::min(kSize * ImGui::GetFontSize(), kMostShare * view.rect().size.y) / scale,
        kMostDepth * view.depth(gizmo.origin));
    std::optional<GizmoPart> hot;
    if (drags && !pointer.pressed)
        hot = drag_->part;
    else if (pointer.hovers)
        hot = pickGizmo(view, gizmo, pointer.at, Handles::reach());
    if (pointer.pressed) {
        drag_.reset();
        if (hot)
            drag_ = Drag{
                .played = &played,
                .part = *hot,
                .gizmo = gizmo,
                .start = pose,
                .pose = pose,
                .from = pointer.at,
                .last = pointer.at};
        drags = hot.has_value();
    }
    Edit edit;
    if (drags) edit = drag(pointer, settings, played);
    draw(view, handles, gizmo, hot);
    if (hot && drags)
        handles.label(pointer.at, textOf(*hot, drag_->pose));
    else if (hot)
        ImGui::SetTooltip("%s", tooltipOf(*hot).c_str());
    if (!runs && (drags || pose != headAt(motion, double{moment.now})))
        handles.hint("Paused: the head is there from the next frame on.");
    if (drags && !pointer.holds) drag_.reset();
    return edit;
}

Edit HeadTool::options(OptionsLine& line, hair::Settings& settings) {
    hair::MotionSettings& motion = settings.simulation.motion;
    const std::string name =
        "Clear motion (" + std::to_string(motion.keyframes.size()) + ")###clear_motion";
    if (!line.button(
            name.c_str(), !motion.keyframes.empty(),
            "Removes all keyframes, as if the head had never moved"))
        return {};
    motion.keyframes.clear();
    motion.repeat = false;
    drag_.reset();
    return {.changed = true};
}

}  // namespace benchmarks::viewer
