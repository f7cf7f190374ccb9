#pragma once

#include <string>

#include "benchmarks/viewer/tools/picture_rect.h"

namespace benchmarks {

enum class Corner { top_left, top_right };

// A few words over a corner of a picture, readable on every one; in more lines where it is narrow,
// and none where there is no room for them.
// `rect` is what is seen of the picture.
void pictureTag(const std::string& text, const PictureRect& rect, Corner corner);

}  // namespace benchmarks
