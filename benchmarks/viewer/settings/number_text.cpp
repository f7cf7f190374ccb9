#include "benchmarks/viewer/settings/number_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

namespace benchmarks {

namespace {

constexpr std::array kSigns{
    std::pair<std::string_view, std::string_view>{"^2", "²"},
    std::pair<std::string_view, std::string_view>{"^3", "³"},
    std::pair<std::string_view, std::string_view>{"deg", "°"}};

}  // namespace

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
    // All of a small range across a panel.
    if (range <= 4.0) return range / 400.0;
    // Of a large one a hundredth of what the number is, so that the digits that matter move.
    return std::max(std::abs(value) * 0.01, std::min(range / 4000.0, 0.01));
}

}  // namespace benchmarks
