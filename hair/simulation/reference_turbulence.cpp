#include "hair/simulation/reference_turbulence.h"

#include <array>
#include <cmath>

#include <glm/common.hpp>

#include "hair/random.h"

namespace hair::reference {

namespace {

// A value with its gradient.
struct Dual {
    double value = 0.0;
    glm::dvec3 gradient{0.0};
};

Dual operator+(const Dual& a, const Dual& b) {
    return {a.value + b.value, a.gradient + b.gradient};
}

Dual operator-(const Dual& a, const Dual& b) {
    return {a.value - b.value, a.gradient - b.gradient};
}

Dual operator*(const Dual& a, const Dual& b) {
    return {a.value * b.value, a.value * b.gradient + b.value * a.gradient};
}

Dual constant(double value) { return {value, glm::dvec3(0.0)}; }

Dual absolute(const Dual& a) { return a.value < 0.0 ? constant(0.0) - a : a; }

Dual fade(const Dual& t) {
    const Dual cube = t * t * t;
    return constant(6.0) * t * t * cube - constant(15.0) * t * cube + constant(10.0) * cube;
}

std::uint32_t lattice(double whole) {
    return static_cast<std::uint32_t>(static_cast<std::int64_t>(whole));
}

glm::dvec3 latticeGradient(const glm::dvec3& node, std::uint32_t seed, std::uint32_t component) {
    const std::uint32_t column = hash(seed, lattice(node.x), lattice(node.y));
    const std::uint32_t bits = hash(column, lattice(node.z), component);
    glm::dvec3 gradient{0.0};
    for (int axis = 0; axis < 3; ++axis)
        gradient[axis] = ((bits / (4u << (10 * axis)) % 1024u) * 2.0 + 1.0) / 1024.0 - 1.0;
    return gradient;
}

}  // namespace

glm::dvec3 curlNoise(const glm::dvec3& point, std::uint32_t seed) {
    std::array<Dual, 3> potential;
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 node = glm::floor(point) + glm::dvec3(i / 4, i / 2 % 2, i % 2);
        std::array<Dual, 3> d;
        Dual weight = constant(1.0);
        for (int axis = 0; axis < 3; ++axis) {
            Dual& along = d[static_cast<std::size_t>(axis)];
            along.value = point[axis] - node[axis];
            along.gradient[axis] = 1.0;
            weight = weight * (constant(1.0) - fade(absolute(along)));
        }
        for (std::uint32_t r = 0; r < 3; ++r) {
            const glm::dvec3 g = latticeGradient(node, seed, r);
            const Dual slope = constant(g.x) * d[0] + constant(g.y) * d[1] + constant(g.z) * d[2];
            potential[r] = potential[r] + weight * slope;
        }
    }
    const glm::dvec3 curl{
        potential[2].gradient.y - potential[1].gradient.z,
        potential[0].gradient.z - potential[2].gradient.x,
        potential[1].gradient.x - potential[0].gradient.y};
    // The mean square of a component over the cell, an integral of polynomials.
    return curl / std::sqrt(238536280.0 / 480729249.0);
}

glm::dvec3 turbulence(const glm::dvec3& point, std::uint32_t octaves, std::uint32_t seed) {
    constexpr std::uint32_t kPurpose = 0x54555242;  // kTurbulencePurpose of the GPU
    glm::dvec3 sum{0.0};
    double squares = 0.0;
    for (std::uint32_t i = 0; i < octaves; ++i) {
        const double finer = std::exp2(i);
        const glm::dvec3 at = finer * point + (finer - 1.0) * glm::dvec3(0.37, 0.61, 0.23);
        const double amplitude = std::pow(finer, -1.0 / 3.0);
        sum += amplitude * curlNoise(at, hash(seed, i, kPurpose));
        squares += amplitude * amplitude;
    }
    return sum / std::sqrt(squares);
}

}  // namespace hair::reference
