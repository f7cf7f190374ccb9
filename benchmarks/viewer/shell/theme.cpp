#include "benchmarks/viewer/shell/theme.h"

#include <initializer_list>

#include <imgui.h>

namespace benchmarks {

namespace {

// sRGB, 0xRRGGBB.
struct Palette {
    unsigned text, faint;
    unsigned ground;  // behind panels
    unsigned trough;  // behind pictures and scroll bars
    unsigned raised;  // menus and what lies over panels
    unsigned field, field_hovered, field_active;
    unsigned button, button_hovered, button_active;
    unsigned grab;    // of scroll bars
    unsigned chosen;  // tabs, selected lines
    unsigned line;
    unsigned accent;   // handles, marks and plots
    unsigned changed;  // what differs from the scene
};

constexpr Palette kDark{
    .text = 0xe6e7ea,
    .faint = 0x9a9ea8,
    .ground = 0x1d1f23,
    .trough = 0x131417,
    .raised = 0x24272c,
    .field = 0x2b2f36,
    .field_hovered = 0x353a43,
    .field_active = 0x3f4550,
    .button = 0x363b45,
    .button_hovered = 0x434a57,
    .button_active = 0x505868,
    .grab = 0x5f6672,
    .chosen = 0x2f4d6e,
    .line = 0x3a3e46,
    .accent = 0x5fa8f0,
    .changed = 0xf0b45a};

constexpr Palette kLight{
    .text = 0x1c1e22,
    .faint = 0x5b606a,
    .ground = 0xf3f3f2,
    .trough = 0xe5e6e7,
    .raised = 0xffffff,
    .field = 0xe3e4e6,
    .field_hovered = 0xd7d9dd,
    .field_active = 0xcbced4,
    .button = 0xced3da,
    .button_hovered = 0xbfc6d0,
    .button_active = 0xaab5c4,
    .grab = 0x767c86,
    .chosen = 0xbcd6f2,
    .line = 0xc3c6cc,
    .accent = 0x1f6fc0,
    .changed = 0x8a4b00};

ImVec4 color(unsigned rgb, float alpha = 1.0f) {
    const auto channel = [&](unsigned shift) {
        return static_cast<float>((rgb >> shift) & 0xffu) / 255.0f;
    };
    return {channel(16), channel(8), channel(0), alpha};
}

void setColors(ImGuiStyle& style, const Palette& palette) {
    ImVec4* const colors = style.Colors;
    const auto set = [&](unsigned rgb, std::initializer_list<ImGuiCol> which) {
        for (const ImGuiCol each : which) colors[each] = color(rgb);
    };
    set(palette.text, {ImGuiCol_Text});
    set(palette.faint, {ImGuiCol_TextDisabled});
    set(palette.ground, {ImGuiCol_WindowBg});
    set(palette.trough, {ImGuiCol_ScrollbarBg});
    set(palette.raised, {ImGuiCol_MenuBarBg, ImGuiCol_PopupBg, ImGuiCol_TitleBg,
                         ImGuiCol_TitleBgActive, ImGuiCol_TitleBgCollapsed});
    set(palette.field, {ImGuiCol_FrameBg});
    set(palette.field_hovered, {ImGuiCol_FrameBgHovered, ImGuiCol_HeaderHovered});
    set(palette.field_active, {ImGuiCol_FrameBgActive});
    set(palette.button, {ImGuiCol_Button, ImGuiCol_TableHeaderBg});
    set(palette.button_hovered, {ImGuiCol_ButtonHovered});
    set(palette.button_active, {ImGuiCol_ButtonActive});
    set(palette.grab, {ImGuiCol_ScrollbarGrab});
    set(palette.chosen,
        {ImGuiCol_Header, ImGuiCol_HeaderActive, ImGuiCol_TabActive, ImGuiCol_TabHovered});
    set(palette.button, {ImGuiCol_Tab, ImGuiCol_TabUnfocused, ImGuiCol_TabUnfocusedActive});
    set(palette.line, {ImGuiCol_Border, ImGuiCol_Separator, ImGuiCol_TableBorderLight,
                       ImGuiCol_TableBorderStrong, ImGuiCol_ResizeGrip});
    set(palette.accent, {ImGuiCol_ScrollbarGrabHovered, ImGuiCol_ScrollbarGrabActive,
                         ImGuiCol_CheckMark, ImGuiCol_SliderGrab, ImGuiCol_SliderGrabActive,
                         ImGuiCol_SeparatorHovered, ImGuiCol_SeparatorActive, ImGuiCol_PlotLines,
                         ImGuiCol_PlotLinesHovered, ImGuiCol_NavHighlight, ImGuiCol_DragDropTarget,
                         ImGuiCol_ResizeGripHovered, ImGuiCol_ResizeGripActive});
    set(palette.changed, {ImGuiCol_PlotHistogram, ImGuiCol_PlotHistogramHovered});
    colors[ImGuiCol_ChildBg] = color(palette.ground, 0.0f);
    colors[ImGuiCol_TableRowBg] = color(palette.ground, 0.0f);
    colors[ImGuiCol_TableRowBgAlt] = color(palette.text, 0.04f);
    colors[ImGuiCol_TextSelectedBg] = color(palette.accent, 0.35f);
    colors[ImGuiCol_ModalWindowDimBg] = color(0x000000, 0.45f);
}

}  // namespace

const char* themeName(Theme theme) { return theme == Theme::dark ? "dark" : "light"; }

ImGuiStyle styleOf(Theme theme, float scale) {
    ImGuiStyle style;
    style.WindowPadding = {8, 8};
    style.FramePadding = {6, 3};
    style.ItemSpacing = {6, 5};
    style.ItemInnerSpacing = {5, 4};
    style.IndentSpacing = 14;
    style.ScrollbarSize = 12;
    style.GrabMinSize = 10;
    style.FrameRounding = 3;
    style.PopupRounding = 4;
    style.WindowRounding = 4;
    style.ScrollbarRounding = 6;
    style.GrabRounding = 3;
    style.TabRounding = 3;
    style.SeparatorTextBorderSize = 1;
    style.DisabledAlpha = 0.5f;
    style.ScaleAllSizes(scale);
    setColors(style, theme == Theme::dark ? kDark : kLight);
    return style;
}

}  // namespace benchmarks
