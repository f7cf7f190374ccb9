#include "benchmarks/viewer/head_tool.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <imgui.h>

#include "benchmarks/viewer/edit.h"
#include "hair/simulation/head_motion.h"

namespace benchmarks::viewer {
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
