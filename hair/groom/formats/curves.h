#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

// Common parts of formats of curves: cubic bases, and curves that are placed by a matrix.
namespace hair::groom {

// Weights of a segment's four control vertices by powers of t: [vertex][t^0 to t^3].
using CurveBasis = std::array<std::array<double, 4>, 4>;

inline constexpr CurveBasis kBezierBasis{
    {{1.0, -3.0, 3.0, -1.0}, {0.0, 3.0, -6.0, 3.0}, {0.0, 0.0, 3.0, -3.0}, {0.0, 0.0, 0.0, 1.0}}};
inline constexpr CurveBasis kBsplineBasis{
    {{1.0 / 6, -0.5, 0.5, -1.0 / 6},
     {4.0 / 6, 0.0, -1.0, 0.5},
     {1.0 / 6, 0.5, 0.5, -0.5},
     {0.0, 0.0, 0.0, 1.0 / 6}}};
inline constexpr CurveBasis kCatmullRomBasis{
    {{0.0, -0.5, 1.0, -0.5}, {1.0, 0.0, -2.5, 1.5}, {0.0, 0.5, 2.0, -1.5}, {0.0, 0.0, -0.5, 0.5}}};

// Returns the weights at t, from 0 to 1.
inline std::array<double, 4> weightsAt(const CurveBasis& basis, double t) {
    std::array<double, 4> weights{};
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const auto& power = basis[i];
        weights[i] = power[0] + t * (power[1] + t * (power[2] + t * power[3]));
    }
    return weights;
}

// A place in the space of the file is `linear` times the place in this space, plus `translation`.
struct AffineSpace {
    glm::dmat3 linear{1.0};
    glm::dvec3 translation{0.0};

    bool isIdentity() const { return linear == glm::dmat3(1.0) && translation == glm::dvec3(0.0); }

    // Returns the space of objects in `inner`, which is placed in this one.
    AffineSpace of(const AffineSpace& inner) const {
        return {linear * inner.linear, linear * inner.translation + translation};
    }

    glm::dvec3 place(const glm::dvec3& point) const { return linear * point + translation; }

    // Returns the factor of widths; for a scale that differs by direction, the geometric mean.
    double widthFactor() const { return std::cbrt(std::abs(glm::determinant(linear))); }
};

}  // namespace hair::groom
