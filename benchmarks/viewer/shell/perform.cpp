#include <algorithm>

#include <imgui.h>

#include "benchmarks/viewer/shell/setting_actions.h"
#include "benchmarks/viewer/viewer_parts.h"

namespace benchmarks {

namespace {

constexpr float kZoomStep = 1.125f;

std::optional<engine::PresentMode> presentModeOf(Action action) {
    switch (action) {
    case Action::present_fifo:
        return engine::PresentMode::fifo;
    case Action::present_mailbox:
        return engine::PresentMode::mailbox;
    case Action::present_immediate:
        return engine::PresentMode::immediate;
    default:
        return std::nullopt;
    }
}

std::optional<Tab> tabOf(Action action) {
    switch (action) {
    case Action::open_scene:
    case Action::panel_files:
        return Tab::files;
    case Action::panel_scene:
        return Tab::scene;
    case Action::panel_timings:
        return Tab::timings;
    case Action::panel_compare:
        return Tab::compare;
    case Action::panel_shaders:
        return Tab::shaders;
    default:
        return std::nullopt;
    }
}

}  // namespace

void Viewer::Parts::compare() {
    message.attempt([&] {
        if (scene.sideCount() > 1) {
            scene.stopComparing();
            area.views = Views::a;
            message.tell("A is shown alone");
        } else {
            scene.startComparing();
            area.views = Views::side_by_side;
            message.tell("the settings panel is B's now; A is as it was");
        }
    });
}

// Whether it is an action on settings.
bool Viewer::Parts::changeSetting(Action action) {
    hair::Settings settings = scene.editedSide().wanted();
    const Player& player = scene.editedSide().player();
    Edit edit{.changed = true};
    if (bool* const value = switchOf(action, settings))
        *value = !*value;
    else if (const CameraPreset* const preset = presetOf(action))
        edit = tools.look(settings, player, *preset);
    else if (action == Action::frame_groom)
        edit = tools.frameGroom(settings, player);
    else
        return false;
    scene.edit(scene.edited(), settings, edit);
    return true;
}

// Where there is room for one column only, it is both.
void Viewer::Parts::toggleColumn(Column& column) {
    Preferences& now = preferences.now;
    if (merged)
        now.left.shown = now.right.shown = !(now.left.shown || now.right.shown);
    else
        column.shown = !column.shown;
}

// Whether it is an action on the window's arrangement.
bool Viewer::Parts::changeWindow(Action action) {
    Preferences& now = preferences.now;
    const auto zoomTo = [&](float zoom) {
        now.zoom = std::clamp(zoom, kSmallestZoom, kLargestZoom);
    };
    if (const std::optional<Tab> tab = tabOf(action)) {
        tabs.choose(*tab);
        (std::ranges::count(leftTabs(), *tab) > 0 ? now.left : now.right).shown = true;
        return true;
    }
    if (const std::optional<engine::PresentMode> mode = presentModeOf(action)) {
        now.present_mode = *mode;
        return true;
    }
    switch (action) {
    case Action::dark_theme:
        now.theme = Theme::dark;
        return true;
    case Action::light_theme:
        now.theme = Theme::light;
        return true;
    case Action::larger:
        zoomTo(now.zoom * kZoomStep);
        return true;
    case Action::smaller:
        zoomTo(now.zoom / kZoomStep);
        return true;
    case Action::left_column:
        toggleColumn(now.left);
        return true;
    case Action::right_column:
        toggleColumn(now.right);
        return true;
    case Action::help:
        help = !help;
        return true;
    case Action::reset_layout: {
        const Preferences first;
        now.left = first.left;
        now.right = first.right;
        now.zoom = first.zoom;
        tabs = {};
        return true;
    }
    default:
        return false;
    }
}

void Viewer::Parts::perform(Action action) {
    if (changeSetting(action) || changeWindow(action)) return;
    if (const std::optional<Tool> tool = toolOf(action)) {
        tools.tool = *tool;
        return;
    }
    switch (action) {
    case Action::save_scene:
        save();
        break;
    case Action::save_scene_as:
        path_popup.open(suggestedPath());
        break;
    case Action::copy_axes:
        copyArguments();
        break;
    case Action::screenshot:
        screenshot();
        break;
    case Action::record:
        record();
        break;
    case Action::quit:
        window.close();
        break;
    case Action::undo:
        scene.editedSide().undo();
        break;
    case Action::redo:
        scene.editedSide().redo();
        break;
    case Action::play:
        state.playing = !state.playing;
        break;
    case Action::step:
        state.step = true;
        break;
    case Action::restart:
        state.seek = 0;
        break;
    case Action::compare:
        compare();
        break;
    case Action::edit_other:
        scene.setEdited(1 - scene.edited());
        break;
    default:
        break;
    }
}

ActionState Viewer::Parts::stateOf(Action action) const {
    const Preferences& now = preferences.now;
    hair::Settings settings = scene.editedSide().wanted();
    if (const bool* const value = switchOf(action, settings)) return {.checked = *value};
    if (const std::optional<Tool> tool = toolOf(action)) return {.checked = tools.tool == *tool};
    if (const std::optional<engine::PresentMode> mode = presentModeOf(action))
        return {
            .checked = presenter.mode() == *mode,
            .enabled = std::ranges::count(presenter.modes(), *mode) > 0};
    switch (action) {
    case Action::record:
        return {.checked = recorder.records()};
    case Action::undo:
        return {.enabled = scene.editedSide().canUndo()};
    case Action::redo:
        return {.enabled = scene.editedSide().canRedo()};
    case Action::play:
        return {.checked = state.playing};
    case Action::step:
        return {.enabled = !state.playing};
    case Action::compare:
        return {.checked = scene.sideCount() > 1};
    case Action::edit_other:
        return {.enabled = scene.sideCount() > 1};
    case Action::dark_theme:
        return {.checked = now.theme == Theme::dark};
    case Action::light_theme:
        return {.checked = now.theme == Theme::light};
    case Action::left_column:
        return {.checked = now.left.shown || (merged && now.right.shown)};
    case Action::right_column:
        return {.checked = now.right.shown || (merged && now.left.shown)};
    case Action::help:
        return {.checked = help};
    default:
        return {};
    }
}

}  // namespace benchmarks
