#pragma once

#include <array>
#include <charconv>
#include <string>

namespace benchmarks {

// The shortest decimal that reads back as the same float, whatever the locale.
inline std::string decimalText(double value) {
    std::array<char, 32> text{};
    const auto end =
        std::to_chars(text.data(), text.data() + text.size(), static_cast<float>(value));
    return {text.data(), end.ptr};
}

// The coordinates of a glm vector, with `separator` between them.
template <class Vector>
std::string decimalTexts(const Vector& values, const char* separator) {
    std::string text = decimalText(values[0]);
    for (int i = 1; i < Vector::length(); ++i) text += separator + decimalText(values[i]);
    return text;
}

}  // namespace benchmarks
