#include "benchmarks/viewer/actions.h"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <string_view>

#include <imgui.h>

namespace benchmarks::viewer {
namespace {

// ---- The table and its keys ---------------------------------------------------------------------

constexpr int kCtrl = ImGuiMod_Ctrl;
constexpr int kShift = ImGuiMod_Shift;
constexpr int kAlt = ImGuiMod_Alt;

// W, A, S, D, Q, E and the arrows are taken: they fly the camera.
constexpr std::array kActions{
    ActionRow{
        Action::open_scene, "File", "Open...", kCtrl | ImGuiKey_O, "Ctrl+O",
        "asks for a file: a scene or screenshot to open, or hair, a mesh or an environment for "
        "this scene"},
    ActionRow{
        Action::save_scene, "File", "Save scene", kCtrl | ImGuiKey_S, "Ctrl+S",
        "writes exactly the state shown as a scene that the runner plays to the same picture"},
    ActionRow{
        Action::save_scene_as, "File", "Save scene as...", kCtrl | kShift | ImGuiKey_S,
        "Ctrl+Shift+S", "writes the state shown as a scene, to a path that is asked for"},
    ActionRow{
        Action::copy_axes, "File", "Copy as -a...", kCtrl | kShift | ImGuiKey_C, "Ctrl+Shift+C",
        "copies the changes to the scene to the clipboard, as options of the command line"},
    ActionRow{
        Action::screenshot, "File", "Screenshot", ImGuiKey_F12, "F12",
        "writes the picture as a PNG with the scene in it, which can be opened again"},
    ActionRow{
        Action::record, "File", "Record", kCtrl | ImGuiKey_R, "Ctrl+R",
        "writes every frame that is played to an animated PNG, until this is chosen again"},
    ActionRow{Action::quit, "File", "Quit", kCtrl | ImGuiKey_Q, "Ctrl+Q", "closes the window"},

    ActionRow{
        Action::undo, "Edit", "Undo", kCtrl | ImGuiKey_Z, "Ctrl+Z",
        "undoes the last change of a setting"},
    ActionRow{
        Action::redo, "Edit", "Redo", kCtrl | ImGuiKey_Y, "Ctrl+Y",
        "repeats the change that was undone last"},

    ActionRow{Action::play, "Play", "Play", ImGuiKey_Space, "Space", "plays or pauses"},
    ActionRow{Action::step, "Play", "Step", ImGuiKey_Period, ".", "plays one frame, while paused"},
    ActionRow{Action::restart, "Play", "Restart", ImGuiKey_Home, "Home", "back to frame 0"},

    ActionRow{
        Action::frame_groom, "Camera", "Frame the groom", ImGuiKey_F, "F",
        "looks at the whole groom from where the camera is"},
    ActionRow{
        Action::view_front, "Camera", "Front", kAlt | ImGuiKey_1, "Alt+1", "looks from the front"},
    ActionRow{
        Action::view_side, "Camera", "Side", kAlt | ImGuiKey_2, "Alt+2", "looks from the side"},
    ActionRow{Action::view_back, "Camera", "Back", kAlt | ImGuiKey_3, "Alt+3", "looks from behind"},
    ActionRow{Action::view_top, "Camera", "Top", kAlt | ImGuiKey_4, "Alt+4", "looks from above"},
    ActionRow{
        Action::view_close, "Camera", "Close-up", kAlt | ImGuiKey_5, "Alt+5",
        "looks from close enough to see single strands"},
    ActionRow{
        Action::view_far, "Camera", "Far", kAlt | ImGuiKey_6, "Alt+6",
        "looks from afar, as at someone across a street"},

    ActionRow{Action::overlay_guides, "Show", "Guides", ImGuiKey_1, "1", "the simulated guides"},
    ActionRow{
        Action::overlay_root_triangles, "Show", "Root triangles", ImGuiKey_2, "2",
        "the triangles between roots that strands are interpolated in"},
    ActionRow{
        Action::overlay_bodies, "Show", "Bodies", ImGuiKey_3, "3",
        "the bodies that hair collides with"},
    ActionRow{Action::show_head, "Show", "Head", ImGuiKey_4, "4", "the mesh that hair grows on"},
    ActionRow{Action::show_hair, "Show", "Hair", ImGuiKey_5, "5", "the strands"},

    ActionRow{
        Action::tool_camera, "Tools", "Camera", ImGuiKey_C, "C",
        "the mouse orbits, pans and zooms; a double click looks at what is under it"},
    ActionRow{
        Action::tool_wind, "Tools", "Wind", ImGuiKey_N, "N",
        "the mouse turns and stretches the wind's arrow"},
    ActionRow{Action::tool_grab, "Tools", "Grab", ImGuiKey_G, "G", "the mouse pulls at hair"},
    ActionRow{
        Action::tool_brush, "Tools", "Brush", ImGuiKey_B, "B",
        "the mouse grooms; [ and ] change the brush's radius"},
    ActionRow{Action::tool_head, "Tools", "Head", ImGuiKey_H, "H", "the mouse moves the head"},
    ActionRow{
        Action::tool_colliders, "Tools", "Colliders", ImGuiKey_K, "K",
        "the mouse moves the capsules that hair collides with"},
    ActionRow{
        Action::tool_lights, "Tools", "Lights", ImGuiKey_L, "L",
        "the mouse moves lights round the hair and turns the environment"},

    ActionRow{Action::dark_theme, "View", "Dark", 0, "", "light text on dark"},
    ActionRow{Action::light_theme, "View", "Light", 0, "", "dark text on light"},
    ActionRow{
        Action::larger, "View", "Larger", kCtrl | ImGuiKey_Equal,
        "Ctrl+=", "larger text and widgets"},
    ActionRow{
        Action::smaller, "View", "Smaller", kCtrl | ImGuiKey_Minus, "Ctrl+-",
        "smaller text and widgets"},
    ActionRow{Action::reset_layout, "View", "Reset layout", 0, "", "resets columns and text size"},
    ActionRow{
        Action::preview, "View", "Preview what moves", ImGuiKey_P, "P",
        "draws fewer strands and pixels while something moves, if the whole picture takes too "
        "long"},
    ActionRow{
        Action::present_fifo, "View", "In step with the screen (fifo)", 0, "",
        "never torn, and never more pictures than the screen shows"},
    ActionRow{
        Action::present_mailbox, "View", "Newest picture (mailbox)", 0, "",
        "never torn; older pictures are left out"},
    ActionRow{
        Action::present_immediate, "View", "At once (immediate)", 0, "",
        "as fast as possible, and possibly torn"},
    ActionRow{Action::show_shading, "View", "Strands: light", 0, "", "strands as they are lit"},
    ActionRow{
        Action::show_tangents, "View", "Strands: tangents", 0, "",
        "directions along strands as colours"},
    ActionRow{
        Action::show_normals, "View", "Strands: normals", 0, "",
        "directions across strands as colours"},
    ActionRow{
        Action::show_levels, "View", "Strands: levels of detail", 0, "",
        "from blue (fine) to red (coarse)"},
    ActionRow{
        Action::show_strands, "View", "Strands: each its own", 0, "",
        "each strand in a colour of its own"},
    ActionRow{
        Action::show_groups, "View", "Strands: groups", 0, "",
        "each of the file's groups in a colour of its own"},
    ActionRow{
        Action::show_shadow, "View", "Strands: shadow", 0, "",
        "the share of the lights that reaches strands"},
    ActionRow{
        Action::show_overdraw, "View", "Strands: overdraw", 0, "",
        "fragments that a pixel draws: red is full at 8, green at 32, blue at 128"},
    ActionRow{
        Action::show_density, "View", "Strands: density", 0, "",
        "fragments of strands in front of the head: red is full at 8, green at 32, blue at 128"},

    ActionRow{
        Action::compare, "Window", "Compare two settings", kCtrl | ImGuiKey_B, "Ctrl+B",
        "shows the scene twice, as A and B, whose settings can differ"},
    ActionRow{
        Action::edit_other, "Window", "Edit the other side", ImGuiKey_Tab, "Tab",
        "switches the settings panel to the other side"},
    ActionRow{
        Action::panel_scene, "Window", "Scene", kCtrl | ImGuiKey_1, "Ctrl+1", "every setting"},
    ActionRow{
        Action::panel_files, "Window", "Files", kCtrl | ImGuiKey_2, "Ctrl+2", "scenes to open"},
    ActionRow{
        Action::panel_timings, "Window", "Timings", kCtrl | ImGuiKey_3, "Ctrl+3",
        "where the time goes"},
    ActionRow{
        Action::panel_compare, "Window", "Compare", kCtrl | ImGuiKey_4, "Ctrl+4",
        "how two sides are shown"},
    ActionRow{
        Action::panel_shaders, "Window", "Shaders", kCtrl | ImGuiKey_5, "Ctrl+5",
        "reloaded shaders and messages of the compiler"},
    ActionRow{
        Action::left_column, "Window", "Left column", ImGuiKey_F9, "F9",
        "shows or hides the left column"},
    ActionRow{
        Action::right_column, "Window", "Right column", ImGuiKey_F10, "F10",
        "shows or hides the right column"},

    ActionRow{
        Action::help, "Help", "Keys and mouse", ImGuiKey_F1, "? or F1",
        "shows the keys and what the mouse does"},
};

bool repeats(Action action) {
    return action == Action::step || action == Action::undo || action == Action::redo ||
           action == Action::larger || action == Action::smaller;
}

bool isPressed(const ActionRow& row) {
    if (row.key == 0 || ImGui::GetIO().KeyMods != (row.key & ImGuiMod_Mask_)) return false;
    const auto key = static_cast<ImGuiKey>(row.key & ~ImGuiMod_Mask_);
    return ImGui::IsKeyPressed(key, repeats(row.action));
}

// ---- Help ---------------------------------------------------------------------------------------

struct Gesture {
    const char* what;
    const char* does;
};
// Gestures that are not actions.
constexpr std::array kMouse{
    Gesture{"Left drag", "camera: orbits; other tools: moves their handles"},
    Gesture{"Right or middle drag", "pans"},
    Gesture{"M + drag", "moves magnified pictures (1:1, 2x, 4x, 8x)"},
    Gesture{"Wheel, Page Up, Page Down", "zooms"},
    Gesture{"Double click", "looks at what is under the mouse"},
    Gesture{"W A S D Q E, arrows", "fly, while the mouse is over the picture"},
};
constexpr std::array kWidgets{
    Gesture{"Drag a number", "changes it; Alt: slowly, Shift: fast"},
    Gesture{"Double click, Ctrl+click", "types it"},
    Gesture{"Drop a file", "scene, screenshot, groom, mesh or environment"},
};

void line(const char* what, const char* does) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(what);
    ImGui::TableNextColumn();
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(does);
    ImGui::PopTextWrapPos();
}

bool beginPart(const char* title) {
    ImGui::SeparatorText(title);
    if (!ImGui::BeginTable(title, 2, ImGuiTableFlags_RowBg)) return false;
    const float letter = ImGui::GetFontSize();
    ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthFixed, 13.0f * letter);
    ImGui::TableSetupColumn("what it does", ImGuiTableColumnFlags_WidthStretch);
    return true;
}

