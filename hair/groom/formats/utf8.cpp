#include "hair/groom/formats/utf8.h"

#include <cstdint>

namespace hair {

bool isUtf8(std::string_view text) {
    for (std::size_t i = 0; i < text.size();) {
        const auto byte = static_cast<unsigned char>(text[i++]);
        if (byte < 0x80) continue;
        const int more = byte >= 0xf0 ? 3 : byte >= 0xe0 ? 2 : 1;
        constexpr std::uint32_t kLeast[] = {0, 0x80, 0x800, 0x10000};
        if (byte < 0xc0 || byte >= 0xf8) return false;
        std::uint32_t code = byte & (0x3fu >> more);
        for (int k = 0; k < more; ++k) {
            if (i == text.size() || (text[i] & 0xc0) != 0x80) return false;
            code = code << 6 | (static_cast<unsigned char>(text[i++]) & 0x3fu);
        }
        if (code < kLeast[more] || code > 0x10ffff || (code >= 0xd800 && code < 0xe000))
            return false;
    }
    return true;
}

std::string utf8FromLatin1(std::string_view text) {
    std::string utf8;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x80) {
            utf8 += c;
        } else {
            utf8 += static_cast<char>(0xc0 | byte >> 6);
            utf8 += static_cast<char>(0x80 | (byte & 0x3f));
        }
    }
    return utf8;
}

}  // namespace hair
