#include "benchmarks/doctor/texts.h"

#include <cmath>
#include <cstdio>

namespace benchmarks {

std::string shareText(double share) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f %%", share * 100.0);
    return text;
}

std::string changeText(double share) {
    if (!std::isfinite(share)) return "any amount";
    return shareText(std::abs(share)) + (share < 0.0 ? " less" : " more");
}

std::string joined(const std::vector<std::string>& parts, std::string_view between) {
    std::string text;
    for (const std::string& part : parts) {
        if (!text.empty()) text += between;
        text += part;
    }
    return text;
}

}  // namespace benchmarks
