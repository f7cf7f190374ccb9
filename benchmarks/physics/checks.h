#pragma once

#include <span>
#include <string>
#include <vector>

#include "benchmarks/physics/report.h"
#include "engine/device.h"
#include "hair/settings.h"

// The validation suite. docs/physics.md describes each check and the source of its theory. Each
// check plays one solver on the device, and throws engine::Interrupted if the user asks to stop.
namespace benchmarks::physics {

struct Check {
    const char* name;
    void (*run)(const engine::Device& device, hair::Solver solver, Findings& findings);
};

std::span<const Check> allChecks();

// Returns the solvers of these names, or all that can be checked if there are none. Throws
// engine::Error "--solver <name>: ..." for an unknown name.
std::vector<hair::Solver> chosenSolvers(const std::vector<std::string>& names);

// Returns the checks with matching names. Throws engine::Error "--check <regex>: ..." for an
// invalid regular expression.
std::vector<Check> chosenChecks(const std::string& regex);

// Adds the results of each check for each solver to the report, with progress on stderr. A check
// that cannot be carried out is part of the result, and the others follow. If the user stops it,
// the results so far are kept and `report.interrupted` is set.
void runChecks(
    const engine::Device& device, std::span<const Check> checks,
    std::span<const hair::Solver> solvers, PhysicsReport& report);

// ---- Against theory -----------------------------------------------------------------------------

// Compares a free vertex with Verlet's exact parabola.
void checkProjectile(const engine::Device&, hair::Solver, Findings&);
// Checks that hair on a freely falling head is not deformed.
void checkFreeFall(const engine::Device&, hair::Solver, Findings&);
// Frequencies of all modes of pendulums with these numbers of equal masses.
void checkPendulum(
    const engine::Device&, hair::Solver, std::span<const unsigned> masses, Findings&);
// First period of a hanging chain.
void checkHangingChain(const engine::Device&, hair::Solver, Findings&);
// Rest shape of a chain between two pins.
void checkCatenary(const engine::Device&, hair::Solver, Findings&);
// Sag of a clamped hair under its weight, for these ratios of weight to stiffness.
void checkCantilever(
    const engine::Device&, hair::Solver, std::span<const double> gammas, Findings&);
// Error of the sag of a clamped hair, from coarse to fine segments.
void checkConvergence(const engine::Device&, hair::Solver, Findings&);
// First frequency of a clamped hair without weight.
void checkBendingFrequency(const engine::Device&, hair::Solver, Findings&);
// Half-life of the same vibration against the material's damping.
void checkBendingDecay(const engine::Device&, hair::Solver, Findings&);
// Checks that a curl follows its root's rotation about its own axis.
void checkClampTwist(const engine::Device&, hair::Solver, Findings&);
// Distance of a hanging curl from its plane, and the curvature at which it leaves the plane.
void checkBendTwist(const engine::Device&, hair::Solver, Findings&);
// The length at which a level hair of elliptic section leaves its plane, and its buckled shape.
void checkLateralBuckling(const engine::Device&, hair::Solver, Findings&);
// Rest position of hanging hair in wind, at any time step.
void checkDragDeflection(const engine::Device&, hair::Solver, Findings&);
// The speed at which the air bears falling hair.
void checkTerminalSpeed(const engine::Device&, hair::Solver, Findings&);

// Compression at which a hair pressed onto the ground slips.
void checkStickSlip(const engine::Device&, hair::Solver, Findings&);
// Momentum lost by contact of hair with hair.
void checkContactMomentum(const engine::Device&, hair::Solver, Findings&);
// Sliding speed of hair past hair, at any time step.
void checkFrictionInvariance(const engine::Device&, hair::Solver, Findings&);

// ---- Against itself -----------------------------------------------------------------------------

void checkLength(const engine::Device&, hair::Solver, Findings&);
void checkEnergy(const engine::Device&, hair::Solver, Findings&);
void checkStepInvariance(const engine::Device&, hair::Solver, Findings&);
void checkSubstepInvariance(const engine::Device&, hair::Solver, Findings&);
void checkSegmentInvariance(const engine::Device&, hair::Solver, Findings&);
void checkIterationInvariance(const engine::Device&, hair::Solver, Findings&);
// Checks that two equal runs end with the same bits.
void checkStateHash(const engine::Device&, hair::Solver, Findings&);

}  // namespace benchmarks::physics
