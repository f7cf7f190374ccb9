#pragma once

#include <string>
#include <vector>

#include "benchmarks/viewer/picture_area.h"
#include "hair/settings.h"

// The panel for comparing two settings: how to show their pictures, and the differences.
namespace benchmarks::viewer {

// The user's request about the two sides.
enum class CompareWish {
    nothing,
    start,  // start a second side, equal to the first
    stop,  // show only a
    swap,
    copy_a_to_b,  // give b the settings of a
};

class ComparePanel {
public:
    int edited = 0;  // the side that the settings panel edits; 0: a, 1: b
    bool same_camera = true;  // mouse and keys move both cameras

    // Shows the panel within the current Dear ImGui window. `b` is null while nothing is compared.
    CompareWish show(PictureArea& area, const hair::Settings& a, const hair::Settings* b);
};

// A field with different values in two settings.
struct SettingDifference {
    std::string pointer;  // JSON pointer: /strands/density
    std::string a;  // JSON on one line; empty if a lacks the field
    std::string b;

    bool operator==(const SettingDifference&) const = default;
};

// Returns the fields that differ, in the order of scene files. A vector counts as one value;
// elements of a list are compared one by one.
std::vector<SettingDifference>
settingsDifferences(const hair::Settings& a, const hair::Settings& b);

}  // namespace benchmarks::viewer
