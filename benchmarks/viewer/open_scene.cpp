#include "benchmarks/viewer/open_scene.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include <imgui.h>

#include "benchmarks/scene/scene.h"
#include "engine/error.h"
#include "hair/fields.h"

namespace benchmarks::viewer {

// ---- The timeline -------------------------------------------------------------------------------

namespace {

constexpr double kAtLeast = 2.0;  // s, minimum length of the bar
constexpr double kMostFrames = 1e6;
constexpr float kNarrowest = 8.0f;  // letters

// Returns a simulated time in frames: frame 0 ends after the first frame's time.
float framesAt(const hair::Settings& settings, float time) {
    return static_cast<float>(
        std::min(double{time} / double{settings.run.frame_time} - 1.0, kMostFrames));
}

}  // namespace

std::vector<TimelineMark> timelineMarks(const hair::Settings& settings) {
    std::vector<TimelineMark> marks;
    if (settings.run.frame_time <= 0.0f) return marks;
    for (const hair::Keyframe& key : settings.simulation.motion.keyframes) {
        const float at = framesAt(settings, key.time);
        marks.push_back({TimelineMark::Kind::keyframe, at, at});
    }
    for (const hair::PullSettings& pull : settings.simulation.pulls)
        if (!pull.path.empty())
            marks.push_back(
                {TimelineMark::Kind::pull, framesAt(settings, pull.path.front().time),
                 framesAt(settings, pull.path.back().time)});
    return marks;
}

std::uint32_t
timelineEnd(const hair::Settings& settings, std::uint32_t frame, std::uint32_t furthest) {
    double end = std::max(frame, furthest);
    if (settings.run.frame_time > 0.0f)
        end = std::max(end, std::ceil(kAtLeast / double{settings.run.frame_time} - 1.0));
    end = std::max(end, 1.0);
    for (const TimelineMark& mark : timelineMarks(settings))
        end = std::max(end, std::ceil(double{mark.to}));
    return static_cast<std::uint32_t>(std::min(end, kMostFrames));
}

void timeline(PlayState& state, const Shown& shown) {
    state.furthest = std::max(state.furthest, shown.frame);
    const float letter = ImGui::GetFontSize();
    const ImVec2 room{ImGui::GetContentRegionAvail().x, ImGui::GetFrameHeight()};
    if (room.x < kNarrowest * letter) return;
    const std::uint32_t end = timelineEnd(shown.settings, shown.frame, state.furthest);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("##timeline", room);
    const bool held = ImGui::IsItemActive();
    const bool hovered = ImGui::IsItemHovered();

    const float margin = 0.4f * letter;
    const float width = room.x - 2.0f * margin;
    const auto at = [&](float frame) {
        const float share = std::clamp(frame / static_cast<float>(end), 0.0f, 1.0f);
        return corner.x + margin + share * width;
    };
    const float share = (ImGui::GetIO().MousePos.x - corner.x - margin) / width;
    const auto under = static_cast<std::uint32_t>(
        std::lround(std::clamp(share, 0.0f, 1.0f) * static_cast<float>(end)));
    if (held) {
        state.playing = false;
        state.scrub = under;
    }

    ImDrawList& list = *ImGui::GetWindowDrawList();
    const auto color = [](ImGuiCol of, float alpha) { return ImGui::GetColorU32(of, alpha); };
    const float middle = corner.y + 0.5f * room.y;
    const float half = 0.16f * room.y;
    list.AddRectFilled(
        {at(0.0f), middle - half}, {at(static_cast<float>(end)), middle + half},
        color(ImGuiCol_FrameBg, 1.0f), half);
    const float now = at(static_cast<float>(shown.frame));
    list.AddRectFilled(
        {at(0.0f), middle - half}, {now, middle + half}, color(ImGuiCol_SliderGrab, 0.5f), half);
    for (const TimelineMark& mark : timelineMarks(shown.settings)) {
        if (mark.kind == TimelineMark::Kind::pull) {
            list.AddRectFilled(
                {at(mark.from), middle + half + 1.0f},
                {std::max(at(mark.to), at(mark.from) + 2.0f), middle + half + 0.22f * letter},
                color(ImGuiCol_PlotHistogram, 1.0f));
            continue;
        }
        const float x = at(mark.from), size = 0.22f * letter;
        list.AddQuadFilled(
            {x, middle - size}, {x + size, middle}, {x, middle + size}, {x - size, middle},
            color(ImGuiCol_Text, 0.8f));
    }
    // The target frame and the shown frame.
    if (state.scrub)
        list.AddLine(
            {at(static_cast<float>(*state.scrub)), corner.y},
            {at(static_cast<float>(*state.scrub)), corner.y + room.y}, color(ImGuiCol_Text, 0.5f));
    list.AddRectFilled(
        {now - 0.14f * letter, corner.y + 1.0f}, {now + 0.14f * letter, corner.y + room.y - 1.0f},
        color(held || hovered ? ImGuiCol_SliderGrabActive : ImGuiCol_SliderGrab, 1.0f), 2.0f);
    if (!hovered && !held) return;
    std::array<char, 128> text{};
    if (state.scrub && *state.scrub != shown.frame)
        std::snprintf(
            text.data(), text.size(), "plays to frame %u: at %u", *state.scrub, shown.frame);
    else
        std::snprintf(
            text.data(), text.size(), "frame %u of %u, %.3f s; drag to play to another", under, end,
            (static_cast<double>(under) + 1.0) * double{shown.settings.run.frame_time});
    ImGui::SetTooltip("%s", text.data());
}

// ---- The open scene -----------------------------------------------------------------------------

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
    coming_ = Coming{.side = std::move(side)};
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
