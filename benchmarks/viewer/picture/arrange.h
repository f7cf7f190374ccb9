#pragma once

#include <array>
#include <optional>

#include <glm/vec2.hpp>

#include "benchmarks/viewer/tools/picture_rect.h"

// Where pictures go in a window: geometry only, in Dear ImGui's coordinates.
namespace benchmarks {

// How much of a picture is to be seen.
struct Magnification {
    std::optional<float> scale;   // of a picture's pixels; absent: as large as there is room
    glm::vec2 focus{0.5f, 0.5f};  // share of the picture that is in the middle, if it can be
};

// A picture in its pane, which it may be larger than.
struct Placed {
    PictureRect pane;
    PictureRect picture;  // all of it
};

// What two have in common; of size 0 where that is nothing.
PictureRect common(const PictureRect& a, const PictureRect& b);

// The largest scale at which a picture fits a room.
float fittingScale(glm::vec2 room, glm::vec2 picture);

// Of a picture of `pixels`, in the middle of the room where it fits. Where it doesn't, no part of
// the room stays empty.
Placed arrangeOne(const PictureRect& room, glm::vec2 pixels, const Magnification& magnification);

// Of two pictures at one scale, `gap` apart: beside each other or, where they are larger then, one
// above the other.
std::array<Placed, 2> arrangeTwo(
    const PictureRect& room, const std::array<glm::vec2, 2>& pixels, float gap,
    const Magnification& magnification);

// The share of a picture that its pane has room for, along each axis: 1 where all of it is seen.
glm::vec2 visibleShare(const Placed& placed);

// The nearest focus that can be in the middle of the pane.
glm::vec2 reachableFocus(glm::vec2 focus, glm::vec2 visible_share);

}  // namespace benchmarks
