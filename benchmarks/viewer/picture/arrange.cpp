#include "benchmarks/viewer/picture/arrange.h"

#include <glm/common.hpp>

namespace benchmarks {

namespace {

enum Axis { kHorizontal, kVertical };

glm::vec2 middleOf(const PictureRect& rect) { return rect.corner + rect.size * 0.5f; }

// The room that two pictures take beside each other along an axis, without a gap.
glm::vec2 sizeOfBoth(const std::array<glm::vec2, 2>& sizes, Axis along) {
    glm::vec2 size = glm::max(sizes[0], sizes[1]);
    size[along] = sizes[0][along] + sizes[1][along];
    return size;
}

float scaleOfBoth(
    const PictureRect& room, const std::array<glm::vec2, 2>& pixels, float gap, Axis along) {
    glm::vec2 left = room.size;
    left[along] -= gap;
    return fittingScale(left, sizeOfBoth(pixels, along));
}

// As large as there is room, the two together in its middle; each fills its pane.
std::array<Placed, 2>
fitted(const PictureRect& room, const std::array<glm::vec2, 2>& pixels, float gap, Axis along) {
    const float scale = scaleOfBoth(room, pixels, gap, along);
    const std::array sizes{pixels[0] * scale, pixels[1] * scale};
    float next = middleOf(room)[along] - (sizeOfBoth(sizes, along)[along] + gap) * 0.5f;
    std::array<Placed, 2> placed;
    for (std::size_t i = 0; i < 2; ++i) {
        PictureRect rect{middleOf(room) - sizes[i] * 0.5f, sizes[i]};
        rect.corner[along] = next;
        next += sizes[i][along] + gap;
        placed[i] = {rect, rect};
    }
    return placed;
}

}  // namespace

PictureRect common(const PictureRect& a, const PictureRect& b) {
    const glm::vec2 from = glm::max(a.corner, b.corner);
    const glm::vec2 to = glm::min(a.corner + a.size, b.corner + b.size);
    return {from, glm::max(to - from, glm::vec2(0.0f))};
}

float fittingScale(glm::vec2 room, glm::vec2 picture) {
    return glm::max(glm::min(room.x / picture.x, room.y / picture.y), 0.0f);
}

glm::vec2 visibleShare(const Placed& placed) {
    return glm::min(placed.pane.size / placed.picture.size, glm::vec2(1.0f));
}

glm::vec2 reachableFocus(glm::vec2 focus, glm::vec2 visible_share) {
    return glm::clamp(focus, visible_share * 0.5f, 1.0f - visible_share * 0.5f);
}

Placed arrangeOne(const PictureRect& room, glm::vec2 pixels, const Magnification& magnification) {
    const glm::vec2 size =
        pixels * (magnification.scale ? *magnification.scale : fittingScale(room.size, pixels));
    Placed placed{room, {{}, size}};
    const glm::vec2 focus = reachableFocus(magnification.focus, visibleShare(placed));
    placed.picture.corner = middleOf(room) - focus * size;
    // Pixels that have a size of their own start where the screen's do.
    if (magnification.scale) placed.picture.corner = glm::floor(placed.picture.corner);
    return placed;
}

std::array<Placed, 2> arrangeTwo(
    const PictureRect& room, const std::array<glm::vec2, 2>& pixels, float gap,
    const Magnification& magnification) {
    const bool beside =
        scaleOfBoth(room, pixels, gap, kHorizontal) >= scaleOfBoth(room, pixels, gap, kVertical);
    const Axis along = beside ? kHorizontal : kVertical;
    if (!magnification.scale) return fitted(room, pixels, gap, along);
    std::array<Placed, 2> placed;
    for (std::size_t i = 0; i < 2; ++i) {
        PictureRect half = room;
        half.size[along] = glm::max((room.size[along] - gap) * 0.5f, 1.0f);
        if (i == 1) half.corner[along] += half.size[along] + gap;
        placed[i] = arrangeOne(half, pixels[i], magnification);
    }
    return placed;
}

}  // namespace benchmarks
