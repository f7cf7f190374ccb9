#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/physics/experiment.h"
#include "benchmarks/report/report.h"
#include "engine/device.h"
#include "hair/fields.h"
#include "hair/settings.h"

// The results of the validation suite as plain values, and its report. results/physics.schema.json
// describes the report.

namespace benchmarks::physics {

// Only a solver's promises are gated and pass or fail. Other measurements are reported, because a
// solver's distance from theory is a result too. Skipped: it cannot be measured.
enum class Verdict { pass, fail, reported, skipped };

const char* verdictName(Verdict verdict);

struct Parameter {
    std::string name;
    double value = 0.0;
    std::string unit;
};

// A measured quantity and its circumstances.
struct Quantity {
    std::string name;
    std::string unit;
    std::vector<Parameter> parameters{};
};

struct Outcome {
    std::string check;
    std::string solver;
    Quantity quantity;  // a skipped check has no name
    // Not finite if it could not be measured; `reason` tells why.
    double measured = std::numeric_limits<double>::quiet_NaN();
    std::optional<double> expected;
    std::optional<double> error;  // |measured / expected - 1|, or `measured` if that is itself an
                                  // error
    std::optional<double> tolerance;  // the greatest error that passes
    Verdict verdict = Verdict::reported;
    std::string reason;  // reason for skipping or for a missing measurement
    std::string state_hash;
};

// A column of a curve.
struct Series {
    std::string name;
    std::string unit;
};

// Rows of numbers for a figure.
struct Curve {
    std::string check;
    std::string solver;
    std::string name;
    std::vector<Series> columns;
    std::vector<std::vector<double>> rows;
};

// The names of the program's solvers that can be checked: all except `none`, in the order of the
// settings.
const std::vector<hair::Named<hair::Solver>>& checkedSolvers();
// Returns the name of one of the program's solvers, or a file's without its folder.
std::string nameOf(const CheckedSolver& solver);

// The results of one check for one solver. An outcome with a tolerance is a gate. A solver from a
// file has only the gates of checks that every solver passes. Callers may add a reason or a hash to
// the returned outcome.
class Findings {
public:
    Findings(std::string check, const CheckedSolver& solver);

    // Compares with a value from theory; the error is relative to it.
    Outcome& compare(
        Quantity quantity, double measured, double expected, std::optional<double> tolerance = {});

    // Adds a quantity that is itself an error.
    Outcome& deviation(Quantity quantity, double measured, std::optional<double> tolerance = {});

    // Adds a quantity without a theoretical value.
    Outcome& value(Quantity quantity, double measured);

    void skip(std::string reason);
    // Records that the check itself could not be carried out.
    void fail(std::string reason);

    // Omits rows with a number that is not finite.
    void
    curve(std::string name, std::vector<Series> columns, std::vector<std::vector<double>> rows);

    const std::vector<Outcome>& outcomes() const { return outcomes_; }
    const std::vector<Curve>& curves() const { return curves_; }

private:
    Outcome& add(Outcome outcome);

