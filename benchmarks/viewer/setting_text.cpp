#include "benchmarks/viewer/setting_text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string_view>
#include <utility>

#include <imgui.h>

namespace benchmarks::viewer {
namespace {

constexpr std::size_t kElements = 10;  // per page

std::size_t pages(std::size_t count) {
    return std::max<std::size_t>((count + kElements - 1) / kElements, 1);
}

constexpr std::array<std::string_view, 4> kAcronyms{"ftl", "lod", "msaa", "ssaa"};

constexpr std::array kSigns{
    std::pair<std::string_view, std::string_view>{"^2", "²"},
    std::pair<std::string_view, std::string_view>{"^3", "³"},
    std::pair<std::string_view, std::string_view>{"deg", "°"}};

// Resizes the string when Dear ImGui needs more room.
int resize(ImGuiInputTextCallbackData* data) {
    if (data->EventFlag != ImGuiInputTextFlags_CallbackResize) return 0;
    auto& text = *static_cast<std::string*>(data->UserData);
    text.resize(static_cast<std::size_t>(data->BufTextLen));
    data->Buf = text.data();
    return 0;
}

}  // namespace

// ---- Pages of a list ----------------------------------------------------------------------------

ElementRange elementsOf(std::size_t page, std::size_t count) {
    const std::size_t first = std::min(page, pages(count) - 1) * kElements;
    return {first, std::min(first + kElements, count)};
}

ElementRange turnPages(std::size_t count) {
    if (pages(count) < 2) return elementsOf(0, count);
    int& page = *ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("page"), 0);
    const int last = static_cast<int>(pages(count)) - 1;
    page = std::clamp(page, 0, last);
    if (ImGui::ArrowButton("##earlier", ImGuiDir_Left)) page = std::max(page - 1, 0);
    ImGui::SameLine();
    if (ImGui::ArrowButton("##later", ImGuiDir_Right)) page = std::min(page + 1, last);
    ImGui::SameLine();
    int shown = page + 1;
    ImGui::SetNextItemWidth(-1.0f);
    ImGui::SliderInt("##page", &shown, 1, last + 1, "page %d", ImGuiSliderFlags_AlwaysClamp);
    page = shown - 1;
    return elementsOf(static_cast<std::size_t>(page), count);
}

// ---- Names --------------------------------------------------------------------------------------

std::string shownName(std::string_view name) {
    std::string shown(name);
    if (std::ranges::count(kAcronyms, name) > 0) {
        std::ranges::transform(shown, shown.begin(), [](unsigned char c) {
            return static_cast<char>(std::toupper(c));
        });
        return shown;
    }
    std::ranges::replace(shown, '_', ' ');
    if (!shown.empty())
        shown.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(shown.front())));
    return shown;
}

std::string searchable(std::string_view text) {
    std::string found(text);
    std::ranges::transform(found, found.begin(), [](unsigned char c) {
        return c == '_' ? ' ' : static_cast<char>(std::tolower(c));
    });
    return found;
}

// ---- Numbers and units --------------------------------------------------------------------------

std::string shownUnit(const char* unit) {
    std::string text = unit;
    if (text == "1" || text == "count" || text == "factor") return {};
    for (const auto& [written, sign] : kSigns)
        for (std::size_t at = text.find(written); at != std::string::npos; at = text.find(written))
            text.replace(at, written.size(), sign);
    return text;
}

std::string numberFormat(const char* conversion, const char* unit) {
    const std::string shown = shownUnit(unit);
    std::string format = conversion;
    if (shown.empty()) return format;
    if (shown != "°") format += ' ';
    for (const char letter : shown) {
        if (letter == '%') format += '%';
        format += letter;
    }
    return format;
}

double dragSpeed(double value, double minimum, double maximum) {
    const double range = maximum - minimum;
    // In a small range, a drag across a panel covers the whole range.
    if (range <= 4.0) return range / 400.0;
    // In a large range, a pixel changes the number by a hundredth of itself, so that its leading
    // digits move.
    return std::max(std::abs(value) * 0.01, std::min(range / 4000.0, 0.01));
}

// ---- Fields of text -----------------------------------------------------------------------------

bool textInput(const char* label, std::string& text, const char* hint) {
    return ImGui::InputTextWithHint(
        label, hint, text.data(), text.capacity() + 1, ImGuiInputTextFlags_CallbackResize, resize,
        &text);
}

}  // namespace benchmarks::viewer
