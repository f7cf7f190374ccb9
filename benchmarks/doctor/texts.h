#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace benchmarks {

// "12.3 %" of a share of 0.123.
std::string shareText(double share);

// "1.2 % more", "0.3 % less" of shares of 0.012 and -0.003.
std::string changeText(double share);

std::string joined(const std::vector<std::string>& parts, std::string_view between);

}  // namespace benchmarks
