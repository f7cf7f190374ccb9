#pragma once

#include "benchmarks/viewer/tools/picture_rect.h"

namespace benchmarks {

// An upright line in `rect` that is dragged, or moved with the left and right keys while it has the
// keyboard; with Shift they are faster. `share` of the rect is left of it.
void divider(const char* id, const PictureRect& rect, float& share);

}  // namespace benchmarks