void gestures(const char* title, std::span<const Gesture> rows) {
    if (!beginPart(title)) return;
    for (const Gesture& row : rows) line(row.what, row.does);
    ImGui::EndTable();
}

void keysOf(std::span<const ActionRow> rows) {
    if (std::ranges::none_of(rows, [](const ActionRow& row) { return row.keys[0] != 0; })) return;
    if (!beginPart(rows.front().menu)) return;
    for (const ActionRow& row : rows)
        if (row.keys[0] != 0) line(row.keys, (std::string(row.name) + ": " + row.help).c_str());
    ImGui::EndTable();
}

// ---- Menu bar -----------------------------------------------------------------------------------

// Whether the menu has a separator before this action.
bool startsGroup(Action action) {
    switch (action) {
    case Action::copy_axes:
    case Action::screenshot:
    case Action::quit:
    case Action::view_front:
    case Action::show_head:
    case Action::show_shading:
    case Action::panel_scene:
    case Action::left_column:
    case Action::dark_theme:
    case Action::larger:
    case Action::present_fifo:
        return true;
    default:
        return false;
    }
}

bool item(const ActionRow& row, const ActionState& state) {
    const bool chosen = ImGui::MenuItem(row.name, row.keys, state.checked, state.enabled);
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_DelayNormal | ImGuiHoveredFlags_AllowWhenDisabled))
        ImGui::SetTooltip("%s", row.help);
    return chosen;
}

}  // namespace

