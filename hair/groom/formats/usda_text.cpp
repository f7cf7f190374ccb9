#include "hair/groom/formats/usda_text.h"

#include <charconv>
#include <cmath>

namespace hair {

template <class Number>
void UsdaText::decimal(Number number) {
    std::array<char, 32> digits;
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number);
    buffer_.append(digits.data(), end.ptr);
}

void UsdaText::value(std::uint32_t number) { decimal(number); }

void UsdaText::value(float number) {
    // Decimals are read as doubles, which are then rounded to floats. Of all floats' shortest
    // decimals (tried one by one) that rounds one wrong: 7.038531e-26.
    constexpr float kRoundedWrong = 0x1.5c87fap-84f;
    if (std::abs(number) == kRoundedWrong) return decimal(double{number});
    decimal(number);
}

void UsdaText::value(double number) { decimal(number); }

void UsdaText::string(std::string_view text) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    buffer_ += '"';
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '\n') {
            buffer_ += "\\n";
        } else if (byte < 0x20 || byte == 0x7f) {
            buffer_ += {'\\', 'x', kDigits[byte >> 4], kDigits[byte & 15]};
        } else {
            if (c == '"' || c == '\\') buffer_ += '\\';
            buffer_ += c;
        }
    }
    buffer_ += '"';
}

void UsdaText::flush() {
    out_->write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    buffer_.clear();
}

}  // namespace hair
