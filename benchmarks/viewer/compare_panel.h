#pragma once

#include <string>
#include <vector>

#include "benchmarks/viewer/picture_area.h"
#include "hair/settings.h"

// The panel for comparing two settings: how their pictures are shown, and what differs.
namespace benchmarks::viewer {

// What the user wants of the two sides.
enum class CompareWish {
    nothing,
    start,  // a second side, equal to the first
    stop,   // a is shown alone
    swap,
    copy_a_to_b,  // b gets a's settings
};

class ComparePanel {
public:
    int edited = 0;           // the side that the settings panel changes; 0: a, 1: b
    bool same_camera = true;  // what the mouse does to one picture's camera, it does to both

    // Within the current window of Dear ImGui. `b` is null while nothing is compared.
    CompareWish show(PictureArea& area, const hair::Settings& a, const hair::Settings* b);
};

// A field that two settings have different values of.
struct SettingDifference {
    std::string pointer;  // JSON pointer: /strands/density
    std::string a;        // JSON on one line; empty where a has no such field
    std::string b;

    bool operator==(const SettingDifference&) const = default;
};

// The fields that differ, in the order of scene files. Numbers of one vector are one value; members
// of a list are compared one by one.
std::vector<SettingDifference>
settingsDifferences(const hair::Settings& a, const hair::Settings& b);

}  // namespace benchmarks::viewer
