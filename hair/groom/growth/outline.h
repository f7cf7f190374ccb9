#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

namespace hair {

// A polygon in the plane that many points are tried against.
class Outline {
public:
    explicit Outline(std::vector<glm::dvec2> polygon);

    // Inside by crossing parity, and further from each edge than a thousandth of the edge's length:
    // rounding puts no such point on it.
    bool contains(const glm::dvec2& point) const;

private:
    std::vector<glm::dvec2> polygon_;
    double low_ = 0.0;  // of the rows' y
    double per_row_ = 0.0;  // rows per unit of y
    std::vector<std::uint32_t> starts_;  // [row], first of its edges; one more at the end
    std::vector<std::uint32_t> edges_;  // those that meet each row, by their first vertex
};

}  // namespace hair
