#pragma once

#include "benchmarks/viewer/picture/picture_area.h"
#include "hair/settings.h"

namespace benchmarks {

// What the user wants of the two sides.
enum class CompareWish {
    nothing,
    start,  // a second side, equal to the first
    stop,   // a alone
    swap,
    copy_a_to_b,  // a's settings
};

// Everything about comparing two settings: how their pictures are shown, and what differs.
class ComparePanel {
public:
    int edited = 0;           // the side that the settings panel changes; 0: a, 1: b
    bool same_camera = true;  // what the mouse does to one picture's camera, it does to both

    // Within the current window of Dear ImGui. `b` is null while nothing is compared.
    CompareWish show(PictureArea& area, const hair::Settings& a, const hair::Settings* b);
};

}  // namespace benchmarks
