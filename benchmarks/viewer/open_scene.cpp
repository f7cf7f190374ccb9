#include "benchmarks/viewer/open_scene.h"

#include <algorithm>
#include <array>
#include <utility>

#include <imgui.h>

#include "benchmarks/viewer/timeline.h"
#include "hair/fields.h"

namespace benchmarks::viewer {
namespace {

struct Speed {
    const char* name;
    std::optional<double> speed;  // simulated seconds per second
};
constexpr std::array kSpeeds{
    Speed{"Every frame", std::nullopt},
    Speed{"1/4x", 0.25},
    Speed{"1/2x", 0.5},
    Speed{"1x", 1.0},
    Speed{"2x", 2.0},
    Speed{"4x", 4.0},
};

float ems(float count) { return count * ImGui::GetFontSize(); }

void tip(const char* text) {
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_DelayNormal | ImGuiHoveredFlags_AllowWhenDisabled))
        ImGui::SetTooltip("%s", text);
}

void speedCombo(std::optional<double>& speed) {
    const char* name = "other";
    for (const Speed& each : kSpeeds)
        if (each.speed == speed) name = each.name;
    ImGui::SetNextItemWidth(ems(8.0f));
    if (ImGui::BeginCombo("##speed", name)) {
        for (const Speed& each : kSpeeds)
            if (ImGui::Selectable(each.name, each.speed == speed)) speed = each.speed;
        ImGui::EndCombo();
    }
    tip("simulated time per real time. Every frame: the window draws each frame once, as fast as "
        "it "
        "can.\nThe simulation's steps are the same at any speed");
}

}  // namespace

// ---- The scene and its sides --------------------------------------------------------------------

OpenScene::OpenScene(const SceneFile& file, const hair::Settings& settings)
    : file_(file), a_(makeSide(settings, file.directory)) {
    a_->setOriginal(file.settings);
}

std::unique_ptr<Side>
OpenScene::makeSide(const hair::Settings& settings, const std::filesystem::path& directory) {
    return std::make_unique<Side>(++sides_made_, settings, directory);
}

void OpenScene::open(const SceneFile& file) {
    coming_ = Coming{.side = makeSide(file.settings, file.directory), .file = file};
}

std::vector<Side*> OpenScene::sides() {
    std::vector<Side*> sides{a_.get()};
    if (b_) sides.push_back(b_.get());
    return sides;
}

Side* OpenScene::find(std::uint64_t id) {
    for (Side* const each : sides())
        if (each->id() == id) return each;
    return nullptr;
}

void OpenScene::startComparing() {
    if (b_) return;
    a_->settle();
    // Does not copy settings that were refused.
    auto side =
        makeSide(a_->problem().empty() ? a_->wanted() : a_->shown().settings, file_.directory);
    side->setOriginal(file_.settings);
    coming_ = Coming{.side = std::move(side), .file = std::nullopt};
}

// Puts the finished side into place.
void OpenScene::arrive(News& news) {
    if (coming_->file) {
        b_.reset();
        a_ = std::move(coming_->side);
        file_ = *coming_->file;
        edited_ = 0;
        was_saved_ = false;
        news.opened = true;
    } else {
        b_ = std::move(coming_->side);
        edited_ = 1;
        news.compares = true;
    }
    coming_.reset();
}

void OpenScene::stopComparing() {
    if (coming_ && !coming_->file) coming_.reset();
    b_.reset();
    edited_ = 0;
}

void OpenScene::swapSides() {
    if (!b_) return;
    // The first side is still compared with the file's settings.
    const hair::Settings original = a_->original();
    std::swap(a_, b_);
    a_->setOriginal(original);
}

const hair::Settings& OpenScene::reference() const {
    return edited_ == 1 && b_ ? a_->wanted() : a_->original();
}

void OpenScene::edit(std::size_t index, const hair::Settings& settings, Edit edit) {
    if (!edit.changed) return;
    side(index).edit(settings, edit);
    if (!b_ || cameras == Cameras::separate) return;
    Side& other = side(1 - index);
    if (!hair::differ(other.wanted().camera, settings.camera)) return;
    hair::Settings followed = other.wanted();
    followed.camera = settings.camera;
    other.edit(followed, edit);
}

