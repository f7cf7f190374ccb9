#pragma once

#include <span>
#include <vector>

namespace benchmarks {

// What the menus and keys do.
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
    play,  // and pause
    step,
    restart,
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
    tool_camera,
    tool_wind,
    tool_grab,
    tool_head,
    tool_colliders,
    compare,  // on and off
    edit_other,  // of two sides
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
    const char* menu;  // that it is in
    const char* name;  // there
    int key;           // ImGuiKeyChord; 0: none
    const char* keys;  // as people read it
    const char* help;
};

// In the order of the menus.
std::span<const ActionRow> actionTable();
const ActionRow& rowOf(Action action);
// The same, menu by menu.
std::vector<std::span<const ActionRow>> actionMenus();

// Those whose keys were pressed since the last picture; none while text is being typed or a menu is
// open.
std::vector<Action> pressedActions();

}  // namespace benchmarks