// ---- The table and its keys ---------------------------------------------------------------------

std::span<const ActionRow> actionTable() { return kActions; }

const ActionRow& rowOf(Action action) {
    return *std::ranges::find(kActions, action, &ActionRow::action);
}

std::vector<std::span<const ActionRow>> actionMenus() {
    std::vector<std::span<const ActionRow>> menus;
    auto first = kActions.begin();
    while (first != kActions.end()) {
        const auto last = std::find_if(first, kActions.end(), [&](const ActionRow& row) {
            return std::string_view(row.menu) != first->menu;
        });
        menus.emplace_back(first, last);
        first = last;
    }
    return menus;
}

std::vector<Action> pressedActions() {
    std::vector<Action> actions;
    if (ImGui::GetIO().WantTextInput || ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup))
        return actions;
    for (const ActionRow& row : kActions)
        if (isPressed(row)) actions.push_back(row.action);
    // Keyboard layouts place the question mark differently, so its character is checked, not a key.
    if (ImGui::GetIO().InputQueueCharacters.contains('?')) actions.push_back(Action::help);
    return actions;
}

// ---- Help ---------------------------------------------------------------------------------------

void helpPanel(bool& open) {
    if (!open) return;
    const ImVec2 room = ImGui::GetMainViewport()->Size;
    const float letter = ImGui::GetFontSize();
    ImGui::SetNextWindowSize(
        {std::min(44.0f * letter, room.x - 2.0f * letter),
         std::min(40.0f * letter, room.y - 4.0f * letter)});
    ImGui::SetNextWindowPos({room.x * 0.5f, room.y * 0.5f}, ImGuiCond_Always, {0.5f, 0.5f});
    constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                        ImGuiWindowFlags_NoCollapse |
                                        ImGuiWindowFlags_NoSavedSettings;
    if (ImGui::Begin("Keys and mouse", &open, kFlags)) {
        gestures("Mouse in the picture", kMouse);
        gestures("Widgets", kWidgets);
        for (const auto& rows : actionMenus()) keysOf(rows);
    }
    ImGui::End();
    if (ImGui::IsKeyPressed(ImGuiKey_Escape)) open = false;
}

