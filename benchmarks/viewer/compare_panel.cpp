#include "benchmarks/viewer/settings_panel.h"

#include <algorithm>
#include <array>

#include <imgui.h>
#include <nlohmann/json.hpp>

#include "benchmarks/report/text.h"
#include "benchmarks/scene/json.h"
#include "benchmarks/scene/settings_json.h"
#include "benchmarks/viewer/preferences.h"
#include "benchmarks/viewer/picture_area.h"

namespace benchmarks::viewer {
namespace {

// ---- Settings that differ -----------------------------------------------------------------------

bool isListOfGroups(const scene::Json& value) {
    return value.is_array() && !value.empty() && value.front().is_object();
}

// Puts spaces into a vector, so that its line can wrap.
std::string textOf(const scene::Json* value) {
    if (!value) return "";
    if (!value->is_array()) return value->dump();
    std::string text;
    for (const scene::Json& element : *value) text += (text.empty() ? "" : ", ") + element.dump();
    return '[' + text + ']';
}

// Adds the differences of two values. Null: one side lacks the value.
void compare(
    const std::string& pointer, const scene::Json* a, const scene::Json* b,
    std::vector<SettingDifference>& differences) {
    if (a && b && *a == *b) return;
    if (a && b && a->is_object() && b->is_object()) {
        // Both documents are written from the same tables, so they have the same members.
        for (const auto& [key, value] : a->items())
            compare(pointer + '/' + scene::escapedToken(key), &value, &b->at(key), differences);
        return;
    }
    if (a && b && (isListOfGroups(*a) || isListOfGroups(*b))) {
        for (std::size_t i = 0; i < std::max(a->size(), b->size()); ++i) {
            compare(
                pointer + '/' + std::to_string(i), i < a->size() ? &a->at(i) : nullptr,
                i < b->size() ? &b->at(i) : nullptr, differences);
        }
        return;
    }
    differences.push_back({pointer, textOf(a), textOf(b)});
}

// ---- The panel ----------------------------------------------------------------------------------

constexpr std::array kViews{
    Choice<Views>{
        "Side by side", Views::side_by_side,
        "Both pictures at one scale: beside each other, or one above the other if that is larger."},
    Choice<Views>{
        "Slider", Views::slider,
        "One picture over the other: A to the left of a line that you drag, B to the right."},
    Choice<Views>{
        "Difference", Views::difference,
        "The difference of the colours of each pixel, brightened: black where they are the same."},
    Choice<Views>{"Only A", Views::a, "The first picture alone."},
    Choice<Views>{"Only B", Views::b, "The second picture alone."}};

constexpr std::array kGains{
    Choice<std::uint32_t>{"x 1", 1, "The difference, unchanged."},
    Choice<std::uint32_t>{"x 2", 2, "A step of 255 is shown as 2."},
    Choice<std::uint32_t>{"x 4", 4, "A step of 255 is shown as 4."},
    Choice<std::uint32_t>{"x 8", 8, "A step of 255 is shown as 8."},
    Choice<std::uint32_t>{"x 16", 16, "A step of 255 is shown as 16."}};

constexpr std::array kSides{
    Choice<int>{"Edit A", 0, "The settings panel and the keys change A."},
    Choice<int>{"Edit B", 1, "The settings panel and the keys change B."}};

CompareWish startButton() {
    ImGui::TextWrapped("Two settings of one scene, A and B: side by side, with a slider between "
                       "them, or their difference. B begins as A is now.");
    const bool starts = ImGui::Button("Start comparing");
    ImGui::SetItemTooltip("Plays the scene a second time, as B.");
    return starts ? CompareWish::start : CompareWish::nothing;
}

CompareWish sideButtons() {
    CompareWish wish = CompareWish::nothing;
    if (ImGui::Button("Stop comparing")) wish = CompareWish::stop;
    ImGui::SetItemTooltip("Shows A alone. The settings of B are lost unless they were saved.");
    sameLineIfItFits("Swap");
    if (ImGui::Button("Swap")) wish = CompareWish::swap;
    ImGui::SetItemTooltip("A becomes B, and B becomes A.");
    sameLineIfItFits("Copy A to B");
    if (ImGui::Button("Copy A to B")) wish = CompareWish::copy_a_to_b;
    ImGui::SetItemTooltip("B gets all settings of A. Undo on B brings its own back.");
    return wish;
}

// One line per figure, because a narrow panel would break a long line within a number.
void figureLines(const DifferenceFigures& figures) {
    ImGui::BeginGroup();
    if (figures.different == 0) {
        ImGui::TextWrapped("%s", differenceText(figures).c_str());
    } else {
        ImGui::TextWrapped("most: %u of 255", figures.most);
        ImGui::TextWrapped("average: %s of 255", report::shortNumber(figures.mean()).c_str());
        ImGui::TextWrapped(
            "pixels that differ: %s %%", report::shortNumber(100.0 * figures.share()).c_str());
    }
    ImGui::EndGroup();
    ImGui::SetItemTooltip("The difference of the display's colours, in steps of 1/255. The average "
                          "is\nover red, green and blue of all pixels.");
}

void differencePart(PictureArea& area) {
    ImGui::SeparatorText("Gain of the difference");
    choiceButtons<std::uint32_t>(kGains, area.gain);
    if (area.difference()) figureLines(*area.difference());
}

void cell(const std::string& text) {
    ImGui::TableNextColumn();
    ImGui::TextWrapped("%s", text.empty() ? "-" : text.c_str());
}

void settingsPart(const std::vector<SettingDifference>& differences) {
    ImGui::SeparatorText("Settings that differ");
    if (differences.empty()) {
        ImGui::TextWrapped("None: A and B have the same settings.");
        return;
    }
    // At least a few lines. A panel that is too low for them scrolls.
    const float height =
        std::max(ImGui::GetContentRegionAvail().y, 6.0f * ImGui::GetTextLineHeightWithSpacing());
    constexpr ImGuiTableFlags kFlags = ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg |
                                       ImGuiTableFlags_BordersInnerV | ImGuiTableFlags_Resizable;
    if (!ImGui::BeginTable("settings that differ", 3, kFlags, {0.0f, height})) return;
    ImGui::TableSetupColumn("Setting", ImGuiTableColumnFlags_WidthStretch, 2.0f);
    ImGui::TableSetupColumn("A", ImGuiTableColumnFlags_WidthStretch, 1.0f);
    ImGui::TableSetupColumn("B", ImGuiTableColumnFlags_WidthStretch, 1.0f);
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableHeadersRow();
    for (const SettingDifference& difference : differences) {
        ImGui::TableNextRow();
        cell(difference.pointer);
        cell(difference.a);
        cell(difference.b);
    }
    ImGui::EndTable();
}

}  // namespace

// ---- Settings that differ -----------------------------------------------------------------------

std::vector<SettingDifference>
settingsDifferences(const hair::Settings& a, const hair::Settings& b) {
    const scene::Json a_document = scene::writeSettings(a), b_document = scene::writeSettings(b);
    std::vector<SettingDifference> differences;
    compare("", &a_document, &b_document, differences);
    return differences;
}

// ---- The panel ----------------------------------------------------------------------------------

CompareWish
ComparePanel::show(PictureArea& area, const hair::Settings& a, const hair::Settings* b) {
    if (!b) return startButton();
    const CompareWish wish = sideButtons();
    choiceButtons<int>(kSides, edited);
    ImGui::Checkbox("Same camera", &same_camera);
    ImGui::SetItemTooltip("Moving the camera of one side moves the other's.");
    ImGui::SeparatorText("Show");
    choiceButtons<Views>(kViews, area.views);
    if (area.views == Views::difference) differencePart(area);
    settingsPart(settingsDifferences(a, *b));
    return wish;
}

}  // namespace benchmarks::viewer
