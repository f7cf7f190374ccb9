#pragma once

#include <vector>

// Small vibrations of what hangs or sticks out.
namespace benchmarks::physics {

inline constexpr double kPi = 3.14159265358979323846;

// Laguerre's polynomial L_n (Abramowitz and Stegun 1964, Handbook of mathematical functions,
// 22.7.12).
double laguerre(unsigned n, double x);

// Its n roots, ascending.
std::vector<double> laguerreRoots(unsigned n);

// A pendulum of n equal masses on links of equal length. Mass k above the lowest one (k = 0) obeys
//     l u''_k / g = (k + 1) (u_(k+1) - u_k) - k (u_k - u_(k-1)),
// Laguerre's recurrence for u_k = L_k(x) with w^2 = x g / l; L_n(x) = 0 holds the upper end.
struct PendulumMode {
    double frequency;            // Hz
    std::vector<double> shape;  // horizontal, of each mass from the upper end down; the greatest 1
};

// All n modes, the slowest first.
std::vector<PendulumMode> pendulumModes(unsigned n, double link, double gravity);

// First period of a hanging chain, 2 pi / (j / 2) sqrt(L / g), j the first root of Bessel's J0
// (D. Bernoulli 1738; Rayleigh 1894, Theory of sound). s
double hangingChainPeriod(double length, double gravity);

// First frequency of a clamped beam without weight, z^2 / (2 pi) sqrt(EI / (lambda L^4)) with
// cos z cosh z = -1. Stiffness EI in N m^2, line density in kg/m. Hz
double cantileverFrequency(double stiffness, double line_density, double length);

// Its shape at s in [0, 1], 1 at the tip.
double cantileverShape(double s);

}  // namespace benchmarks::physics
