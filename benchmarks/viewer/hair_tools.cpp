#include "benchmarks/viewer/toolbar.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <imgui.h>

#include "benchmarks/viewer/view_tools.h"
#include "hair/groom/style/strokes.h"

namespace benchmarks::viewer {
namespace {

// ---- The path of a hand -------------------------------------------------------------------------

constexpr std::size_t kKeysOfAPull = 3;  // the present, the next frame, and the position it keeps

// Cuts a path after the present and adds a key there. Clears a path that begins later.
void cut(std::vector<hair::PullKey>& path, float now) {
    if (path.empty()) return;
    const glm::vec3 present = handAt(path, now);
    std::erase_if(path, [&](const hair::PullKey& key) { return key.time > now; });
    if (!path.empty() && path.back().time < now) path.push_back({now, present});
}

// ---- The tool that grabs ------------------------------------------------------------------------

constexpr float kCentimetres = 100.0f;  // per m
constexpr float kMostRadius = 10.0f;  // cm, at the end of the slider

std::size_t indexOf(const GuideVertex& held, const Shown& played) {
    return std::size_t{held.guide} * played.vertices_per_guide + held.vertex;
}

bool samePath(const std::vector<hair::PullKey>& a, const std::vector<hair::PullKey>& b) {
    const auto same = [](const hair::PullKey& x, const hair::PullKey& y) {
        return x.time == y.time && x.position == y.position;
    };
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), same);
}

std::optional<GuideVertex> under(const Pointer& pointer, const Shown& played) {
    // Depth decides between two vertices at the same distance from the mouse.
    return pickVertex(
        pointer.view, played.guides, played.vertices_per_guide, pointer.at, 2.5f * Handles::reach(),
        played.rest.radius);
}

// ---- The wind's arrow ---------------------------------------------------------------------------

// Lengths in radii of the groom.
constexpr float kStill = 0.35f;
constexpr float kDoubling = 0.4f;  // added per doubling of a strong wind

// From this wind on, a light breeze, each doubling adds kDoubling to the arrow.
float breeze(const hair::WindSettings& wind) {
    return wind.mode == hair::WindMode::drag ? 2.0f : 3.0f;  // m/s; m/s^2
}

const char* windUnit(const hair::WindSettings& wind) {
    return wind.mode == hair::WindMode::drag ? "m/s" : "m/s²";
}

// Returns the direction as a unit vector.
glm::vec3 windDirection(const hair::WindSettings& wind) {
    const float length = glm::length(wind.direction);
    return length > 0.0f ? wind.direction / length : glm::vec3{1, 0, 0};
}

// ---- The tool of the wind -----------------------------------------------------------------------

// Returns the groom at rest, moved with the head, so that the arrow does not sway with the hair.
Sphere groomOf(const Shown& played) {
    Sphere groom = played.rest;
    groom.center = played.head(groom.center);
    return groom;
}

std::string textOf(const hair::WindSettings& wind) {
    std::array<char, 64> text{};
    std::snprintf(
        text.data(), text.size(), "wind %.3g %s", static_cast<double>(windOf(wind)),
        windUnit(wind));
    return text.data();
}

bool same(const hair::WindSettings& a, const hair::WindSettings& b) {
    return a.direction == b.direction && windOf(a) == windOf(b);
}

}  // namespace

// ---- The path of a hand -------------------------------------------------------------------------

glm::vec3 handAt(std::span<const hair::PullKey> path, float time) {
    const auto after = std::ranges::upper_bound(path, time, {}, &hair::PullKey::time);
    if (after == path.begin()) return path.front().position;
    if (after == path.end()) return path.back().position;
    const hair::PullKey& before = *(after - 1);
    const float share = (time - before.time) / (after->time - before.time);
    return glm::mix(before.position, after->position, share);
}

void moveHand(std::vector<hair::PullKey>& path, const Moment& moment, glm::vec3 position) {
    position = allowed(&hair::PullKey::position, position);
    cut(path, moment.now);
    if (path.empty()) path.push_back({moment.now, position});
    // A resting hand needs no key per frame.
    if (path.size() >= 2 && path.back().position == position &&
        path[path.size() - 2].position == position)
        path.pop_back();
    path.push_back({moment.next, position});
    path.push_back({moment.later, position});
}

void release(std::vector<hair::PullKey>& path, const Moment& moment) {
    if (path.empty()) return;
    const glm::vec3 wanted = path.back().position;
    cut(path, moment.now);
    if (path.size() == 1) path.push_back({moment.next, wanted});
}

