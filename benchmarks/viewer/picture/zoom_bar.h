#pragma once

#include <optional>

#include "benchmarks/viewer/picture/arrange.h"

namespace benchmarks {

// Buttons for how large pictures are shown, in one line or as many as it takes.
void zoomBar(std::optional<int>& zoom);

// How thick a bar for scrolling is.
float scrollBarWidth();

// Bars below and at the right of `room` for the axes along which less than all of a picture is
// seen. They move what is in the middle.
void pictureScrollBars(const PictureRect& room, glm::vec2 visible_share, glm::vec2& focus);

}  // namespace benchmarks
