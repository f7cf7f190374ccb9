#include <array>

#include <imgui.h>

#include "benchmarks/viewer/picture/choice_buttons.h"
#include "benchmarks/viewer/picture/compare_panel.h"
#include "benchmarks/viewer/picture/frame_time_caption.h"
#include "benchmarks/viewer/play/play_panel.h"
#include "benchmarks/viewer/settings/settings_panel.h"
#include "benchmarks/viewer/settings/text_input.h"
#include "benchmarks/viewer/shaders/shader_panel.h"
#include "benchmarks/viewer/shell/columns.h"
#include "benchmarks/viewer/shell/help_panel.h"
#include "benchmarks/viewer/shell/recent_scenes.h"
#include "benchmarks/viewer/shell/setting_actions.h"
#include "benchmarks/viewer/shell/status_line.h"
#include "benchmarks/viewer/viewer_parts.h"
#include "engine/shader_library.h"

namespace benchmarks {

namespace {

constexpr double kToldFor = 12.0;  // s that a message is shown for

constexpr std::array kSides{
    Choice<std::size_t>{"A", 0, "The settings below are those of A."},
    Choice<std::size_t>{"B", 1, "The settings below are those of B; marked ones differ from A."}};

void enabledButton(const char* label, bool enabled, const auto& press) {
    ImGui::BeginDisabled(!enabled);
    if (ImGui::Button(label)) press();
    ImGui::EndDisabled();
}

std::string hintOf(Tool tool) {
    for (const ActionRow& row : actionTable())
        if (toolOf(row.action) == tool) return std::string(row.name) + ": " + row.help;
    return {};
}

}  // namespace

void Viewer::Parts::showScene() {
    Side& side = scene.editedSide();
    ImGui::SetNextItemWidth(-1.0f);
    textInput("##search", search, "Search settings");
    enabledButton("Undo", side.canUndo(), [&] { side.undo(); });
    ImGui::SameLine();
    enabledButton("Redo", side.canRedo(), [&] { side.redo(); });
    if (scene.sideCount() > 1) {
        ImGui::SameLine(0.0f, ImGui::GetFontSize());
        std::size_t edited = scene.edited();
        choiceButtons<std::size_t>(kSides, edited);
        scene.setEdited(edited);
    }
    if (!side.problem().empty()) {
        ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_PlotHistogram));
        ImGui::TextWrapped("%s", side.problem().c_str());
        ImGui::PopStyleColor();
    }
    ImGui::Separator();
    hair::Settings settings = scene.editedSide().wanted();
    Edit edit;
    if (ImGui::BeginChild("fields")) edit = settingsPanel(settings, scene.reference(), search);
    ImGui::EndChild();
    scene.edit(scene.edited(), settings, edit);
}

void Viewer::Parts::showFiles() {
    std::optional<std::filesystem::path> chosen = recentScenes(preferences.now.recent);
    if (const auto listed = scenes.show(scene.file().path)) chosen = listed;
    if (chosen) open(*chosen);
}

void Viewer::Parts::showCompare() {
    compare_panel.edited = static_cast<int>(scene.edited());
    compare_panel.same_camera = scene.cameras == Cameras::linked;
    const bool two = scene.sideCount() > 1;
    const CompareWish wish =
        compare_panel.show(area, scene.side(0).wanted(), two ? &scene.side(1).wanted() : nullptr);
    scene.setEdited(static_cast<std::size_t>(compare_panel.edited));
    scene.cameras = compare_panel.same_camera ? Cameras::linked : Cameras::separate;
    switch (wish) {
    case CompareWish::nothing:
        break;
    case CompareWish::start:
    case CompareWish::stop:
        compare();
        break;
    case CompareWish::swap:
        scene.swapSides();
        break;
    case CompareWish::copy_a_to_b:
        scene.side(1).edit(scene.side(0).wanted(), {.changed = true});
        break;
    }
}

