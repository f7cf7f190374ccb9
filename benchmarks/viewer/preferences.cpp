#include "benchmarks/viewer/preferences.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <initializer_list>
#include <string_view>

#include <imgui.h>
#include <nlohmann/json.hpp>

#include "benchmarks/scene/json.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/system/files.h"

namespace benchmarks::viewer {
namespace {

// ---- Layout -------------------------------------------------------------------------------------

// Sizes in letter heights.
constexpr float kSplitter = 0.4f;
constexpr float kPlay = 2.3f;
constexpr float kStatus = 1.8f;
constexpr float kLeastPicture = 8.0f;  // beside the last column

// Rounds to whole pixels, because letters at fractions of a pixel are blurred.
float pixels(float ems, float em) { return std::round(ems * em); }

// ---- Theme --------------------------------------------------------------------------------------

// sRGB, 0xRRGGBB.
struct Palette {
    unsigned text, faint;
    unsigned ground;  // behind panels
    unsigned trough;  // behind pictures and scroll bars
    unsigned raised;  // menus and other things above panels
    unsigned field, field_hovered, field_active;
    unsigned button, button_hovered, button_active;
    unsigned grab;  // for scroll bars
    unsigned chosen;  // tabs, selected lines
    unsigned line;
    unsigned accent;  // handles, marks and plots
    unsigned changed;  // settings that differ from the scene
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

// ---- Reading preferences ------------------------------------------------------------------------

constexpr std::array kPresentModes{
    engine::PresentMode::fifo, engine::PresentMode::mailbox, engine::PresentMode::immediate};
constexpr std::array kThemes{Theme::dark, Theme::light};

constexpr float kWidestColumn = 200.0f;

// Reads a member if it is a number in this range.
template <class Number>
void readNumber(
    const scene::Json& object, const char* name, Number minimum, Number maximum, Number& value) {
    const auto found = object.find(name);
    if (found == object.end() || !found->is_number()) return;
    const double number = found->get<double>();
    if (number >= static_cast<double>(minimum) && number <= static_cast<double>(maximum))
        value = static_cast<Number>(number);
}

// Reads a member if it is one of these names.
template <class Values, class Value, class Name>
void readName(
    const scene::Json& object, const char* name, const Values& values, Name nameOf, Value& value) {
    const auto found = object.find(name);
    if (found == object.end() || !found->is_string()) return;
    for (const Value each : values)
        if (found->get<std::string>() == nameOf(each)) value = each;
}

void readColumn(const scene::Json& object, const char* name, Column& column) {
    const auto found = object.find(name);
    if (found == object.end() || !found->is_object()) return;
    readNumber(*found, "width", kNarrowestColumn, kWidestColumn, column.width);
    const auto shown = found->find("shown");
    if (shown != found->end() && shown->is_boolean()) column.shown = shown->get<bool>();
}

scene::Json columnJson(const Column& column) {
    return {{"width", column.width}, {"shown", column.shown}};
}

}  // namespace

// ---- Layout -------------------------------------------------------------------------------------

Layout
arrange(float width, float height, float top, float em, const Column& left, const Column& right) {
    Layout layout;
    const float status = std::min(pixels(kStatus, em), std::max(height - top, 0.0f));
    const float play = std::min(pixels(kPlay, em), std::max(height - top - status, 0.0f));
    layout.status = {0.0f, height - status, width, status};
    layout.play = {0.0f, layout.status.y - play, width, play};

    const float splitter = pixels(kSplitter, em);
    const float narrowest = pixels(kNarrowestColumn, em);
    const float picture = pixels(kNarrowestPicture, em);
    const float least = pixels(kLeastPicture, em);
    layout.merged = width < 2.0f * (narrowest + splitter) + picture;
    const bool fits = width >= narrowest + splitter + least;
    const bool has_left = fits && (left.shown || (layout.merged && right.shown));
    const bool has_right = right.shown && !layout.merged;

    const float others = has_right ? narrowest + 2.0f * splitter + picture : splitter + picture;
    const float left_width =
        has_left
            ? std::clamp(pixels(left.width, em), narrowest, std::max(narrowest, width - others))
            : 0.0f;
    const float left_end = has_left ? left_width + splitter : 0.0f;
    const float right_width = has_right
                                  ? std::clamp(
                                        pixels(right.width, em), narrowest,
                                        std::max(narrowest, width - left_end - splitter - picture))
                                  : 0.0f;
    const float right_start = has_right ? width - right_width : width;
    const float picture_end = has_right ? right_start - splitter : width;

    const float tall = std::max(layout.play.y - top, 0.0f);
    if (has_left) {
        layout.left = {0.0f, top, left_width, tall};
        layout.left_splitter = {left_width, top, splitter, tall};
    }
    layout.picture = {left_end, top, std::max(picture_end - left_end, 0.0f), tall};
    if (has_right) {
        layout.right_splitter = {picture_end, top, splitter, tall};
        layout.right = {right_start, top, right_width, tall};
    }
    return layout;
}

// ---- Theme --------------------------------------------------------------------------------------

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

// ---- Preferences --------------------------------------------------------------------------------

std::optional<std::filesystem::path> usersPreferences() {
    const std::filesystem::path folder =
        engine::system::userFolder(engine::system::UserFiles::settings);
    if (folder.empty()) return std::nullopt;
    return folder / "hairbench" / "viewer.json";
}

std::string preferencesText(const Preferences& preferences) {
    scene::Json recent = scene::Json::array();
    for (const std::filesystem::path& scene : preferences.recent) recent.push_back(scene.string());
    const scene::Json document{
        {"theme", themeName(preferences.theme)},
        {"zoom", preferences.zoom},
        {"left", columnJson(preferences.left)},
        {"right", columnJson(preferences.right)},
        {"window", {{"width", preferences.width}, {"height", preferences.height}}},
        {"present_mode", engine::presentModeName(preferences.present_mode)},
        {"recent", recent}};
    return document.dump(4, ' ', false, scene::Json::error_handler_t::replace) + '\n';
}

Preferences readPreferences(const std::string& text) {
    const scene::Json document = scene::Json::parse(text, nullptr, false);
    if (!document.is_object()) throw engine::Error("they are not a JSON object");
    Preferences preferences;
    readName(document, "theme", kThemes, themeName, preferences.theme);
    readNumber(document, "zoom", kSmallestZoom, kLargestZoom, preferences.zoom);
    readColumn(document, "left", preferences.left);
    readColumn(document, "right", preferences.right);
    if (const auto window = document.find("window");
        window != document.end() && window->is_object()) {
        readNumber(*window, "width", 320u, 16384u, preferences.width);
        readNumber(*window, "height", 240u, 16384u, preferences.height);
    }
    readName(
        document, "present_mode", kPresentModes, engine::presentModeName, preferences.present_mode);
    if (const auto recent = document.find("recent");
        recent != document.end() && recent->is_array()) {
        for (const scene::Json& scene : *recent)
            if (scene.is_string() && preferences.recent.size() < kMostRecent)
                preferences.recent.emplace_back(scene.get<std::string>());
    }
    return preferences;
}

void remember(Preferences& preferences, const std::filesystem::path& scene) {
    std::error_code failed;
    std::filesystem::path path = std::filesystem::absolute(scene, failed).lexically_normal();
    if (failed) path = scene;
    std::erase(preferences.recent, path);
    preferences.recent.insert(preferences.recent.begin(), path);
    if (preferences.recent.size() > kMostRecent) preferences.recent.resize(kMostRecent);
}

// ---- The file -----------------------------------------------------------------------------------

PreferencesFile::PreferencesFile(const std::filesystem::path& path) : path_(path) {
    std::error_code none;
    if (path_.empty() || !std::filesystem::exists(path_, none)) return;
    try {
        now = readPreferences(engine::readFile(path_));
    } catch (const engine::Error& error) {
        problem_ = std::string("preferences are ignored: ") + error.what();
    }
    kept_ = now;
}

void PreferencesFile::keep() {
    if (path_.empty() || now == kept_) return;
    kept_ = now;
    try {
        engine::writeFileAtomically(path_, preferencesText(now));
    } catch (const engine::Error& error) {
        problem_ = std::string("preferences are not kept: ") + error.what();
        path_.clear();
    }
}

// ---- Columns ------------------------------------------------------------------------------------

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
    float shift = 0.0f;
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
        if (held) shift = dragged().x / ImGui::GetFontSize();
    });
    return shift;
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