// ---- Menu bar -----------------------------------------------------------------------------------

std::vector<Action> menuBar(const std::function<ActionState(Action)>& state) {
    std::vector<Action> chosen;
    if (!ImGui::BeginMainMenuBar()) return chosen;
    for (const auto& rows : actionMenus()) {
        if (!ImGui::BeginMenu(rows.front().menu)) continue;
        for (const ActionRow& row : rows) {
            if (startsGroup(row.action)) ImGui::Separator();
            if (item(row, state(row.action))) chosen.push_back(row.action);
        }
        ImGui::EndMenu();
    }
    ImGui::EndMainMenuBar();
    return chosen;
}

// ---- Effects of actions -------------------------------------------------------------------------

bool* switchOf(Action action, hair::Settings& settings) {
    hair::OverlaySettings& overlays = settings.render.overlays;
    switch (action) {
    case Action::overlay_guides:
        return &overlays.guides;
    case Action::overlay_root_triangles:
        return &overlays.root_triangles;
    case Action::overlay_bodies:
        return &overlays.bodies;
    case Action::show_head:
        return &settings.render.head;
    case Action::show_hair:
        return &settings.render.hair;
    default:
        return nullptr;
    }
}

std::optional<hair::Show> showOf(Action action) {
    switch (action) {
    case Action::show_shading:
        return hair::Show::shading;
    case Action::show_tangents:
        return hair::Show::tangents;
    case Action::show_normals:
        return hair::Show::normals;
    case Action::show_levels:
        return hair::Show::lod;
    case Action::show_strands:
        return hair::Show::strands;
    case Action::show_groups:
        return hair::Show::groups;
    case Action::show_shadow:
        return hair::Show::shadow;
    case Action::show_overdraw:
        return hair::Show::overdraw;
    case Action::show_density:
        return hair::Show::density;
    default:
        return std::nullopt;
    }
}

std::optional<Tool> toolOf(Action action) {
    switch (action) {
    case Action::tool_camera:
        return Tool::camera;
    case Action::tool_wind:
        return Tool::wind;
    case Action::tool_grab:
        return Tool::grab;
    case Action::tool_brush:
        return Tool::brush;
    case Action::tool_lights:
        return Tool::lights;
    case Action::tool_head:
        return Tool::head;
    case Action::tool_colliders:
        return Tool::colliders;
    default:
        return std::nullopt;
    }
}

const CameraPreset* presetOf(Action action) {
    const ActionRow& row = rowOf(action);
    if (std::string_view(row.menu) != "Camera") return nullptr;
    const auto presets = cameraPresets();
    const auto found = std::ranges::find_if(presets, [&](const CameraPreset& preset) {
        return std::string_view(preset.name) == row.name;
    });
    return found == presets.end() ? nullptr : &*found;
}

}  // namespace benchmarks::viewer
