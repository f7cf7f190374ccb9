#include "benchmarks/physics/solver_settings.h"

#include <cmath>

#include "benchmarks/physics/vibration.h"
#include "hair/simulation/stiffness.h"

namespace benchmarks::physics {

namespace {

using hair::Solver;

// Weight over stiffness of a rod that is to hang like a chain: it bends within L / sqrt(Gamma) of
// the clamp, a thousandth of its length.
constexpr double kChainGamma = 1e6;

// Enough for 64 segments at steps of a millisecond: their period is then what theory says of 64
// masses to 0.1 %. check_pendulum.cpp says why more is worse.
constexpr std::uint32_t kChainIterations = 64;

struct Lack {
    Solver solver;
    Need need;
    const char* reason;
};

constexpr Lack kLacks[] = {
    {Solver::ftl, Need::free_vertices, "every segment keeps its length: no vertex flies freely"},
    {Solver::rod, Need::free_vertices, "every segment keeps its length: no vertex flies freely"},
    {Solver::ftl, Need::pinned_tip, "it places vertices from the root down and can't hold the tip"},
    {Solver::rod, Need::equal_masses, "it is made of heavy segments: see hanging_chain"},
    {Solver::ftl, Need::bending, "it has no bending stiffness"},
    {Solver::ftl, Need::material, "it has no bending stiffness"},
    {Solver::shape, Need::material, "its stiffness is no material's"},
    {Solver::ftl, Need::iterations, "it has no iterations"},
};

}  // namespace

hair::SimulationSettings defaultHair(Solver solver) {
    hair::SimulationSettings settings;
    settings.solver = solver;
    settings.gravity = {0.0f, static_cast<float>(-kGravity), 0.0f};
    return settings;
}

hair::SimulationSettings freeHair(Solver solver) {
    hair::SimulationSettings settings = defaultHair(solver);
    settings.friction = 0.0f;
    settings.global.stiffness = 0.0f;
    return settings;
}

hair::SimulationSettings chain(Solver solver, double length) {
    hair::SimulationSettings settings = freeHair(solver);
    settings.local = {.stiffness = 0.0f, .iterations = 0};
    settings.length.iterations = kChainIterations;
    const double softer = gammaOf(settings.material, length) / kChainGamma;
    settings.material.youngs_modulus *= static_cast<float>(softer);
    settings.material.shear_modulus *= static_cast<float>(softer);
    return settings;
}

float frictionOf(double rate) {
    return static_cast<float>(-std::expm1(-rate * hair::kReferenceStep));
}

double gammaOf(const hair::MaterialSettings& material, double length) {
    return lineDensity(material) * kGravity * std::pow(length, 3.0) / bendingStiffness(material);
}

double lengthOf(const hair::MaterialSettings& material, double gamma) {
    return std::cbrt(gamma * bendingStiffness(material) / (lineDensity(material) * kGravity));
}

double bendingStiffness(const hair::MaterialSettings& material) {
    return double{material.youngs_modulus} * kPi / 4.0 * std::pow(double{material.radius}, 4.0);
}

double lineDensity(const hair::MaterialSettings& material) {
    return double{material.density} * kPi * std::pow(double{material.radius}, 2.0);
}

std::optional<std::string> lack(Solver solver, Need need) {
    for (const Lack& each : kLacks)
        if (each.solver == solver && each.need == need) return each.reason;
    return {};
}

void setIterations(hair::SimulationSettings& settings, std::uint32_t iterations) {
    settings.local.iterations = iterations;
    settings.length.iterations = iterations;
    settings.rod.iterations = iterations;
}

}  // namespace benchmarks::physics
