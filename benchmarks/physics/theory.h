#pragma once

#include <optional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "benchmarks/physics/experiment.h"
#include "hair/settings.h"

// Theory of hanging, bending and swinging strands, and the measurements of simulations against it.
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

// Energy of a strand that is straight along +x at rest, J: kinetic, of the weight and, for a solver
// with a material, of bending. It is taken in the middle of a substep with the given start and end.
// The spin of segments is omitted: it is of the order of (segment / length)^2.
double energyOf(
    std::span<const glm::dvec3> before, std::span<const glm::dvec3> after,
    const hair::SimulationSettings& settings, double length);

// Frequency of an oscillation about 0, Hz, from the times of its first and last zero crossing,
// which damping does not shift. Samples are `interval` s apart. Absent with fewer than three
// crossings.
std::optional<double> frequencyOf(std::span<const double> samples, double interval);

// Theory of elastic rods, for comparison with simulations.

// Drop over reach, H/W, of an inextensible rod that is clamped horizontally and hangs under its own
// weight: Romero et al. 2021, Physical validation of simulators in computer graphics. gamma =
// weight * length^2 / (E I), which is 4 rho g L^3 / (E R^2) for a round rod. Without weight the rod
// is a circular arc that turns down by `natural_turn` rad.
//   theta'' = -gamma (1 - s) cos theta,  theta(0) = 0,  theta'(1) = natural_turn
// Accurate to 7 digits for gamma up to 10^4.
double cantileverRatio(double gamma, double natural_turn = 0.0);

// Effects of air on hair, for the material and the air of the settings.

// Force per length, N/m, on a cylinder with a hair's radius, in a cross flow of `speed` >= 0: 1/2
// rho C_D d U^2 with C_D = 1 + 10 Re^(-2/3), Re = rho U d / mu: White 1974, Viscous fluid flow.
double dragPerLength(const hair::SimulationSettings& settings, double speed);

// The speed across a hair at which the drag equals its weight, m/s.
double terminalSpeed(const hair::SimulationSettings& settings);

// The speed at which a hair falls along itself, m/s: /simulation/wind/drag_along times the
// viscosity and this speed is the weight per length.
double terminalSpeedAlong(const hair::SimulationSettings& settings);

// The speed of air, m/s, behind hair with this frontal area for each unit of area across the flow.
// The air's momentum goes to the hair: rho u du/dx = -n dragPerLength(u), with the length n of hair
// per volume (Belcher, Jerram and Hunt 2003, Adjustment of a turbulent boundary layer to a canopy
// of roughness elements). Fourth-order Runge-Kutta in u^(2/3), which is linear in the area.
double shelteredSpeed(const hair::SimulationSettings& settings, double speed, double area);

// The tip of an inextensible rod of this material, m. It hangs straight down -y from a clamp at the
// origin, deflected by the wind along +x. theta is the angle of the tangent t from the vertical,
// and n is perpendicular to t. The wind's part across the rod is U cos theta; it presses with the
// force f = dragPerLength() along n, and its part along the rod pulls with e = drag_along mu U sin
// theta. The force F = T t + N n through a section supports everything below it:
//   EI theta'' = -N,  N' = -f - T theta' + w sin theta,  T' = N theta' - w cos theta - e,
//   theta(0) = 0,  theta'(L) = N(L) = T(L) = 0,
// w is the weight per length. Accurate to 6 digits for weights below 1,000 EI / L^2: shooting from
// the tip loses a factor exp(2/3 sqrt(w L^3 / EI)).
glm::dvec2 draggedTip(const hair::SimulationSettings& settings, double speed, double length);

// Distance in m that a body slides down a slope from rest, under `gravity` and Coulomb's friction,
// in `time`. The slope falls by `angle` from the horizontal at the start, and by 1 / `radius` more
// per metre; an infinite radius is a plane:
//   s'' = g sin(angle + s / radius) - friction (g cos(angle + s / radius) - s'^2 / radius).
// It does not start if friction exceeds tan(angle).
double slideDistance(double gravity, double angle, double radius, double friction, double time);

// The length over which two hairs that begin `distance` apart join, m: twice the arc length at
// which half of the distance is left. `apart`: of each pair of vertices, root first, m. NaN if they
// stay apart.
double joiningLength(std::span<const double> apart, double distance, double segment);

// Releases a strand that is deflected along `sideways` and measures its frequency over five
// expected periods. Absent if it does not swing.
struct Vibration {
    std::span<const double> shape;  // [vertex], root first
    double segment;  // m
    glm::dvec3 direction;
    glm::dvec3 sideways;
    double expected_frequency;  // Hz
};
std::optional<double> measureFrequency(Experiment& experiment, const Vibration& vibration);

// Small vibrations of hanging or protruding strands.

// The n roots of Laguerre's polynomial L_n, ascending.
std::vector<double> laguerreRoots(unsigned n);

// A pendulum of n equal masses on links of equal length. Mass k above the lowest one (k = 0) obeys
//     l u''_k / g = (k + 1) (u_(k+1) - u_k) - k (u_k - u_(k-1)),
// Laguerre's recurrence for u_k = L_k(x) with w^2 = x g / l; L_n(x) = 0 fixes the upper end.
struct PendulumMode {
    double frequency;  // Hz
    std::vector<double> shape;  // horizontal, of each mass from the upper end down; the greatest is
                                // 1
};

// All n modes, the slowest first.
std::vector<PendulumMode> pendulumModes(unsigned n, double link, double gravity);

// First period of a hanging chain, s: 2 pi / (j / 2) sqrt(L / g), where j is the first root of
// Bessel's J0 (D. Bernoulli 1738; Rayleigh 1894, Theory of sound).
double hangingChainPeriod(double length, double gravity);

// The same chain if air blows up along it and bears half of its weight. The air's force stays along
// the chain, so it takes from the tension but not from the weight that pulls a link back. At the
// height x above the tip, with the share a of the weight that air bears,
//   (1 - a) x y'' + y' + w^2 / g y = 0,
//   y = x^((1 - q) / 2) J_(q - 1)(2 sqrt(w^2 x / (g (1 - a)))),
// with q = 1 / (1 - a): 2 for half of the weight. w = j_1 / 2 sqrt(g / (2 L)) with the first zero
// j_1 of J_1.
double chainPeriodInAir(double length, double gravity);
double chainShapeInAir(double x);  // x in [0, 1] from the tip, where it is 1

// First frequency of a clamped beam without weight, Hz: z^2 / (2 pi) sqrt(EI / (lambda L^4)) with
// cos z cosh z = -1. Stiffness EI in N m^2, line density in kg/m.
double cantileverFrequency(double stiffness, double line_density, double length);

// Shape of the same beam at its first frequency, at s in [0, 1]; 1 at the tip.
double cantileverShape(double s);

}  // namespace benchmarks::physics
