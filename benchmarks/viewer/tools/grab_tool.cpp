#include "benchmarks/viewer/tools/grab_tool.h"

#include <string>
#include <vector>

#include <imgui.h>

#include "benchmarks/viewer/tools/field_limits.h"
#include "benchmarks/viewer/tools/hand_path.h"

namespace benchmarks {

namespace {

constexpr float kCentimetres = 100.0f;  // per m
constexpr float kMostRadius = 10.0f;    // cm, at the end of the slider

std::size_t indexOf(const GuideVertex& held, const Player& player) {
    return std::size_t{held.guide} * player.played().groom().vertices_per_strand + held.vertex;
}

bool samePath(const std::vector<hair::PullKey>& a, const std::vector<hair::PullKey>& b) {
    const auto same = [](const hair::PullKey& x, const hair::PullKey& y) {
        return x.time == y.time && x.position == y.position;
    };
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), same);
}

std::optional<GuideVertex>
under(const Pointer& pointer, const std::vector<glm::vec3>& guides, const Player& player) {
    const hair::Groom& groom = player.played().groom();
    // Of two that are equally near to the mouse, the one in front.
    return pickVertex(
        pointer.view, guides, groom.vertices_per_strand, pointer.at, 2.5f * Handles::reach(),
        sphereRound(groom.points).radius);
}

}  // namespace

Edit GrabTool::drag(const Pointer& pointer, hair::Settings& settings, const Player& player) {
    std::vector<hair::PullSettings>& pulls = settings.simulation.pulls;
    const Moment moment = momentOf(player);
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
    // It may have been undone on the way.
    if (!drag_->pull || *drag_->pull >= pulls.size()) {
        if (!pointer.holds || drag_->pull) drag_.reset();
        return edit;
    }
    std::vector<hair::PullKey>& path = pulls[*drag_->pull].path;
    const std::vector<hair::PullKey> before = path;
    const bool ends = !pointer.holds || !hasRoom(path);
    if (ends)
        letGo(path, moment);
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
    const Pointer& pointer, Handles& handles, hair::Settings& settings, const Player& player,
    bool runs) {
    if (pointer.pressed) {
        const std::vector<glm::vec3> guides = player.played().guides();
        drag_.reset();
        if (const auto held = under(pointer, guides, player))
            drag_ = {&player, *held, guides[indexOf(*held, player)], pointer.at, {}};
    }
    const bool drags = drag_ && drag_->player == &player;
    Edit edit;
    if (drags) edit = drag(pointer, settings, player);
    draw(pointer, handles, settings, player);
    if (settings.simulation.solver == hair::Solver::none)
        handles.hint("The solver is none: this hair can't be pulled.");
    else if (settings.simulation.pulls.size() >= mostOf(&hair::SimulationSettings::pulls) && !drags)
        handles.hint("There are as many pulls as there can be: clear them first.");
    else if (drags && !runs)
        handles.hint("Paused: the hair follows while frames are played or stepped.");
    return edit;
}

void GrabTool::draw(
    const Pointer& pointer, Handles& handles, const hair::Settings& settings,
    const Player& player) const {
    const bool drags = drag_ && drag_->player == &player;
    if (!drags && !pointer.hovers) return;
    const std::vector<glm::vec3> guides = player.played().guides();
    const auto held = drags ? std::optional(drag_->held) : under(pointer, guides, player);
    if (!held) return;
    const glm::vec3 vertex = guides[indexOf(*held, player)];
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
    ImGui::SetItemTooltip(
        "How far from the held vertex hair is pulled along: at this distance, at rest, by 1/e as "
        "much. Of the next pull.");
    std::vector<hair::PullSettings>& pulls = settings.simulation.pulls;
    const std::string name = "Clear pulls (" + std::to_string(pulls.size()) + ")###clear_pulls";
    if (!line.button(name.c_str(), !pulls.empty(), "No hand has ever pulled at this hair"))
        return {};
    pulls.clear();
    drag_.reset();
    return {.changed = true};
}

}  // namespace benchmarks
