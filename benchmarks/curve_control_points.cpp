#include "benchmarks/curve_control_points.h"

#include <cassert>

namespace benchmarks {

// The spline passes (c[i-1] + 4 c[i] + c[i+1]) / 6 at knot i. Natural ends, c[-1] - 2 c[0] + c[1]
// = 0, make c[0] the first point and likewise the last, which leaves a tridiagonal system for
// those between. Thomas's algorithm: it is diagonally dominant, so no pivots are needed.
std::vector<glm::dvec4> interpolatingControlPoints(std::span<const glm::dvec4> points) {
    assert(points.size() >= 2);
    const std::size_t count = points.size();
    std::vector<glm::dvec4> control(count + 2);
    const std::span<glm::dvec4> c = std::span(control).subspan(1, count);
    std::vector<double> above(count, 0.0);  // the diagonal is 1 after elimination
    c[0] = points[0];
    for (std::size_t i = 1; i + 1 < count; ++i) {
        const double pivot = 4.0 - above[i - 1];
        above[i] = 1.0 / pivot;
        c[i] = (6.0 * points[i] - c[i - 1]) / pivot;
    }
    c[count - 1] = points[count - 1];
    for (std::size_t i = count - 1; i-- > 1;) c[i] -= above[i] * c[i + 1];
    control.front() = 2.0 * c[0] - c[1];
    control.back() = 2.0 * c[count - 1] - c[count - 2];
    return control;
}

}  // namespace benchmarks
