#pragma once

#include <cstdint>
#include <span>
#include <string>

#include <glm/vec2.hpp>

#include "benchmarks/viewer/tools/picture_rect.h"

struct ImDrawList;

namespace benchmarks {

// Lines and dots over a picture, each with an outline that makes it stand out from bright and dark.
// Draws into the current window of Dear ImGui, within what is seen of the picture; all sizes scale
// with its font.
class Handles {
public:
    explicit Handles(const PictureRect& seen);
    ~Handles();
    Handles(const Handles&) = delete;
    Handles& operator=(const Handles&) = delete;

    using Color = std::uint32_t;  // IM_COL32
    static constexpr Color kPlain = 0xffffffff;
    static constexpr Color kFaint = 0x90ffffff;
    static constexpr Color kHot = 0xff40d8ff;  // under the mouse, or held: yellow
    static constexpr Color kAxes[] = {
        0xff6060ff, 0xff70e070, 0xffff9060};  // x red, y green, z blue

    // How near the mouse must be to a handle, px.
    static float reach();

    void line(glm::vec2 a, glm::vec2 b, Color color);
    void path(std::span<const glm::vec2> points, Color color);
    void circle(glm::vec2 center, float radius, Color color);
    void dot(glm::vec2 center, Color color);
    void arrow(glm::vec2 from, glm::vec2 tip, Color color);
    // Beside a point, where the picture has room for it.
    void label(glm::vec2 beside, const std::string& text);
    // At the top of the picture: what the user should know.
    void hint(const std::string& text);

private:
    void box(glm::vec2 corner, const std::string& text);

    PictureRect seen_;
    ImDrawList* list_;
};

}  // namespace benchmarks
