#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "benchmarks/viewer/toolbar.h"
#include "benchmarks/viewer/view_tools.h"
#include "hair/settings.h"

// A table of the actions in the viewer. It defines the menu bar, the keys and the help.
namespace benchmarks::viewer {

enum class Action {
    open_scene,
    save_scene,
    save_scene_as,
    copy_axes,
    screenshot,
    record,  // toggles recording
    quit,
    undo,
    redo,
    play,  // plays or pauses
    step,
    restart,
    preview,  // toggles previews of motion
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
    show_groups,
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
    compare,  // toggles comparing
    edit_other,  // edits the other side
    present_fifo,
    present_mailbox,
    present_immediate,
    dark_theme,
    light_theme,
    larger,
    smaller,
    left_column,  // toggles the column
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
    const char* keys;  // text for the keys
    const char* help;
};

// All actions, in the order of the menus.
std::span<const ActionRow> actionTable();
const ActionRow& rowOf(Action action);
// The rows of each menu.
std::vector<std::span<const ActionRow>> actionMenus();

// Returns the actions of keys pressed since the last picture; none while text is being typed or a
// menu is open.
std::vector<Action> pressedActions();

// Shows a Dear ImGui window with the keys and mouse gestures above everything else while `open` is
// set; Escape closes it.
void helpPanel(bool& open);

// How an action appears in the menu.
struct ActionState {
    bool checked = false;
    bool enabled = true;
};

// Shows the window's menu bar from the table of actions, and returns the chosen actions. `state` is
// called for the visible actions.
std::vector<Action> menuBar(const std::function<ActionState(Action)>& state);

// Returns the setting that an action toggles, or null.
bool* switchOf(Action action, hair::Settings& settings);

// Returns the mode that an action shows strands in, if any.
std::optional<hair::Show> showOf(Action action);

// Returns the tool that an action selects, if any.
std::optional<Tool> toolOf(Action action);

// Returns the camera preset of an action, which has the same name, or null.
const CameraPreset* presetOf(Action action);

}  // namespace benchmarks::viewer
