#include "benchmarks/viewer/columns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <imgui.h>

namespace benchmarks::viewer {
namespace {

// ---- Panes and splitters ------------------------------------------------------------------------

constexpr ImGuiWindowFlags kFixed =
    ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
    ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoScrollWithMouse;

ImGuiCol backgroundOf(Surface surface) {
    switch (surface) {
    case Surface::stage:
        return ImGuiCol_ScrollbarBg;
    case Surface::bar:
        return ImGuiCol_MenuBarBg;
    default:
        return ImGuiCol_WindowBg;
    }
}

// Centres a bar's single line of widgets vertically.
ImVec2 paddingOf(Surface surface, const Box& box) {
    const ImVec2 usual = ImGui::GetStyle().WindowPadding;
    if (surface == Surface::splitter) return {0.0f, 0.0f};
    if (surface != Surface::bar) return usual;
    return {usual.x, std::max(std::floor((box.height - ImGui::GetFrameHeight()) / 2.0f), 0.0f)};
}

// Returns how far the splitter was dragged to the right, in letter heights.
float splitter(const char* name, const Box& box) {
    float dragged = 0.0f;
    pane(name, box, Surface::splitter, [&] {
        ImGui::InvisibleButton("##bar", {box.width, box.height});
        const bool held = ImGui::IsItemActive();
        const float middle = std::floor(box.x + box.width / 2.0f);
        ImGui::GetWindowDrawList()->AddLine(
            {middle, box.y}, {middle, box.bottom()}, ImGui::GetColorU32(ImGuiCol_Separator));
        if (held || ImGui::IsItemHovered()) {
            ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
            ImGui::GetWindowDrawList()->AddRectFilled(
                {box.x, box.y}, {box.right(), box.bottom()},
                ImGui::GetColorU32(ImGuiCol_SeparatorActive, held ? 1.0f : 0.5f));
        }
        if (held) dragged = ImGui::GetIO().MouseDelta.x / ImGui::GetFontSize();
    });
    return dragged;
}

// Drags start from the column's actual width, not from a wanted one that did not fit.
void drag(Column& column, const Box& box, float ems) {
    if (ems == 0.0f) return;
    column.width = std::max(box.width / ImGui::GetFontSize() + ems, kNarrowestColumn);
}

constexpr std::array kTabs{Tab::scene, Tab::files, Tab::timings, Tab::compare, Tab::shaders};
constexpr std::size_t kLeft = 2;  // tabs of the left column, which come first

// ---- Status line --------------------------------------------------------------------------------

float widthOf(const std::string& text) { return ImGui::CalcTextSize(text.c_str()).x; }

// Shortens a text to fit, px, without splitting a UTF-8 character.
std::string cut(const std::string& text, float room) {
    if (widthOf(text) <= room) return text;
    std::size_t length = text.size();
    const auto fits = [&] { return widthOf(text.substr(0, length) + "...") <= room; };
    while (length > 0 && !fits()) {
        --length;
        while (length > 0 && (static_cast<unsigned char>(text[length]) & 0xc0u) == 0x80u) --length;
    }
    return text.substr(0, length) + "...";
}

void cutText(const std::string& text, float room, ImGuiCol color) {
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(color));
    ImGui::TextUnformatted(cut(text, room).c_str());
    ImGui::PopStyleColor();
    if (widthOf(text) > room && ImGui::IsItemHovered()) ImGui::SetTooltip("%s", text.c_str());
}

}  // namespace

// ---- Panes and splitters ------------------------------------------------------------------------

void pane(const char* name, const Box& box, Surface surface, const std::function<void()>& body) {
    if (box.empty()) return;
    ImGui::SetNextWindowPos({box.x, box.y});
    ImGui::SetNextWindowSize({box.width, box.height});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0f);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0.0f);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2{1.0f, 1.0f});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, paddingOf(surface, box));
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetStyleColorVec4(backgroundOf(surface)));
    const bool visible = ImGui::Begin(name, nullptr, kFixed);
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(4);
    if (visible) body();
    ImGui::End();
}

