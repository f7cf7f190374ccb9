#pragma once

#include <glm/vec2.hpp>

namespace benchmarks::physics {

// A chain of `length` that hangs between pins at (0, 0) and (span, 0): y = a cosh((x - x0) / a) +
// c.
class Catenary {
public:
    // 0 < span < length, m.
    Catenary(double span, double length);

    // At arc length s in [0, length] from the first pin, m.
    glm::dvec2 at(double s) const;

    double parameter() const { return parameter_; }  // a, m

private:
    double span_;
    double length_;
    double parameter_;
};

}  // namespace benchmarks::physics
