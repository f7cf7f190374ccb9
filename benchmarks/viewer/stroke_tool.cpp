#include "benchmarks/viewer/stroke_tool.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <imgui.h>

#include "benchmarks/viewer/camera_tool.h"
#include "hair/groom/style/strokes.h"

namespace benchmarks::viewer {
namespace {

struct BrushRow {
    hair::BrushTool brush;
    const char* name;
    const char* tooltip;
};

constexpr BrushRow kBrushes[] = {
    {hair::BrushTool::comb, "Comb", "Hair follows the brush"},
    {hair::BrushTool::cut, "Cut", "Hair ends where the brush passes"},
    {hair::BrushTool::lengthen, "Lengthen", "Hair grows beyond its tips"},
    {hair::BrushTool::push, "Push", "Hair moves away from the head"},
    {hair::BrushTool::clump, "Clump", "Tips are drawn to the brush's path"}};

constexpr float kMetresOfCentimetre = 0.01f;
constexpr float kLargest = 15.0f;  // cm, at the end of the slider
constexpr float kSizeStep = 1.15f;  // per key press
constexpr float kPlaceStep = 0.125f;  // share of the radius between points of a path
constexpr float kSteepest = 0.5f;  // limit of the brush's movement in depth, over its movement
                                   // along the picture
constexpr std::size_t kMostPredicted = 1u << 15;  // guide vertices that can be brushed in each
                                                  // picture

std::optional<glm::vec3> hairUnder(const Pointer& pointer, const Shown& played) {
    return pickHair(
        pointer.view, played.guides, played.vertices_per_guide, pointer.at,
        2.5f * Handles::reach());
}

glm::vec3 turnedBack(const hair::simulation::RigidMotion& head, const glm::vec3& point) {
    return glm::conjugate(head.rotation) * (glm::dvec3(point) - head.translation);
}

}  // namespace

// ---- Rest ---------------------------------------------------------------------------------------

RestPlace::RestPlace(const Shown& shown, const glm::vec3& hit) : head_(shown.head) {
    std::size_t nearest = 0;
    float distance = std::numeric_limits<float>::max();
    for (std::size_t i = 0; i < shown.guides.size(); ++i) {
        const float other = glm::distance(shown.guides[i], hit);
        if (other >= distance) continue;
        distance = other;
        nearest = i;
    }
    if (shown.rest_guides.size() == shown.guides.size() && !shown.guides.empty())
        moved_ = turnedBack(head_, shown.guides[nearest]) - shown.rest_guides[nearest];
}

glm::vec3 RestPlace::toRest(const glm::vec3& now) const { return turnedBack(head_, now) - moved_; }

// ---- The tool -----------------------------------------------------------------------------------

void StrokeTool::resize() {
    if (ImGui::GetIO().WantTextInput) return;
    float size = radius_;
    if (ImGui::IsKeyPressed(ImGuiKey_RightBracket)) size *= kSizeStep;
    if (ImGui::IsKeyPressed(ImGuiKey_LeftBracket)) size /= kSizeStep;
    if (size != radius_) radius_ = allowed(&hair::StrokeSettings::radius, size);
}

Edit StrokeTool::press(const Pointer& pointer, hair::Settings& settings, const Shown& played) {
    std::vector<hair::StrokeSettings>& strokes = settings.groom.edits;
    if (!played.has_guides || strokes.size() >= mostOf(&hair::GroomSettings::edits)) return {};
    auto place = hairUnder(pointer, played);
    if (!place) place = pointUnder(pointer.view, pointer.at, 2.5f * Handles::reach(), played);
    if (!place) return {};
    drag_ = {&played, RestPlace(played, *place), *place, pointer.at, strokes.size(), {}};
    strokes.push_back(
        {.tool = brush_,
         .radius = allowed(&hair::StrokeSettings::radius, radius_),
         .strength = allowed(&hair::StrokeSettings::strength, strength_),
         .path = {{allowed(&hair::StrokePoint::position, drag_->rest.toRest(*place))}}});
    return {.changed = true, .continues = true};
}

// The brush follows the hair under the mouse, but never steeply in depth, so that it does not fall
// through between strands.
Edit StrokeTool::drag(const Pointer& pointer, hair::Settings& settings, const Shown& played) {
    std::vector<hair::StrokeSettings>& strokes = settings.groom.edits;
    Edit edit{.changed = false, .continues = true};
    // The stroke may have been undone in the meantime.
    if (drag_->stroke >= strokes.size()) {
        drag_.reset();
        return edit;
    }
    std::vector<hair::StrokePoint>& path = strokes[drag_->stroke].path;
    glm::vec3 place = drag_->place + pointer.view.dragged(drag_->place, drag_->at, pointer.at);
    const float way = glm::distance(place, drag_->place);
    if (const auto hair = hairUnder(pointer, played)) {
        const float deeper = pointer.view.depth(*hair) - pointer.view.depth(place);
        place -= std::clamp(deeper, -kSteepest * way, kSteepest * way) * pointer.view.back();
    }
    const glm::vec3 rest = drag_->rest.toRest(place);
    const float least = kPlaceStep * strokes[drag_->stroke].radius;
    const bool is_far = glm::distance(rest, path.back().position) >= least;
    if ((is_far || (!pointer.holds && way > 0.0f)) &&
        path.size() < mostOf(&hair::StrokeSettings::path)) {
        path.push_back({allowed(&hair::StrokePoint::position, rest)});
        drag_->place = place;
        drag_->at = pointer.at;
        edit.changed = true;
    }
    if (pointer.holds) return edit;
    // A comb without movement has no effect.
    if (strokes[drag_->stroke].tool == hair::BrushTool::comb && path.size() == 1) {
        strokes.erase(strokes.begin() + static_cast<std::ptrdiff_t>(drag_->stroke));
        edit.changed = true;
    }
    drag_.reset();
    return edit;
}

// Previews the stroke's effect on the guides, without keeping them out of the head.
void StrokeTool::predict(const hair::Settings& settings, const Shown& played) {
    drag_->guides.clear();
    const std::size_t vertices = played.vertices_per_guide;
    if (played.rest_guides.empty() || played.rest_guides.size() > kMostPredicted) return;
    drag_->guides = played.rest_guides;
    glm::dvec3 middle(0.0);
    for (std::size_t i = 0; i < drag_->guides.size(); i += vertices) middle += drag_->guides[i];
    middle /= static_cast<double>(drag_->guides.size() / vertices);
    const std::span<const hair::StrokeSettings> one(&settings.groom.edits[drag_->stroke], 1);
    const hair::groom::Strokes stroke(one, nullptr, 0.0, middle);
    for (std::size_t i = 0; i < drag_->guides.size(); i += vertices)
        stroke.replay(std::span(drag_->guides).subspan(i, vertices), {});
}

void StrokeTool::draw(const Pointer& pointer, Handles& handles, const Shown& played) {
    const bool drags = drag_ && drag_->played == &played;
    if (drags && drag_->guides.size() == played.guides.size()) {
        const std::size_t vertices = played.vertices_per_guide;
        std::vector<glm::vec2> line;
        for (std::size_t i = 0; i < played.guides.size(); i += vertices) {
            const auto changed = std::span(drag_->guides).subspan(i, vertices);
            const auto rest = std::span(played.rest_guides).subspan(i, vertices);
            if (std::ranges::equal(changed, rest)) continue;
            line.clear();
            for (std::size_t k = 0; k < vertices; ++k) {
                const glm::vec3 by = played.head.rotation * glm::dvec3(changed[k] - rest[k]);
                if (const auto shown = pointer.view.pixel(played.guides[i + k] + by))
                    line.push_back(*shown);
            }
            handles.thinPath(line, Handles::kHot);
        }
    }
    if (drags)
        under_ = drag_->place;
    else if (!pointer.hovers)
        return;
    else if (const auto hair = hairUnder(pointer, played))
        under_ = *hair;
    const glm::vec3 place = under_.value_or(played.head(played.rest.center));
    handles.circle(
        pointer.at, radius_ * pointer.view.pixelsPerMetre(place),
        drags ? Handles::kHot : Handles::kPlain);
}

Edit StrokeTool::update(
    const Pointer& pointer, Handles& handles, hair::Settings& settings, const Shown& played) {
    Edit edit;
    if (pointer.pressed && !drag_) {
        edit = press(pointer, settings, played);
        if (drag_) predict(settings, played);
    } else if (drag_ && drag_->played == &played) {
        edit = drag(pointer, settings, played);
        if (drag_ && edit.changed) predict(settings, played);
    }
    const bool drags = drag_ && drag_->played == &played;
    draw(pointer, handles, played);
    if (!played.has_guides)
        handles.hint("Pause first: with so many guides the brush does not follow played frames.");
    else if (settings.groom.edits.size() >= mostOf(&hair::GroomSettings::edits) && !drags)
        handles.hint("The limit of strokes is reached: save the strands, or clear the strokes.");
    else if (drags)
        handles.hint("Lines show the guides; the hair follows when you release the brush.");
    return edit;
}

Edit StrokeTool::options(OptionsLine& line, hair::Settings& settings) {
    resize();
    for (const BrushRow& row : kBrushes)
        if (line.choice(
                row.name,
                row.brush == brush_ ? OptionsLine::Choice::chosen : OptionsLine::Choice::open,
                row.tooltip))
            brush_ = row.brush;
    line.separator();
    float centimetres = radius_ / kMetresOfCentimetre;
    if (line.slider("Radius", centimetres, 0.2f, kLargest, "%.1f cm"))
        radius_ = allowed(&hair::StrokeSettings::radius, centimetres * kMetresOfCentimetre);
    ImGui::SetItemTooltip("Radius of the next stroke: [ and ] change it");
    if (line.slider("Strength", strength_, 0.0f, 1.0f, "%.2f"))
        strength_ = allowed(&hair::StrokeSettings::strength, strength_);
    ImGui::SetItemTooltip("Strength of the next stroke");
    std::vector<hair::StrokeSettings>& strokes = settings.groom.edits;
    const std::string name =
        "Clear strokes (" + std::to_string(strokes.size()) + ")###clear_strokes";
    if (!line.button(
            name.c_str(), !strokes.empty(), "Removes all strokes of brushes: /groom/edits"))
        return {};
    strokes.clear();
    drag_.reset();
    return {.changed = true};
}

}  // namespace benchmarks::viewer
