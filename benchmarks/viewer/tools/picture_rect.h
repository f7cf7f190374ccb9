#pragma once

#include <glm/vec2.hpp>

namespace benchmarks {

// Where a picture is in the window, in Dear ImGui's coordinates.
struct PictureRect {
    glm::vec2 corner{0.0f};  // top left
    glm::vec2 size{1.0f};

    // Of a point in the window: (0, 0) top left to (1, 1) bottom right.
    glm::vec2 share(glm::vec2 point) const { return (point - corner) / size; }
};

}  // namespace benchmarks