bool hasRoom(std::span<const hair::PullKey> path) {
    return path.size() + kKeysOfAPull <= mostOf(&hair::PullSettings::path);
}

// ---- The tool that grabs ------------------------------------------------------------------------

Edit GrabTool::drag(const Pointer& pointer, hair::Settings& settings, const Shown& played) {
    std::vector<hair::PullSettings>& pulls = settings.simulation.pulls;
    const Moment moment = momentOf(played);
    Edit edit{.changed = false, .continues = true};
    if (!drag_->pull && pointer.at != drag_->from && pointer.holds &&
        pulls.size() < mostOf(&hair::SimulationSettings::pulls)) {
        drag_->pull = pulls.size();
        pulls.push_back(
            {.guide = drag_->held.guide,
             .vertex = drag_->held.vertex,
             .radius = allowed(&hair::PullSettings::radius, radius_),
             .path = {{moment.now, drag_->start}}});
    }
    // The pull may have been undone in the meantime.
    if (!drag_->pull || *drag_->pull >= pulls.size()) {
        if (!pointer.holds || drag_->pull) drag_.reset();
        return edit;
    }
    std::vector<hair::PullKey>& path = pulls[*drag_->pull].path;
    const std::vector<hair::PullKey> before = path;
    const bool ends = !pointer.holds || !hasRoom(path);
    if (ends)
        release(path, moment);
    else
        moveHand(
            path, moment,
            drag_->start + pointer.view.dragged(drag_->start, drag_->from, pointer.at));
    edit.changed = !samePath(before, path);
    if (!ends) return edit;
    if (path.empty()) pulls.erase(pulls.begin() + static_cast<std::ptrdiff_t>(*drag_->pull));
    drag_.reset();
    return edit;
}

Edit GrabTool::update(
    const Pointer& pointer, Handles& handles, hair::Settings& settings, const Shown& played,
    bool runs) {
    if (pointer.pressed) {
        drag_.reset();
        if (const auto held = under(pointer, played))
            drag_ = {&played, *held, played.guides[indexOf(*held, played)], pointer.at, {}};
    }
    const bool drags = drag_ && drag_->played == &played;
    Edit edit;
    if (drags) edit = drag(pointer, settings, played);
    draw(pointer, handles, settings, played);
    if (settings.simulation.solver == hair::Solver::none)
        handles.hint("The solver is none: this hair can't be pulled.");
    else if (settings.simulation.pulls.size() >= mostOf(&hair::SimulationSettings::pulls) && !drags)
        handles.hint("The limit of pulls is reached: clear them first.");
    else if (drags && !runs)
        handles.hint("Paused: the hair follows while frames are played or stepped.");
    return edit;
}

void GrabTool::draw(
    const Pointer& pointer, Handles& handles, const hair::Settings& settings,
    const Shown& played) const {
    const bool drags = drag_ && drag_->played == &played;
    if (!drags && !pointer.hovers) return;
    const auto held = drags ? std::optional(drag_->held) : under(pointer, played);
    // The groom may have changed since it was held, and some frames lack guides.
    if (!held || indexOf(*held, played) >= played.guides.size()) return;
    const glm::vec3 vertex = played.guides[indexOf(*held, played)];
    const auto shown = pointer.view.pixel(vertex);
    if (!shown) return;
    const float reach = radius_ * pointer.view.pixelsPerMetre(vertex);
    const Handles::Color color = drags ? Handles::kHot : Handles::kPlain;
    handles.circle(*shown, reach, color);
    if (drags && drag_->pull && *drag_->pull < settings.simulation.pulls.size()) {
        const auto hand =
            pointer.view.pixel(settings.simulation.pulls[*drag_->pull].path.back().position);
        if (hand) {
            handles.line(*shown, *hand, color);
            handles.dot(*hand, color);
        }
    }
    handles.dot(*shown, color);
    handles.label(
        *shown,
        "guide " + std::to_string(held->guide) + ", vertex " + std::to_string(held->vertex));
}