    std::string check_;
    std::string solver_;
    bool has_gates_;
    std::vector<Outcome> outcomes_;
    std::vector<Curve> curves_;
};

inline constexpr const char* kPhysicsSchema = "hairbench-physics/1.0.0";

struct PhysicsReport {
    report::Environment environment;
    std::vector<Outcome> outcomes;
    std::vector<Curve> curves;
    bool interrupted = false;  // the last check may be missing
};

// Indented JSON. Unknown values are absent.
std::string physicsReportText(const PhysicsReport& report);

// Text for a terminal: a line on the device, the outcomes by check, and the number of passes.
std::string physicsTable(const PhysicsReport& report);

// kCheckFailed if a check failed, kNothingRan if none could be carried out, kInterrupted, or kOk.
int exitStatus(const PhysicsReport& report);

// The validation suite. docs/physics.md describes each check and the source of its theory. Each
// check plays one solver on the device, and throws engine::Interrupted if the user asks to stop.

struct Check {
    const char* name;
    void (*run)(const engine::Device& device, const CheckedSolver& solver, Findings& findings);
};

std::span<const Check> allChecks();

// Returns the solvers of these names, or all of the program's if there are none. A name that ends
// in .glsl is a file. Throws engine::Error "--solver <name>: ..." for an unknown name and for a
// file that can't be read or does not compile.
std::vector<CheckedSolver> chosenSolvers(const std::vector<std::string>& names);

// Returns the checks with matching names. Throws engine::Error "--check <regex>: ..." for an
// invalid regular expression.
std::vector<Check> chosenChecks(const std::string& regex);

// Adds the results of each check for each solver to the report, with progress on stderr. A check
// that cannot be carried out is part of the result, and the others follow. If the user stops it,
// the results so far are kept and `report.interrupted` is set.
void runChecks(
    const engine::Device& device, std::span<const Check> checks,
    std::span<const CheckedSolver> solvers, PhysicsReport& report);

// ---- Published results --------------------------------------------------------------------------

// Whether all of a paper's figures are played, or those that take seconds of the host's time.
enum class PaperSize { whole, small };

// The scenes of scenes/papers beside their papers' figures. A figure that the authors' code or
// theory gives is a gate; the others are reported. Each throws engine::Error if its scene is
// missing.

// Hsu et al. 2025: the authors' cantilever, and its convergence by iterations.
void playStableCosserat(const engine::Device&, PaperSize, Findings&);
// Amador Herrera et al. 2024: sag by the integrity springs' stiffness, and time of their strands.
void playAugmentedMassSpring(const engine::Device&, PaperSize, Findings&);
// Mueller, Kim and Chentanez 2012: lengths, and the swing with and without corrected velocities.
void playFollowTheLeader(const engine::Device&, PaperSize, Findings&);
// Han and Harada 2012: sag by iterations, and time of their strands.
void playShapeConstraints(const engine::Device&, PaperSize, Findings&);
// Kugelstadt and Schoemer 2016: a straight rod bends and twists to a helix.
void playPositionBasedRod(const engine::Device&, PaperSize, Findings&);

// Plays all papers whole and adds their results to the report, as runChecks() does.
void playPapers(const engine::Device& device, PhysicsReport& report);

// ---- Against theory -----------------------------------------------------------------------------

// Compares a free vertex with Verlet's exact parabola.
void checkProjectile(const engine::Device&, const CheckedSolver&, Findings&);
// Checks that hair on a freely falling head is not deformed.
void checkFreeFall(const engine::Device&, const CheckedSolver&, Findings&);
// Frequencies of all modes of pendulums with these numbers of equal masses.
void checkPendulum(
    const engine::Device&, const CheckedSolver&, std::span<const unsigned> masses, Findings&);
// First period of a hanging chain.
void checkHangingChain(const engine::Device&, const CheckedSolver&, Findings&);
// Period of a chain that swings far, at several time steps.
void checkLargeSwing(const engine::Device&, const CheckedSolver&, Findings&);
// Rest shape of a chain between two pins.
void checkCatenary(const engine::Device&, const CheckedSolver&, Findings&);
// Sag of a clamped hair under its weight, for these ratios of weight to stiffness.
void checkCantilever(
    const engine::Device&, const CheckedSolver&, std::span<const double> gammas, Findings&);
// Error of the sag of a clamped hair, from coarse to fine segments.
void checkConvergence(const engine::Device&, const CheckedSolver&, Findings&);
// First frequency of a clamped hair without weight.
void checkBendingFrequency(const engine::Device&, const CheckedSolver&, Findings&);
// Half-life of the same vibration against the material's damping, and against the integrator's.
void checkBendingDecay(const engine::Device&, const CheckedSolver&, Findings&);
// Hair with a set: creep of level hair under its weight, and hair that was held bent and let go.
void checkBendingSet(const engine::Device&, const CheckedSolver&, Findings&);
// Rest shape of level and raised hair with a natural curvature.
void checkCurledCantilever(const engine::Device&, const CheckedSolver&, Findings&);
// Hair on a head that turns steadily stays in its state at rest.
void checkTurningHead(const engine::Device&, const CheckedSolver&, Findings&);
// Hair with a natural twist: a curl that winds to a helix, and level hair with twisted sections.
void checkNaturalTwist(const engine::Device&, const CheckedSolver&, Findings&);
// Torque of a straight rod that the weight of an arm at its end twists, also against a natural
// twist.
void checkTwistTorque(const engine::Device&, const CheckedSolver&, Findings&);
// Checks that a curl follows its root's rotation about its own axis.
void checkClampTwist(const engine::Device&, const CheckedSolver&, Findings&);
// Distance of a hanging curl from its plane, and the curvature at which it leaves the plane.
void checkBendTwist(const engine::Device&, const CheckedSolver&, Findings&);
// The length at which a level hair of elliptic section leaves its plane, and its buckled shape.
void checkLateralBuckling(const engine::Device&, const CheckedSolver&, Findings&);
// Rest position of hanging hair in wind, at any time step.
void checkDragDeflection(const engine::Device&, const CheckedSolver&, Findings&);
// Hanging hair of these lengths, m, in these winds, m/s: its rest position, or its flutter where
// the elastica's steady state is unstable.
void checkSteadyDrag(
    const engine::Device&, const CheckedSolver&, std::span<const double> speeds,
    std::span<const double> lengths, Findings&);
// The speed at which the air bears falling hair.
void checkTerminalSpeed(const engine::Device&, const CheckedSolver&, Findings&);
// The speed of air in a bed of hair that slows it, and hair at rest there.
void checkShelter(const engine::Device&, const CheckedSolver&, Findings&);
// Drag along the hair: the fall of a strand along itself, a chain that swings in wind along it, and
// hair at rest in wind.
void checkDragAlong(const engine::Device&, const CheckedSolver&, Findings&);

// Compression at which a hair pressed onto the ground slips.
void checkStickSlip(const engine::Device&, const CheckedSolver&, Findings&);
// Motion of hair down a slope, and its rest there, by Coulomb's law of friction.
void checkSlide(const engine::Device&, const CheckedSolver&, Findings&);
// Momentum lost by contact of hair with hair.
void checkContactMomentum(const engine::Device&, const CheckedSolver&, Findings&);
// Layers of hair on hair that friction or cohesion holds, and the stress when they slide.
void checkHairFriction(const engine::Device&, const CheckedSolver&, Findings&);
// Weight of water in hair, and wet hairs that join.
void checkWetHair(const engine::Device&, const CheckedSolver&, Findings&);
// Sliding speed of hair past hair, at any time step.
void checkFrictionInvariance(const engine::Device&, const CheckedSolver&, Findings&);

// ---- Against itself -----------------------------------------------------------------------------

void checkLength(const engine::Device&, const CheckedSolver&, Findings&);
void checkEnergy(const engine::Device&, const CheckedSolver&, Findings&);
void checkStepInvariance(const engine::Device&, const CheckedSolver&, Findings&);
void checkSubstepInvariance(const engine::Device&, const CheckedSolver&, Findings&);
void checkSegmentInvariance(const engine::Device&, const CheckedSolver&, Findings&);
void checkIterationInvariance(const engine::Device&, const CheckedSolver&, Findings&);
// Checks that two equal runs end with the same bits.
void checkStateHash(const engine::Device&, const CheckedSolver&, Findings&);

// ---- Invariance in one table, and work over precision -------------------------------------------

// The four checks of invariance, of hair at rest too.
std::span<const Check> invarianceChecks();

// The solvers and their other methods: `shape with energy`, `rod with generalized_alpha`,
// `stable_cosserat with descent`.
std::vector<CheckedSolver> withVariants(std::span<const CheckedSolver> solvers);

// The order p of errors c^p - finest^p at two values of the coarseness c. Absent if there is none
// between 0.001 and 8.
std::optional<double> observedOrder(
    const std::array<double, 2>& coarseness, const std::array<double, 2>& errors, double finest);

// Tables in Markdown, of these checks' differences: one for each varied parameter, a line for each
// solver at rest and in motion.
std::string invarianceTables(const PhysicsReport& report);

// Error of two motions against references of the same physics, and time of a strand on the device,
// with each of these numbers of substeps of 1/60 s and of iterations: a curve for each motion.
void checkWorkPrecision(
    const engine::Device&, const CheckedSolver&, std::span<const std::uint32_t> substeps,
    std::span<const std::uint32_t> iterations, Findings&);
std::span<const Check> workChecks();

// Adds the cheapest solver of the report for each motion and errors of 1, 5 and 20 % of the length.
void recommendSolvers(PhysicsReport& report);

// Tables in Markdown: each solver's least error, and its least time for these errors with its
// substeps and iterations.
std::string workTables(const PhysicsReport& report);

}  // namespace benchmarks::physics
