#include "benchmarks/viewer/shell/layout.h"

#include <algorithm>
#include <cmath>

namespace benchmarks {

namespace {

// Heights of a letter.
constexpr float kSplitter = 0.4f;
constexpr float kPlay = 2.3f;
constexpr float kStatus = 1.8f;
constexpr float kLeastPicture = 8.0f;  // beside the last column

// Whole pixels: letters are blurred between them.
float pixels(float letters, float letter) { return std::round(letters * letter); }

}  // namespace

Layout arrange(
    float width, float height, float top, float letter, const Column& left, const Column& right) {
    Layout layout;
    const float status = std::min(pixels(kStatus, letter), std::max(height - top, 0.0f));
    const float play = std::min(pixels(kPlay, letter), std::max(height - top - status, 0.0f));
    layout.status = {0.0f, height - status, width, status};
    layout.play = {0.0f, layout.status.y - play, width, play};

    const float splitter = pixels(kSplitter, letter);
    const float narrowest = pixels(kNarrowestColumn, letter);
    const float picture = pixels(kNarrowestPicture, letter);
    const float least = pixels(kLeastPicture, letter);
    layout.merged = width < 2.0f * (narrowest + splitter) + picture;
    const bool fits = width >= narrowest + splitter + least;
    const bool has_left = fits && (left.shown || (layout.merged && right.shown));
    const bool has_right = right.shown && !layout.merged;

    const float others = has_right ? narrowest + 2.0f * splitter + picture : splitter + picture;
    const float left_width =
        has_left
            ? std::clamp(pixels(left.width, letter), narrowest, std::max(narrowest, width - others))
            : 0.0f;
    const float left_end = has_left ? left_width + splitter : 0.0f;
    const float right_width = has_right
                                  ? std::clamp(
                                        pixels(right.width, letter), narrowest,
                                        std::max(narrowest, width - left_end - splitter - picture))
                                  : 0.0f;
    const float right_start = has_right ? width - right_width : width;
    const float picture_end = has_right ? right_start - splitter : width;

    const float tall = std::max(layout.play.y - top, 0.0f);
    if (has_left) {
        layout.left = {0.0f, top, left_width, tall};
        layout.left_splitter = {left_width, top, splitter, tall};
    }
    layout.picture = {left_end, top, std::max(picture_end - left_end, 0.0f), tall};
    if (has_right) {
        layout.right_splitter = {picture_end, top, splitter, tall};
        layout.right = {right_start, top, right_width, tall};
    }
    return layout;
}

}  // namespace benchmarks
