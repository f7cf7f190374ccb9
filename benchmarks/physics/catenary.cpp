#include "benchmarks/physics/catenary.h"

#include <cassert>
#include <cmath>

namespace benchmarks::physics {

namespace {

// a with 2 a sinh(span / 2 a) = length: bisection on u = span / 2 a, where sinh(u) / u rises.
double solveParameter(double span, double length) {
    double low = 1e-9;
    double high = 700.0;
    for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (low + high);
        (std::sinh(middle) / middle < length / span ? low : high) = middle;
    }
    return span / (low + high);
}

}  // namespace

Catenary::Catenary(double span, double length)
    : span_(span), length_(length), parameter_(solveParameter(span, length)) {
    assert(0.0 < span && span < length);
}

glm::dvec2 Catenary::at(double s) const {
    const double a = parameter_;
    const double u = s - length_ / 2.0;  // from the lowest point
    return {span_ / 2.0 + a * std::asinh(u / a), std::hypot(a, u) - std::hypot(a, length_ / 2.0)};
}

}  // namespace benchmarks::physics
