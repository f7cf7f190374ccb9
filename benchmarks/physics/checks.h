#pragma once

#include <span>
#include <string>
#include <vector>

#include "benchmarks/physics/report.h"
#include "engine/device.h"
#include "hair/settings.h"

// The validation suite: docs/physics.md says what each check does and where its theory is from.
// Each plays one solver on the device, and throws engine::Interrupted when the user asks to
// stop.
namespace benchmarks::physics {

struct Check {
    const char* name;
    void (*run)(const engine::Device& device, hair::Solver solver, Findings& findings);
};

std::span<const Check> allChecks();

// The solvers of these names; all that can be checked where there are none. Throws engine::Error
// "--solver <name>: ..." for one that is unknown.
std::vector<hair::Solver> chosenSolvers(const std::vector<std::string>& names);

// The checks whose names match. Throws engine::Error "--check <regex>: ..." for what is no regular
// expression.
std::vector<Check> chosenChecks(const std::string& regex);

// Adds what each check finds out about each solver to the report, with progress on stderr. A check
// that can't be carried out is part of the result, and the others follow. Where the user stops it,
// what was found until then is kept and `report.interrupted` set.
void runChecks(
    const engine::Device& device, std::span<const Check> checks,
    std::span<const hair::Solver> solvers, PhysicsReport& report);

// ---- Against theory -----------------------------------------------------------------------------

// A free vertex against Verlet's exact parabola.
void checkProjectile(const engine::Device&, hair::Solver, Findings&);
// Hair on a head that falls freely is not deformed.
void checkFreeFall(const engine::Device&, hair::Solver, Findings&);
// Frequencies of all modes of pendulums with so many equal masses.
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
// Half-life of that vibration against the material's damping.
void checkBendingDecay(const engine::Device&, hair::Solver, Findings&);
// A curl follows its root's turn about its own axis.
void checkClampTwist(const engine::Device&, hair::Solver, Findings&);
// How far a hanging curl leaves its plane, and from which curvature on.
void checkBendTwist(const engine::Device&, hair::Solver, Findings&);
// The length at which a level hair of an elliptic section leaves its plane, and where to.
void checkLateralBuckling(const engine::Device&, hair::Solver, Findings&);
// Where wind holds hanging hair, at any time step.
void checkDragDeflection(const engine::Device&, hair::Solver, Findings&);
// The speed at which hair that falls is borne by the air.
void checkTerminalSpeed(const engine::Device&, hair::Solver, Findings&);

// When a hair that is pressed onto the ground slips.
void checkStickSlip(const engine::Device&, hair::Solver, Findings&);
// Momentum that contact of hair with hair loses.
void checkContactMomentum(const engine::Device&, hair::Solver, Findings&);
// How fast hair slides past hair, at any time step.
void checkFrictionInvariance(const engine::Device&, hair::Solver, Findings&);

// ---- Against itself -----------------------------------------------------------------------------

void checkLength(const engine::Device&, hair::Solver, Findings&);
void checkEnergy(const engine::Device&, hair::Solver, Findings&);
void checkStepInvariance(const engine::Device&, hair::Solver, Findings&);
void checkSubstepInvariance(const engine::Device&, hair::Solver, Findings&);
void checkSegmentInvariance(const engine::Device&, hair::Solver, Findings&);
void checkIterationInvariance(const engine::Device&, hair::Solver, Findings&);
// Two equal runs end in the same bits.
void checkStateHash(const engine::Device&, hair::Solver, Findings&);

}  // namespace benchmarks::physics
