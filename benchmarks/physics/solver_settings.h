#pragma once

#include <optional>
#include <string>

#include "hair/settings.h"

// How each solver is set up to be compared with theory, and what it can't be asked.
namespace benchmarks::physics {

inline constexpr double kGravity = 9.81;  // m/s^2, down -y

// A hair as a user gets it, but for this gravity.
hair::SimulationSettings defaultHair(hair::Solver solver);

// The hair with nothing but its stiffness and weight: neither friction nor a pull to rest.
hair::SimulationSettings freeHair(hair::Solver solver);

// A chain: segments keep their length, as well as the solver can, and do not resist bending. `rod`
// always does; its modulus is so small that strands up to `length` bend by their weight at once.
hair::SimulationSettings chain(hair::Solver solver, double length);

// Friction that takes exp(-rate) of the velocity in 1 s. `rate` in 1/s.
float frictionOf(double rate);

// rho g S L^3 / EI = 4 rho g L^3 / (E R^2): weight over stiffness, "Gamma" of Romero et al. 2021,
// Physical validation of simulators in computer graphics; and the length that has it, m.
double gammaOf(const hair::MaterialSettings& material, double length);
double lengthOf(const hair::MaterialSettings& material, double gamma);

double bendingStiffness(const hair::MaterialSettings& material);  // EI, N m^2
double lineDensity(const hair::MaterialSettings& material);       // kg/m

// What a check may need of a solver.
enum class Need {
    free_vertices,  // that fly where nothing holds them
    pinned_tip,
    equal_masses,   // in vertices
    bending,        // stiffness against it
    material,       // bending stiffness by a modulus
    iterations
};

// Why it can't be had; absent where it can.
std::optional<std::string> lack(hair::Solver solver, Need need);

// Sets the number of iterations of a solver that has one.
void setIterations(hair::SimulationSettings& settings, std::uint32_t iterations);

}  // namespace benchmarks::physics