void cutText(const std::string& text, float room, ImGuiCol color) {
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(color));
    ImGui::TextUnformatted(shortened(text, room).c_str());
    ImGui::PopStyleColor();
    if (widthOf(text) > room && ImGui::IsItemHovered()) ImGui::SetTooltip("%s", text.c_str());
}

}  // namespace

// ---- Drags --------------------------------------------------------------------------------------

namespace {

constexpr std::array kMouseButtons{
    ImGuiMouseButton_Left, ImGuiMouseButton_Right, ImGuiMouseButton_Middle};

}  // namespace

glm::vec2 dragged() {
    if (std::ranges::none_of(
            kMouseButtons, [](int button) { return ImGui::IsMouseDragging(button); }))
        return glm::vec2(0.0f);
    const ImVec2 by = ImGui::GetIO().MouseDelta;
    return {by.x, by.y};
}

glm::vec2 dragPoint() {
    const ImGuiIO& io = ImGui::GetIO();
    const float least = io.MouseDragThreshold * io.MouseDragThreshold;
    const bool is_click =
        (io.MouseDown[0] || io.MouseReleased[0]) && io.MouseDragMaxDistanceSqr[0] < least;
    const ImVec2 at = is_click ? io.MouseClickedPos[0] : io.MousePos;
    return {at.x, at.y};
}

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

std::string shortened(const std::string& text, float room) {
    if (widthOf(text) <= room) return text;
    std::size_t length = text.size();
    const auto fits = [&] { return widthOf(text.substr(0, length) + "...") <= room; };
    while (length > 0 && !fits()) {
        --length;
        while (length > 0 && (static_cast<unsigned char>(text[length]) & 0xc0u) == 0x80u) --length;
    }
    return text.substr(0, length) + "...";
}

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
