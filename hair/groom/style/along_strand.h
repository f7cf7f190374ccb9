#pragma once

#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace hair {

// Where the points of a strand are along it.
class AlongStrand {
public:
    explicit AlongStrand(std::span<const glm::vec3> points);

    double arc(std::size_t point) const { return arcs_[point]; }  // from the root
    double length() const { return arcs_.back(); }
    // Of the length, 0 to 1; 0 everywhere on a strand without length.
    double fraction(std::size_t point) const {
        return length() > 0.0 ? arcs_[point] / length() : 0.0;
    }

private:
    std::vector<double> arcs_;  // [point]
};

// From 0 at `from`, and before it, to 1 at `to`, and after it, level at both: smoothstep, whatever
// the order of the two.
constexpr double ease(double from, double to, double x) {
    if (x <= from) return 0.0;
    if (x >= to) return 1.0;
    const double t = (x - from) / (to - from);
    return t * t * (3.0 - 2.0 * t);
}

}  // namespace hair