void Viewer::Parts::showTab(Tab tab) {
    switch (tab) {
    case Tab::scene:
        showScene();
        break;
    case Tab::files:
        showFiles();
        break;
    case Tab::timings:
        origin.scene = scene.file().path;
        origin.name = scene.file().name;
        timings.show(
            scene.side(0), scene.sideCount() > 1 ? &scene.side(1) : nullptr, origin,
            presenter.milliseconds());
        break;
    case Tab::compare:
        showCompare();
        break;
    case Tab::shaders:
        shaderPanel(reload);
        break;
    }
}

void Viewer::Parts::showColumn(
    const char* name, const Box& box, std::span<const Tab> shown, Tab& chosen) {
    pane(name, box, Surface::panel, [&] {
        if (tabStrip(shown, chosen)) tabs.choose(chosen);
        ImGui::Spacing();
        if (ImGui::BeginChild(tabName(chosen))) showTab(chosen);
        ImGui::EndChild();
    });
}

void Viewer::Parts::showPicture() {
    {
        Side& side = scene.editedSide();
        hair::Settings settings = side.wanted();
        Edit edit;
        if (ImGui::BeginChild("toolbar", {0.0f, 0.0f}, ImGuiChildFlags_AutoResizeY))
            edit = tools.toolbar(settings, side.player());
        ImGui::EndChild();
        scene.edit(scene.edited(), settings, edit);
    }
    constexpr ImGuiWindowFlags kStill =
        ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse;
    if (ImGui::BeginChild("picture", {0.0f, 0.0f}, ImGuiChildFlags_None, kStill)) {
        std::array<std::string, 2> captions;
        for (std::size_t i = 0; i < scene.sideCount(); ++i)
            captions[i] = frameTimeCaption(scene.side(i).timings());
        for (const PictureArea::Shown& shown : area.show(captions)) {
            const auto index = static_cast<std::size_t>(shown.side);
            hair::Settings settings = scene.side(index).wanted();
            const Edit edit = tools.update(
                shown.rect, shown.clip, shown.hovered, area.held() == shown.side, settings,
                scene.side(index).player());
            scene.edit(index, settings, edit);
        }
    }
    ImGui::EndChild();
}

void Viewer::Parts::showStatus() {
    if (message.count() != told) {
        told = message.count();
        told_at = ImGui::GetTime();
    }
    const Player& player = scene.editedSide().player();
    const hair::RenderSettings& render = player.settings().render;
    StatusText status{
        .text = hintOf(tools.tool),
        .device = device.info().name,
        .picture = std::to_string(render.width) + " × " + std::to_string(render.height) +
                   " px, frame " + std::to_string(player.frame())};
    if (player.previews()) status.picture += ", preview";
    if (!device.shaders().replacements().empty()) status.picture += ", shaders changed";
    if (recorder.records()) {
        status.text = recorder.message();
        status.tone = StatusText::Tone::message;
    } else if (!message.text().empty() && ImGui::GetTime() < told_at + kToldFor) {
        status.text = message.text();
        status.tone = message.tone() == Message::Tone::problem ? StatusText::Tone::problem
                                                               : StatusText::Tone::message;
    }
    statusLine(status);
}

void Viewer::Parts::showWindow() {
    for (const Action action : menuBar([&](Action each) { return stateOf(each); })) perform(action);
    for (const Action action : pressedActions())
        if (stateOf(action).enabled) perform(action);

    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const Layout layout = arrange(
        size.x, size.y, ImGui::GetFrameHeight(), ImGui::GetFontSize(), preferences.now.left,
        preferences.now.right);
    merged = layout.merged;
    if (merged)
        showColumn("Left", layout.left, allTabs(), tabs.only);
    else
        showColumn("Left", layout.left, leftTabs(), tabs.left);
    showColumn("Right", layout.right, rightTabs(), tabs.right);
    pane("Picture", layout.picture, Surface::stage, [&] { showPicture(); });
    pane("Play", layout.play, Surface::bar, [&] {
        const Player& player = scene.side(0).player();
        playPanel(state, player.frame(), player.time());
    });
    pane("Status", layout.status, Surface::bar, [&] { showStatus(); });
    splitters(layout, preferences.now);
    helpPanel(help);
    if (const auto path = path_popup.show()) saveAs(*path);
}

}  // namespace benchmarks