Edit GrabTool::options(OptionsLine& line, hair::Settings& settings) {
    float centimetres = radius_ * kCentimetres;
    if (line.slider("Radius", centimetres, 0.0f, kMostRadius, "%.1f cm"))
        radius_ = allowed(&hair::PullSettings::radius, centimetres / kCentimetres);
    ImGui::SetItemTooltip("Radius of the next pull: the distance from the held vertex, at rest, at "
                          "which hair gets 1/e of the pull");
    std::vector<hair::PullSettings>& pulls = settings.simulation.pulls;
    const std::string name = "Clear pulls (" + std::to_string(pulls.size()) + ")###clear_pulls";
    if (!line.button(
            name.c_str(), !pulls.empty(),
            "Removes all pulls, as if no hand had ever pulled at this hair"))
        return {};
    pulls.clear();
    drag_.reset();
    return {.changed = true};
}

// ---- The wind's arrow ---------------------------------------------------------------------------

float windOf(const hair::WindSettings& wind) {
    return wind.mode == hair::WindMode::drag ? wind.speed : wind.strength;
}

glm::vec3 windTip(const hair::WindSettings& wind, const Sphere& groom) {
    const float radii = kStill + kDoubling * std::log2(1.0f + windOf(wind) / breeze(wind));
    return groom.center + windDirection(wind) * (radii * groom.radius);
}

void setWindTip(hair::WindSettings& wind, const Sphere& groom, const glm::vec3& tip) {
    const glm::vec3 arrow = tip - groom.center;
    const float radii = glm::length(arrow) / groom.radius;
    if (radii > 0.01f) wind.direction = glm::normalize(arrow);
    setWind(wind, breeze(wind) * (std::exp2(std::max(radii - kStill, 0.0f) / kDoubling) - 1.0f));
}

void setWind(hair::WindSettings& wind, float value) {
    if (wind.mode == hair::WindMode::drag)
        wind.speed = allowed(&hair::WindSettings::speed, value);
    else
        wind.strength = allowed(&hair::WindSettings::strength, value);
    // A wind above 0 needs a direction.
    if (windOf(wind) > 0.0f) wind.direction = windDirection(wind);
}

// ---- The tool of the wind -----------------------------------------------------------------------

Edit WindTool::update(
    const Pointer& pointer, Handles& handles, hair::Settings& settings, const Shown& played) {
    const PictureView& view = pointer.view;
    hair::WindSettings& wind = settings.simulation.wind;
    const Sphere groom = groomOf(played);
    const auto held = view.pixel(windTip(wind, groom));
    const bool hot = pointer.hovers && held && glm::length(*held - pointer.at) < Handles::reach();
    if (pointer.pressed && hot) drag_ = {&played, windTip(wind, groom), pointer.at};
    const bool drags = drag_ && drag_->played == &played;
    Edit edit;
    if (drags) {
        const hair::WindSettings before = wind;
        const glm::vec3 by = view.dragged(drag_->tip, drag_->from, pointer.at);
        if (pointer.at != drag_->from) setWindTip(wind, groom, drag_->tip + by);
        edit = {.changed = !same(before, wind), .continues = true};
        if (!pointer.holds) drag_.reset();
    }
    const auto from = view.pixel(groom.center);
    const auto tip = view.pixel(windTip(wind, groom));
    if (from && tip) {
        handles.arrow(*from, *tip, hot || drags ? Handles::kHot : Handles::kPlain);
        handles.label(*tip, textOf(wind));
    }
    if (hot && !drags)
        ImGui::SetTooltip("Drag: turns the wind; a longer arrow is a stronger wind.");
    if (settings.simulation.solver == hair::Solver::none)
        handles.hint("The solver is none: no wind moves this hair.");
    return edit;
}

Edit WindTool::options(OptionsLine& line, hair::Settings& settings) {
    hair::WindSettings& wind = settings.simulation.wind;
    const bool is_drag = wind.mode == hair::WindMode::drag;
    float value = windOf(wind);
    Edit edit;
    if (line.slider(
            "Wind", value, 0.0f, is_drag ? 20.0f : 30.0f, is_drag ? "%.1f m/s" : "%.1f m/s²")) {
        setWind(wind, value);
        edit = {.changed = true, .continues = ImGui::IsItemActive()};
    }
    ImGui::SetItemTooltip(
        is_drag ? "Mean speed of the wind: /simulation/wind/speed"
                : "Acceleration by the wind: /simulation/wind/strength");
    if (line.button(
            "Still air", windOf(wind) > 0.0f,
            "Sets the wind to 0; the arrow keeps its direction")) {
        setWind(wind, 0.0f);
        edit.changed = true;
    }
    return edit;
}

// ---- Strokes of a comb --------------------------------------------------------------------------

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
