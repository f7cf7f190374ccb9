#include "benchmarks/viewer/preferences.h"

#include <cmath>

#include <gtest/gtest.h>
#include <imgui.h>

namespace benchmarks::viewer {
namespace {

// Relative luminance and contrast ratio: Web Content Accessibility Guidelines 2.1, 1.4.3.
double linear(double channel) {
    return channel <= 0.04045 ? channel / 12.92 : std::pow((channel + 0.055) / 1.055, 2.4);
}
double luminance(const ImVec4& color) {
    return 0.2126 * linear(double{color.x}) + 0.7152 * linear(double{color.y}) +
           0.0722 * linear(double{color.z});
}
double contrast(const ImVec4& a, const ImVec4& b) {
    const double x = luminance(a), y = luminance(b);
    return (std::max(x, y) + 0.05) / (std::min(x, y) + 0.05);
}

constexpr ImGuiCol kGrounds[] = {
    ImGuiCol_WindowBg,       ImGuiCol_PopupBg,       ImGuiCol_MenuBarBg,     ImGuiCol_FrameBg,
    ImGuiCol_FrameBgHovered, ImGuiCol_FrameBgActive, ImGuiCol_Button,        ImGuiCol_ButtonHovered,
    ImGuiCol_ButtonActive,   ImGuiCol_Header,        ImGuiCol_HeaderHovered, ImGuiCol_HeaderActive,
    ImGuiCol_TabActive,      ImGuiCol_TitleBgActive, ImGuiCol_ScrollbarBg};

// 4.5 is level AA for text of any size, 7 is level AAA; 3 is for signs other than text (1.4.11).
TEST(Theme, HasReadableText) {
    for (const Theme theme : {Theme::dark, Theme::light}) {
        SCOPED_TRACE(themeName(theme));
        const ImGuiStyle style = styleOf(theme, 1.0f);
        const auto& colors = style.Colors;
        EXPECT_GE(contrast(colors[ImGuiCol_Text], colors[ImGuiCol_WindowBg]), 7.0);
        for (const ImGuiCol ground : kGrounds)
            EXPECT_GE(contrast(colors[ImGuiCol_Text], colors[ground]), 4.5)
                << ImGui::GetStyleColorName(ground);
        for (const ImGuiCol ground : {ImGuiCol_WindowBg, ImGuiCol_PopupBg, ImGuiCol_MenuBarBg}) {
            EXPECT_GE(contrast(colors[ImGuiCol_TextDisabled], colors[ground]), 4.5);
            EXPECT_GE(contrast(colors[ImGuiCol_PlotHistogram], colors[ground]), 4.5);
        }
        EXPECT_GE(contrast(colors[ImGuiCol_CheckMark], colors[ImGuiCol_FrameBg]), 3.0);
        EXPECT_GE(contrast(colors[ImGuiCol_ScrollbarGrab], colors[ImGuiCol_ScrollbarBg]), 3.0);
        EXPECT_GE(contrast(colors[ImGuiCol_PlotLines], colors[ImGuiCol_WindowBg]), 3.0);
    }
}

TEST(Theme, ScalesSizesAndNotColors) {
    const ImGuiStyle one = styleOf(Theme::dark, 1.0f), two = styleOf(Theme::dark, 2.0f);
    EXPECT_EQ(two.FramePadding.x, 2.0f * one.FramePadding.x);
    EXPECT_EQ(two.ScrollbarSize, 2.0f * one.ScrollbarSize);
    for (int i = 0; i < ImGuiCol_COUNT; ++i) EXPECT_EQ(one.Colors[i].x, two.Colors[i].x);
}

TEST(Theme, IsDarkOrLight) {
    const auto ground = [](Theme theme) {
        return luminance(styleOf(theme, 1.0f).Colors[ImGuiCol_WindowBg]);
    };
    EXPECT_LT(ground(Theme::dark), 0.05);
    EXPECT_GT(ground(Theme::light), 0.8);
}

}  // namespace
}  // namespace benchmarks::viewer
