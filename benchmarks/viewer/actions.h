#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "benchmarks/viewer/camera_tool.h"
#include "benchmarks/viewer/toolbar.h"
#include "hair/settings.h"

// What the menus and keys do: a table of actions, from which menu bar, keys and help are made.
namespace benchmarks::viewer {

enum class Action {
    open_scene,
    save_scene,
    save_scene_as,
    copy_axes,
    screenshot,
    record,  // on and off
    quit,
    undo,
    redo,
    play,  // plays or pauses
    step,
    restart,
    preview,  // of what moves, on and off
    frame_groom,
    view_front,
    view_side,
    view_back,
    view_top,
    view_close,
    view_far,
    overlay_guides,
    overlay_root_triangles,
    overlay_bodies,
    show_head,
    show_hair,
    show_shading,
    show_tangents,
    show_normals,
    show_levels,
    show_strands,
    show_shadow,
    show_overdraw,
    show_density,
    tool_camera,
    tool_wind,
    tool_grab,
    tool_brush,
    tool_head,
    tool_colliders,
    tool_lights,
    compare,  // on and off
    edit_other,  // the other of two sides
    present_fifo,
    present_mailbox,
    present_immediate,
    dark_theme,
    light_theme,
    larger,
    smaller,
    left_column,  // shown or not
    right_column,
    panel_scene,
    panel_files,
    panel_timings,
    panel_compare,
    panel_shaders,
    reset_layout,
    help,
};
inline constexpr Action kLastAction = Action::help;

struct ActionRow {
    Action action;
    const char* menu;  // the menu's name
    const char* name;  // the item's name
    int key;           // ImGuiKeyChord; 0: none
    const char* keys;  // the keys as people read them
    const char* help;
};

// All actions, in the order of the menus.
std::span<const ActionRow> actionTable();
const ActionRow& rowOf(Action action);
// The rows of each menu.
std::vector<std::span<const ActionRow>> actionMenus();

// The actions whose keys were pressed since the last picture; none while text is being typed or a
// menu is open.
std::vector<Action> pressedActions();

// A window of Dear ImGui with the keys and the mouse's buttons, over everything else while `open`;
// Escape closes it.
void helpPanel(bool& open);

// How an action is shown.
struct ActionState {
    bool checked = false;
    bool enabled = true;
};

// Shows the window's menu, made from the table of actions, and returns the actions that were
// chosen. `state` is asked about the actions that are seen.
std::vector<Action> menuBar(const std::function<ActionState(Action)>& state);

// The setting that an action switches on and off; null where it switches none.
bool* switchOf(Action action, hair::Settings& settings);

// What an action has strands show; none where it changes nothing of that.
std::optional<hair::Show> showOf(Action action);

// The tool that an action takes up; none where it takes up none.
std::optional<Tool> toolOf(Action action);

// The preset that an action looks from, which has its name; null where there is none.
const CameraPreset* presetOf(Action action);

}  // namespace benchmarks::viewer
