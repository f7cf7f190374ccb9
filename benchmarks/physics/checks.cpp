#include "benchmarks/physics/checks.h"

namespace benchmarks::physics {

namespace {

using engine::Device;
using hair::Solver;

constexpr unsigned kMasses[] = {1, 2, 3, 5};
// The ratios at which Romero et al. 2021 and the tables of docs/physics.md are read.
constexpr double kGammas[] = {0.1, 1.0, 5.0, 10.0, 50.0, 100.0, 1000.0};

constexpr Check kChecks[] = {
    {"projectile", checkProjectile},
    {"free_fall", checkFreeFall},
    {"pendulum", [](const Device& device, Solver solver,
                    Findings& findings) { checkPendulum(device, solver, kMasses, findings); }},
    {"hanging_chain", checkHangingChain},
    {"catenary", checkCatenary},
    {"cantilever", [](const Device& device, Solver solver,
                      Findings& findings) { checkCantilever(device, solver, kGammas, findings); }},
    {"convergence", checkConvergence},
    {"bending_frequency", checkBendingFrequency},
    {"clamp_twist", checkClampTwist},
    {"bend_twist", checkBendTwist},
    {"length", checkLength},
    {"energy", checkEnergy},
    {"step_invariance", checkStepInvariance},
    {"substep_invariance", checkSubstepInvariance},
    {"segment_invariance", checkSegmentInvariance},
    {"iteration_invariance", checkIterationInvariance},
    {"state_hash", checkStateHash},
};

}  // namespace

std::span<const Check> allChecks() { return kChecks; }

}  // namespace benchmarks::physics
