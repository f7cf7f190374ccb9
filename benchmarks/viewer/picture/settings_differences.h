#pragma once

#include <string>
#include <vector>

#include "hair/settings.h"

namespace benchmarks {

// A field that two settings have different values of.
struct SettingDifference {
    std::string pointer;  // JSON pointer: /strands/density
    std::string a;        // as JSON, on one line; empty: it has none
    std::string b;

    bool operator==(const SettingDifference&) const = default;
};

// In the order of scene files. Numbers of one vector are one value; members of a list are compared
// one by one.
std::vector<SettingDifference>
settingsDifferences(const hair::Settings& a, const hair::Settings& b);

}  // namespace benchmarks