bool OpenScene::isFollowed() const {
    return !isMaking() && a_->isFollowed() && (!b_ || b_->isFollowed());
}

bool OpenScene::isDragged() const { return a_->isDragged() || (b_ && b_->isDragged()); }

Order OpenScene::order(PlayState& state, double seconds, Frames frames) {
    Order order;
    for (Side* const each : sides()) order.sides.push_back(each->order());
    // A new side starts at the current frame, so nothing is played while it is made.
    if (isMaking()) {
        if (coming_) {
            order.sides.push_back(coming_->side->order());
            if (!coming_->file) order.sides.back().beside = a_->id();
        }
        return order;
    }
    order.seek = std::exchange(state.seek, std::nullopt);
    const bool steps = std::exchange(state.step, false);
    if (state.playing)
        order.frames =
            pacer_.framesFor(seconds, double{a_->shown().settings.run.frame_time}, state.speed);
    else if (steps)
        order.frames = 1;
    if (order.seek || steps || state.playing) state.scrub.reset();
    if (state.scrub) {
        const std::uint32_t now = a_->shown().frame;
        const std::uint32_t start = *state.scrub < now ? 0 : now;
        const std::uint32_t most = frames == Frames::every_one ? 1 : Pacer::kMostFrames;
        const std::uint32_t part = std::min(*state.scrub - start, most);
        if (*state.scrub < now)
            order.seek = part;
        else
            order.frames = part;
        if (start + part == *state.scrub) state.scrub.reset();
    }
    if (frames == Frames::every_one) order.frames = std::min(order.frames, 1u);
    if (order.frames > 0) {
        // Alternates the modes, so that the timings panel has both.
        timing_ = timing_ == engine::Timing::isolated ? engine::Timing::overlapped
                                                      : engine::Timing::isolated;
        order.timing = timing_;
    }
    return order;
}

OpenScene::News OpenScene::take(std::vector<SideReply> replies, Side::Beside beside) {
    News news;
    for (SideReply& reply : replies) {
        if (coming_ && coming_->side->id() == reply.side) {
            if (reply.failure) {
                news.failure = reply.failure;
                coming_.reset();
            } else {
                coming_->side->take(std::move(reply), beside);
                arrive(news);
            }
            continue;
        }
        // Drops replies for a side that was closed in the meantime.
        Side* const side = find(reply.side);
        if (!side) continue;
        if (reply.failure) news.failure = reply.failure;
        side->take(std::move(reply), beside);
    }
    return news;
}

void OpenScene::savedAs(const std::filesystem::path& path, const hair::Settings& settings) {
    file_.path = path;
    file_.name = path.stem().string();
    was_saved_ = true;
    file_.settings = settings;
    for (Side* const each : sides()) each->setOriginal(file_.settings);
}

// ---- The widgets of time ------------------------------------------------------------------------

void playPanel(PlayState& state, const Shown& shown) {
    // Wide enough for both of its names, so that nothing moves when the button is pressed.
    if (ImGui::Button(state.playing ? "Pause###play" : "Play###play", {ems(4.5f), 0.0f}))
        state.playing = !state.playing;
    tip("plays or pauses: Space");
    ImGui::SameLine();
    ImGui::BeginDisabled(state.playing);
    if (ImGui::Button("Step")) state.step = true;
    ImGui::EndDisabled();
    tip("plays one frame, while paused: .");
    ImGui::SameLine();
    if (ImGui::Button("Restart")) state.seek = 0;
    tip("goes back to frame 0: Home");
    ImGui::SameLine();
    speedCombo(state.speed);
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("Frame");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(ems(5.5f));
    std::uint32_t wanted = shown.frame;
    ImGui::InputScalar("##frame", ImGuiDataType_U32, &wanted);
    if (ImGui::IsItemDeactivatedAfterEdit()) state.seek = wanted;
    tip("the frame that is shown; type another number to go there: the scene is played up to it "
        "from frame 0 on");
    ImGui::SameLine();
    ImGui::Text("%.3f s", shown.time());
    tip("simulated time at the end of the frame");
    ImGui::SameLine();
    timeline(state, shown);
}

}  // namespace benchmarks::viewer
