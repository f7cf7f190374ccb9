#include "engine/error.h"

#include <algorithm>
#include <cstdint>

namespace engine {
namespace {

constexpr char32_t kNone = 0xffffffff;

// One character and its size in bytes: kNone and 1 byte for invalid UTF-8 (RFC 3629).
struct Character {
    char32_t code = kNone;
    std::size_t size = 1;
};

Character firstOf(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned lead = byte(0);
    if (lead < 0x80) return {lead, 1};
    const std::size_t size = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
    constexpr char32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
    if (lead < 0xc2 || lead > 0xf4 || text.size() < size) return {};
    char32_t code = lead & (0xffu >> (size + 1));
    for (std::size_t i = 1; i < size; ++i) {
        if ((byte(i) & 0xc0u) != 0x80) return {};
        code = code << 6 | (byte(i) & 0x3fu);
    }
    if (code < kLeast[size] || code > 0x10ffff || (code >= 0xd800 && code < 0xe000)) return {};
    return {code, size};
}

// Control characters, line breaks, invisible characters, and those that change the writing
// direction (UAX #9).
bool isHidden(char32_t code) {
    struct Range {
        char32_t first, last;
    };
    constexpr Range kHidden[] = {{0, 0x1f},          {0x7f, 0x9f},     {0xad, 0xad},
                                 {0x61c, 0x61c},     {0x200b, 0x200f}, {0x2028, 0x202e},
                                 {0x2060, 0x206f},   {0xfeff, 0xfeff}, {0xfff9, 0xfffb},
                                 {0xe0000, 0xe007f}, {kNone, kNone}};
    return std::ranges::any_of(
        kHidden, [&](const Range& each) { return code >= each.first && code <= each.last; });
}

bool isInside(std::string_view text, std::size_t at) {
    return at < text.size() && (static_cast<unsigned char>(text[at]) & 0xc0) == 0x80;
}

}  // namespace

std::string shownText(std::string_view text, std::size_t longest) {
    std::string shown;
    while (!text.empty()) {
        const Character first = firstOf(text);
        if (first.code == '\n' || first.code == '\r' || first.code == '\t')
            shown += ' ';
        else if (isHidden(first.code))
            shown += '?';
        else
            shown += text.substr(0, first.size);
        text.remove_prefix(first.size);
    }
    if (shown.size() <= longest) return shown;
    constexpr std::string_view kCut = " [...] ";
    const std::size_t end = longest * 7 / 24;
    std::size_t start = longest - std::min(longest, end + kCut.size());
    while (isInside(shown, start)) --start;
    std::size_t rest = shown.size() - end;
    while (isInside(shown, rest)) ++rest;
    return shown.substr(0, start).append(kCut).append(shown, rest);
}

}  // namespace engine
