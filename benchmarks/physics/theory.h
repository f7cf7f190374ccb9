#pragma once

// What elastic rods do in theory, for simulations to be held against.
namespace benchmarks::physics {

// Drop over reach, H/W, of an inextensible rod that is clamped horizontally and hangs under its own
// weight: Romero et al. 2021, Physical validation of simulators in computer graphics. gamma =
// weight * length^2 / (E I), which is 4 rho g L^3 / (E R^2) for a round rod. Without weight the rod
// is a circular arc that turns down by `natural_turn` rad.
//   theta'' = -gamma (1 - s) cos theta,  theta(0) = 0,  theta'(1) = natural_turn
// Good to 7 digits for gamma up to 10^4.
double cantileverRatio(double gamma, double natural_turn = 0.0);

}  // namespace benchmarks::physics
