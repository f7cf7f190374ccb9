#include "benchmarks/viewer/open_scene.h"

#include <algorithm>
#include <array>
#include <utility>

#include <imgui.h>

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

float letters(float count) { return count * ImGui::GetFontSize(); }

void tip(const char* text) {
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_DelayNormal | ImGuiHoveredFlags_AllowWhenDisabled))
        ImGui::SetTooltip("%s", text);
}

void speedCombo(std::optional<double>& speed) {
    const char* name = "other";
    for (const Speed& each : kSpeeds)
        if (each.speed == speed) name = each.name;
    ImGui::SetNextItemWidth(letters(8.0f));
    if (ImGui::BeginCombo("##speed", name)) {
        for (const Speed& each : kSpeeds)
            if (ImGui::Selectable(each.name, each.speed == speed)) speed = each.speed;
        ImGui::EndCombo();
    }
    tip("simulated time per real time; Every frame: one for each picture of the window, as fast as "
        "they come.\nThe simulation's steps are the same at any speed");
}

}  // namespace

// ---- The scene and its sides --------------------------------------------------------------------

OpenScene::OpenScene(
    const engine::Device& device, const SceneFile& file, const hair::Settings& settings)
    : device_(device), file_(file), a_(std::make_unique<Side>(device, settings, file.directory)) {
    a_->setOriginal(file.settings);
}

void OpenScene::open(const SceneFile& file) {
    auto side = std::make_unique<Side>(device_, file.settings, file.directory);
    b_.reset();
    a_ = std::move(side);
    file_ = file;
    edited_ = 0;
    was_saved_ = false;
}

std::vector<Side*> OpenScene::sides() {
    std::vector<Side*> sides{a_.get()};
    if (b_) sides.push_back(b_.get());
    return sides;
}

void OpenScene::startComparing() {
    if (b_) return;
    a_->settle();
    a_->follow();
    auto side = std::make_unique<Side>(device_, a_->player().settings(), file_.directory);
    side->seek(a_->player().frame());
    side->setOriginal(file_.settings);
    b_ = std::move(side);
    edited_ = 1;
}

void OpenScene::stopComparing() {
    b_.reset();
    edited_ = 0;
}

void OpenScene::swapSides() {
    if (!b_) return;
    // What the file has stays the first side's to be compared with.
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

bool OpenScene::play(PlayState& state, double seconds, Frames frames) {
    const std::vector<Side*> all = sides();
    for (Side* const each : all) each->follow();
    const bool seeks = state.seek.has_value();
    if (seeks)
        for (Side* const each : all) each->seek(*state.seek);
    std::uint32_t due = 0;
    if (state.playing)
        due =
            pacer_.framesFor(seconds, double{a_->player().settings().run.frame_time}, state.speed);
    else if (state.step)
        due = 1;
    if (frames == Frames::every_one) due = std::min(due, 1u);
    if (due > 0) {
        // In turns, so that the timings panel has both.
        timing_ = timing_ == engine::Timing::isolated ? engine::Timing::overlapped
                                                      : engine::Timing::isolated;
        for (Side* const each : all) each->play(due, timing_);
    }
    state.seek.reset();
    state.step = false;
    return due > 0 || seeks;
}

void OpenScene::savedAs(const std::filesystem::path& path) {
    file_.path = path;
    file_.name = path.stem().string();
    was_saved_ = true;
    file_.settings = side(edited_).wanted();
    for (Side* const each : sides()) each->setOriginal(file_.settings);
}

// ---- The widgets of time ------------------------------------------------------------------------

void playPanel(PlayState& state, std::uint32_t frame, double time) {
    // As wide as the wider of its two names, so that nothing moves when it is pressed.
    if (ImGui::Button(state.playing ? "Pause###play" : "Play###play", {letters(4.5f), 0.0f}))
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
    ImGui::SetNextItemWidth(letters(5.5f));
    std::uint32_t wanted = frame;
    ImGui::InputScalar("##frame", ImGuiDataType_U32, &wanted);
    if (ImGui::IsItemDeactivatedAfterEdit()) state.seek = wanted;
    tip("the frame that is shown; type another number to go there: the scene is played up to it "
        "from frame 0 on");
    ImGui::SameLine();
    ImGui::Text("%.3f s", time);
    tip("simulated time at the end of the frame");
}

}  // namespace benchmarks::viewer