void splitters(const Layout& layout, Preferences& preferences) {
    const float left = splitter("Left splitter", layout.left_splitter);
    drag(preferences.left, layout.left, left);
    const float right = splitter("Right splitter", layout.right_splitter);
    drag(preferences.right, layout.right, -right);
}

// ---- Tabs ---------------------------------------------------------------------------------------

const char* tabName(Tab tab) {
    switch (tab) {
    case Tab::scene:
        return "Scene";
    case Tab::files:
        return "Files";
    case Tab::timings:
        return "Timings";
    case Tab::compare:
        return "Compare";
    case Tab::shaders:
        return "Shaders";
    }
    return "";
}

std::span<const Tab> allTabs() { return kTabs; }
std::span<const Tab> leftTabs() { return allTabs().first(kLeft); }
std::span<const Tab> rightTabs() { return allTabs().subspan(kLeft); }

void Tabs::choose(Tab tab) {
    only = tab;
    (std::ranges::count(leftTabs(), tab) > 0 ? left : right) = tab;
}

bool tabStrip(std::span<const Tab> tabs, Tab& chosen) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const float end = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
    bool changed = false;
    for (std::size_t i = 0; i < tabs.size(); ++i) {
        const char* const name = tabName(tabs[i]);
        const float width = ImGui::CalcTextSize(name).x + 2.0f * style.FramePadding.x;
        const float gap = style.ItemInnerSpacing.x;
        if (i > 0 && ImGui::GetItemRectMax().x + gap + width <= end) ImGui::SameLine(0.0f, gap);
        const bool is_chosen = tabs[i] == chosen;
        ImGui::PushStyleColor(
            ImGuiCol_Button,
            ImGui::GetStyleColorVec4(is_chosen ? ImGuiCol_TabActive : ImGuiCol_Tab));
        if (ImGui::Button(name) && !is_chosen) {
            chosen = tabs[i];
            changed = true;
        }
        ImGui::PopStyleColor();
    }
    return changed;
}

// ---- Buttons to choose from ---------------------------------------------------------------------

void sameLineIfItFits(const char* label) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const float width = ImGui::CalcTextSize(label, nullptr, true).x + 2.0f * style.FramePadding.x;
    ImGui::SameLine();
    if (ImGui::GetContentRegionAvail().x < width) ImGui::NewLine();
}

bool choiceButton(const char* label, const char* help, Chosen chosen) {
    const bool pressed_in = chosen == Chosen::yes;
    if (pressed_in)
        ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
    const bool pressed = ImGui::Button(label);
    if (pressed_in) ImGui::PopStyleColor();
    ImGui::SetItemTooltip("%s", help);
    return pressed;
}

// ---- Status line --------------------------------------------------------------------------------

void statusLine(const StatusText& status) {
    ImGui::AlignTextToFramePadding();
    const float gap = 1.5f * ImGui::GetFontSize();
    const float room = ImGui::GetContentRegionAvail().x;
    const float picture = widthOf(status.picture);
    // The device's name is shortened first.
    float device = std::min(widthOf(status.device), 0.3f * room);
    float left = std::max(room - picture - device - 2.0f * gap, 0.0f);
    if (widthOf(status.text) > left) {
        left = std::max(room - picture - gap, 0.0f);
        device = 0.0f;
    }
    const float start = ImGui::GetCursorPosX();
    const ImGuiCol color = status.tone == StatusText::Tone::hint      ? ImGuiCol_TextDisabled
                           : status.tone == StatusText::Tone::problem ? ImGuiCol_PlotHistogram
                                                                      : ImGuiCol_Text;
    cutText(status.text, left, color);
    if (device > 0.0f) {
        ImGui::SameLine(start + left + gap);
        cutText(status.device, device, ImGuiCol_TextDisabled);
    }
    ImGui::SameLine(start + room - picture);
    cutText(status.picture, picture, ImGuiCol_TextDisabled);
}

}  // namespace benchmarks::viewer
