#pragma once

#include <glm/vec2.hpp>

#include "benchmarks/viewer/tools/picture_view.h"

namespace benchmarks {

// The mouse over a picture, in one frame of the window.
struct Pointer {
    PictureView view;
    glm::vec2 at{0.0f};     // px in the window
    glm::vec2 moved{0.0f};  // since the last frame of the window
    bool hovers = false;    // over the picture
    bool pressed = false;   // the left button has just gone down on it
    bool holds = false;     // the left button went down on it and is down
};

}  // namespace benchmarks
