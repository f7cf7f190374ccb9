#pragma once

#include <cstdint>

#include <glm/vec3.hpp>

// The turbulence of the wind in double: the curl of a potential that is differentiated by the chain
// rule, term by term, and never written out.
namespace hair::reference {

// One size of eddies, in cells; divergence-free, mean 0 and r.m.s. 1 in each component.
//
// The potential's component r at x is the sum over the corners c of x's cell of
// W(x - c) (g_r(c) . (x - c)): gradient noise, whose weights are the product along the axes of
// 1 - (6 t^5 - 15 t^4 + 10 t^3), t = |x - c|. Gradients have entries evenly distributed in (-1, 1).
glm::dvec3 curlNoise(const glm::dvec3& point, std::uint32_t seed);

// Octaves of it at 2^i point + (2^i - 1) (0.37, 0.61, 0.23), their amplitudes proportional to
// 2^(-i/3) (Kolmogorov) and their squares' sum 1. `point` is in the largest eddies' cells.
glm::dvec3 turbulence(const glm::dvec3& point, std::uint32_t octaves, std::uint32_t seed);

}  // namespace hair::reference
