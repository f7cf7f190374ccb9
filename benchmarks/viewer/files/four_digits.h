#pragma once

#include <algorithm>
#include <cstdint>
#include <string>

namespace benchmarks {

// "0012"; larger numbers have as many digits as they need.
inline std::string fourDigits(std::uint32_t number) {
    std::string digits = std::to_string(number);
    return std::string(4 - std::min<std::size_t>(digits.size(), 4), '0') + digits;
}

}  // namespace benchmarks
