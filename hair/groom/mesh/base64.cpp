#include "hair/groom/mesh/base64.h"

#include <array>
#include <cstdint>

namespace hair {
namespace {

constexpr std::string_view kAlphabet =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::uint32_t kWrong = 64;

constexpr std::array<std::uint8_t, 256> kValues = [] {
    std::array<std::uint8_t, 256> values{};
    values.fill(kWrong);
    for (std::size_t i = 0; i < kAlphabet.size(); ++i)
        values[static_cast<unsigned char>(kAlphabet[i])] = static_cast<std::uint8_t>(i);
    return values;
}();

}  // namespace

std::optional<std::string> decodeBase64(std::string_view text) {
    if (text.size() % 4 != 0) return {};
    const std::size_t padding = text.ends_with("==") ? 2 : text.ends_with('=') ? 1 : 0;
    std::string bytes(text.size() / 4 * 3, '\0');
    std::uint32_t seen = 0;
    for (std::size_t group = 0; group < text.size() / 4; ++group) {
        const bool is_last = 4 * (group + 1) == text.size();
        std::uint32_t bits = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            const bool is_padding = is_last && i >= 4 - padding;
            const auto c = static_cast<unsigned char>(text[4 * group + i]);
            const std::uint32_t value = is_padding ? 0 : kValues[c];
            seen |= value;
            bits = bits << 6 | value;
        }
        for (std::size_t i = 0; i < 3; ++i)
            bytes[3 * group + i] = static_cast<char>(bits >> (16 - 8 * i) & 0xff);
    }
    if (seen >= kWrong) return {};
    bytes.resize(bytes.size() - padding);
    return bytes;
}

}  // namespace hair
