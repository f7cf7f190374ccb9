#pragma once

namespace benchmarks {

// A part of the window, in Dear ImGui's coordinates.
struct Box {
    float x = 0.0f;
    float y = 0.0f;
    float width = 0.0f;
    float height = 0.0f;

    float right() const { return x + width; }
    float bottom() const { return y + height; }
    bool empty() const { return width <= 0.0f || height <= 0.0f; }
};

// A column of panels beside the picture, as the user wants it.
struct Column {
    float width = 20.0f;  // heights of a letter, so that it is right at any scale
    bool shown = true;

    bool operator==(const Column&) const = default;
};

// What is where in a window. Boxes that there is no room for, or that are not wanted, are empty.
struct Layout {
    Box left;
    Box left_splitter;
    Box picture;
    Box right_splitter;
    Box right;
    Box play;
    Box status;
    bool merged = false;  // there is room for one column: it has the panels of both
};

// The narrowest column whose widgets are whole, and the picture beside two of them, heights of a
// letter.
inline constexpr float kNarrowestColumn = 18.0f;
inline constexpr float kNarrowestPicture = 22.0f;

// Of a window of this size whose menu ends at `top`; `letter` is the height of a letter. Columns
// give way to the picture, and where there is no room for two they become one.
Layout arrange(
    float width, float height, float top, float letter, const Column& left, const Column& right);

}  // namespace benchmarks
