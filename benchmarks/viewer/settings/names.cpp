#include "benchmarks/viewer/settings/names.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace benchmarks {

namespace {

constexpr std::array<std::string_view, 4> kAcronyms{"ftl", "lod", "msaa", "ssaa"};

}  // namespace

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

}  // namespace benchmarks
