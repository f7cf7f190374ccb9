#pragma once

#include <vector>

struct ImDrawList;

namespace benchmarks {

// A letter as it is drawn, px.
struct DrawnLetter {
    unsigned codepoint = 0;
    float pen = 0.0f;  // where its advance begins, a little left of it
    float left = 0.0f;
    float right = 0.0f;
    float top = 0.0f;
    float bottom = 0.0f;
    bool cut = false;  // at its left or right side
};

// Those of a list of drawing commands. Dear ImGui cuts letters in two ways: it makes the rectangle
// of the letter smaller itself, or lets the device do so by a clip rectangle. What is cut at the
// top or bottom was scrolled there.
std::vector<DrawnLetter> drawnLetters(const ImDrawList& list);

}  // namespace benchmarks
