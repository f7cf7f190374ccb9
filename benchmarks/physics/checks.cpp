#include "benchmarks/physics/checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <string_view>

#include <nlohmann/json.hpp>

#include "benchmarks/measure/progress.h"
#include "benchmarks/physics/experiment.h"
#include "benchmarks/physics/theory.h"
#include "benchmarks/report/change.h"
#include "benchmarks/report/environment.h"
#include "benchmarks/report/text.h"
#include "benchmarks/scene/json.h"
#include "benchmarks/scene/pattern.h"
#include "engine/error.h"
#include "engine/process.h"
#include "hair/simulation/solvers.h"

namespace benchmarks::physics {

// ---- Findings of a check ------------------------------------------------------------------------

const char* verdictName(Verdict verdict) {
    switch (verdict) {
    case Verdict::pass:
        return "pass";
    case Verdict::fail:
        return "fail";
    case Verdict::reported:
        return "reported";
    case Verdict::skipped:
        return "skipped";
    }
    return "fail";
}

const std::vector<hair::Named<hair::Solver>>& checkedSolvers() {
    static const auto solvers = [] {
        hair::SimulationSettings settings;
        const hair::Field& field = hair::fieldAt(settings, &settings.solver);
        const auto& row = std::get<hair::ChoiceOrFile>(field.kind);
        std::vector<hair::Named<hair::Solver>> named;
        for (std::size_t i = 0; i < row.names.size(); ++i) {
            row.choose(settings, i);
            if (settings.solver != hair::Solver::none)
                named.push_back({settings.solver, row.names[i].name});
        }
        return named;
    }();
    return solvers;
}

std::string nameOf(const CheckedSolver& solver) {
    if (!solver.file.empty()) return std::filesystem::path(solver.file).filename().string();
    const auto& all = checkedSolvers();
    const auto found = std::ranges::find(all, solver.solver, &hair::Named<hair::Solver>::value);
    return found == all.end() ? "none" : found->name + solver.variant;
}

// Checks that a solver passes if it moves guides as shaders/extension/solver.glsl tells.
constexpr std::array<std::string_view, 3> kGatesOfFiles{
    "free_fall", "terminal_speed", "state_hash"};

Findings::Findings(std::string check, const CheckedSolver& solver)
    : check_(std::move(check)), solver_(nameOf(solver)),
      has_gates_(
          solver.file.empty() || std::ranges::find(kGatesOfFiles, check_) != kGatesOfFiles.end()) {}

Outcome& Findings::compare(
    Quantity quantity, double measured, double expected, std::optional<double> tolerance) {
    return add(
        {.quantity = std::move(quantity),
         .measured = measured,
         .expected = expected,
         .error = std::abs(measured / expected - 1.0),
         .tolerance = tolerance});
}

Outcome& Findings::deviation(Quantity quantity, double measured, std::optional<double> tolerance) {
    return add(
        {.quantity = std::move(quantity),
         .measured = measured,
         .error = measured,
         .tolerance = tolerance});
}

Outcome& Findings::value(Quantity quantity, double measured) {
    return add({.quantity = std::move(quantity), .measured = measured});
}

void Findings::skip(std::string reason) {
    outcomes_.push_back(
        {.check = check_,
         .solver = solver_,
         .verdict = Verdict::skipped,
         .reason = std::move(reason)});
}

void Findings::fail(std::string reason) {
    skip(std::move(reason));
    outcomes_.back().verdict = Verdict::fail;
}

void Findings::curve(
    std::string name, std::vector<Series> columns, std::vector<std::vector<double>> rows) {
    std::erase_if(rows, [](const std::vector<double>& row) {
        return !std::ranges::all_of(row, [](double number) { return std::isfinite(number); });
    });
    curves_.push_back({check_, solver_, std::move(name), std::move(columns), std::move(rows)});
}

// A quantity that cannot be measured has no error and does not pass.
Outcome& Findings::add(Outcome outcome) {
    outcome.check = check_;
    outcome.solver = solver_;
    if (!has_gates_) outcome.tolerance.reset();
    if (!std::isfinite(outcome.measured)) outcome.reason = "not a number";
    if (outcome.error && !std::isfinite(*outcome.error)) outcome.error.reset();
    if (outcome.tolerance)
        outcome.verdict =
            outcome.error && *outcome.error <= *outcome.tolerance ? Verdict::pass : Verdict::fail;
    return outcomes_.emplace_back(std::move(outcome));
}

namespace {

// ---- JSON ---------------------------------------------------------------------------------------

scene::Json toJson(const Outcome& outcome) {
    scene::Json object = {{"check", outcome.check}, {"solver", outcome.solver}};
    if (!outcome.quantity.name.empty()) {
        object["quantity"] = outcome.quantity.name;
        object["unit"] = outcome.quantity.unit;
        scene::Json& parameters = object["parameters"] = scene::Json::object();
        for (const Parameter& each : outcome.quantity.parameters)
            parameters[each.name] = {{"value", each.value}, {"unit", each.unit}};
    }
    if (std::isfinite(outcome.measured)) object["measured"] = outcome.measured;
    if (outcome.expected) object["expected"] = *outcome.expected;
    if (outcome.error) object["error"] = *outcome.error;
    if (outcome.tolerance && std::isfinite(*outcome.tolerance))
        object["tolerance"] = *outcome.tolerance;
    object["verdict"] = verdictName(outcome.verdict);
    if (!outcome.reason.empty()) object["reason"] = outcome.reason;
    if (!outcome.state_hash.empty()) object["state_hash"] = outcome.state_hash;
    return object;
}

scene::Json toJson(const Curve& curve) {
    scene::Json object = {{"check", curve.check}, {"solver", curve.solver}, {"name", curve.name}};
    scene::Json& columns = object["columns"] = scene::Json::array();
    for (const Series& each : curve.columns)
        columns.push_back({{"name", each.name}, {"unit", each.unit}});
    object["rows"] = curve.rows;
    return object;
}

}  // namespace

std::string physicsReportText(const PhysicsReport& report) {
    scene::Json object = scene::Json::object();
    object["schema"] = kPhysicsSchema;
    object["environment"] = report::environmentJson(report.environment);
    object["interrupted"] = report.interrupted;
    scene::Json& outcomes = object["outcomes"] = scene::Json::array();
    for (const Outcome& outcome : report.outcomes) outcomes.push_back(toJson(outcome));
    scene::Json& curves = object["curves"] = scene::Json::array();
    for (const Curve& curve : report.curves) curves.push_back(toJson(curve));
    // Output of drivers and commands need not be UTF-8.
    return object.dump(2, ' ', false, scene::Json::error_handler_t::replace) + '\n';
}

namespace {

// ---- Table for a terminal -----------------------------------------------------------------------

// Errors range from 1e-8 to 1, so three significant digits are shown for any size.
std::string figure(std::optional<double> number) {
    if (!number || !std::isfinite(*number)) return "-";
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", *number);
    return text;
}

std::string circumstances(const Quantity& quantity) {
    std::string text;
    for (const Parameter& each : quantity.parameters) {
        const bool count = each.unit == "count";
        text += (text.empty() ? "" : ", ") + each.name + ' ' +
                (count ? std::to_string(std::lround(each.value)) : report::shortNumber(each.value));
        if (each.unit != "1" && !count) text += ' ' + each.unit;
    }
    return text;
}

std::string verdictCell(const Outcome& outcome) {
    std::string text = verdictName(outcome.verdict);
    if (!outcome.reason.empty()) text += ": " + outcome.reason;
    return text;
}

std::string quantityCell(const Quantity& quantity) {
    if (quantity.unit.empty() || quantity.unit == "1") return quantity.name;
    return quantity.name + ", " + quantity.unit;
}

std::vector<report::Column> columns(const std::vector<Outcome>& outcomes) {
    std::vector<report::Column> all{{"check", false}, {"solver", false}, {"quantity", false},
                                    {"with", false},  {"measured"},      {"expected"},
                                    {"error"},        {"tolerance"},     {"verdict", false}};
    for (const Outcome& each : outcomes) {
        const std::array cells{
            each.check,
            each.solver,
            quantityCell(each.quantity),
            circumstances(each.quantity),
            figure(each.measured),
            figure(each.expected),
            figure(each.error),
            figure(each.tolerance),
            verdictCell(each)};
        for (std::size_t i = 0; i < all.size(); ++i) all[i].cells.push_back(cells[i]);
    }
    return all;
}

std::string counts(const std::vector<Outcome>& outcomes) {
    std::string text;
    for (const Verdict verdict :
         {Verdict::pass, Verdict::fail, Verdict::reported, Verdict::skipped}) {
        const auto count = std::ranges::count(outcomes, verdict, &Outcome::verdict);
        text += (text.empty() ? "" : ", ") + std::to_string(count) + ' ' + verdictName(verdict);
    }
    return text + '\n';
}

}  // namespace

std::string physicsTable(const PhysicsReport& report) {
    const report::DeviceRecord& device = report.environment.device;
    std::string text = (device.name.empty() ? "unknown device" : device.name) + ", " +
                       device.driver + ' ' + device.driver_version + '\n';
    const std::vector<report::Column> all = columns(report.outcomes);
    text += report::columnsLine(all, 0);
    for (std::size_t i = 0; i < report.outcomes.size(); ++i) {
        if (i > 0 && report.outcomes[i].check != report.outcomes[i - 1].check) text += '\n';
        text += report::columnsLine(all, i + 1);
    }
    return text + '\n' + counts(report.outcomes);
}

int exitStatus(const PhysicsReport& report) {
    if (report.interrupted) return report::kInterrupted;
    const auto has = [&](Verdict verdict) {
        return std::ranges::find(report.outcomes, verdict, &Outcome::verdict) !=
               report.outcomes.end();
    };
    if (has(Verdict::fail)) return report::kCheckFailed;
    return has(Verdict::pass) || has(Verdict::reported) ? report::kOk : report::kNothingRan;
}

// ---- Checks -------------------------------------------------------------------------------------

namespace {

// ---- All checks ---------------------------------------------------------------------------------

constexpr unsigned kMasses[] = {1, 2, 3, 5};
// The ratios at which Romero et al. 2021 and the tables of docs/physics.md are evaluated.
constexpr double kGammas[] = {0.1, 1.0, 5.0, 10.0, 50.0, 100.0, 1000.0};
constexpr double kSteadySpeeds[] = {0.7, 1.5, 2.5, 4.0, 6.0};  // m/s
constexpr double kSteadyLengths[] = {0.07, 0.1, 0.15, 0.18};  // m

constexpr Check kChecks[] = {
    {"projectile", checkProjectile},
    {"free_fall", checkFreeFall},
    {"pendulum", [](const engine::Device& device, const CheckedSolver& solver,
                    Findings& findings) { checkPendulum(device, solver, kMasses, findings); }},
    {"hanging_chain", checkHangingChain},
    {"large_swing", checkLargeSwing},
    {"catenary", checkCatenary},
    {"cantilever", [](const engine::Device& device, const CheckedSolver& solver,
                      Findings& findings) { checkCantilever(device, solver, kGammas, findings); }},
    {"convergence", checkConvergence},
    {"curled_cantilever", checkCurledCantilever},
    {"bending_frequency", checkBendingFrequency},
    {"bending_decay", checkBendingDecay},
    {"bending_set", checkBendingSet},
    {"turning_head", checkTurningHead},
    {"clamp_twist", checkClampTwist},
    {"natural_twist", checkNaturalTwist},
    {"twist_torque", checkTwistTorque},
    {"bend_twist", checkBendTwist},
    {"lateral_buckling", checkLateralBuckling},
    {"drag_deflection", checkDragDeflection},
    {"steady_drag",
     [](const engine::Device& device, const CheckedSolver& solver, Findings& findings) {
         checkSteadyDrag(device, solver, kSteadySpeeds, kSteadyLengths, findings);
     }},
    {"terminal_speed", checkTerminalSpeed},
    {"drag_along", checkDragAlong},
    {"shelter", checkShelter},
    {"stick_slip", checkStickSlip},
    {"slide", checkSlide},
    {"contact_momentum", checkContactMomentum},
    {"hair_friction", checkHairFriction},
    {"wet_hair", checkWetHair},
    {"friction_invariance", checkFrictionInvariance},
    {"length", checkLength},
    {"energy", checkEnergy},
    {"step_invariance", checkStepInvariance},
    {"substep_invariance", checkSubstepInvariance},
    {"segment_invariance", checkSegmentInvariance},
    {"iteration_invariance", checkIterationInvariance},
    {"state_hash", checkStateHash},
};

void runCheck(
    const engine::Device& device, const Check& check, const CheckedSolver& solver,
    PhysicsReport& report) {
    Findings findings(check.name, solver);
    try {
        check.run(device, solver, findings);
    } catch (const engine::Unsupported& error) {
        findings.skip(error.what());
    } catch (const engine::Error& error) {
        findings.fail(error.what());
    } catch (const engine::Interrupted&) {
        report.interrupted = true;
    }
    for (const std::string& message : device.messages().take())
        findings.fail("validation: " + message);
    const engine::HeldMessages held;
    std::ranges::copy(findings.outcomes(), std::back_inserter(report.outcomes));
    std::ranges::copy(findings.curves(), std::back_inserter(report.curves));
}

}  // namespace

std::span<const Check> allChecks() { return kChecks; }

std::vector<CheckedSolver> chosenSolvers(const std::vector<std::string>& names) {
    std::vector<CheckedSolver> solvers;
    std::vector<std::string> known;
    for (const auto& each : checkedSolvers()) {
        known.emplace_back(each.name);
        if (names.empty() || std::ranges::find(names, each.name) != names.end())
            solvers.emplace_back(each.value);
    }
    for (const std::string& name : names) {
        if (std::ranges::find(known, name) != known.end()) continue;
        if (!name.ends_with(hair::ChoiceOrFile::kExtension))
            throw engine::Error(
                "--solver " + name, scene::unknownName("unknown solver", name, known));
        try {
            solvers.emplace_back(name);
        } catch (const engine::Error& error) {
            throw engine::Error("--solver " + name, error.what());
        }
    }
    return solvers;
}

std::vector<Check> chosenChecks(const std::string& regex) {
    std::vector<Check> chosen;
    try {
        const scene::Pattern wanted(regex);
        for (const Check& check : allChecks())
            if (wanted.isIn(check.name)) chosen.push_back(check);
    } catch (const engine::Error& error) {
        throw engine::Error("--check " + regex, error.what());
    }
    return chosen;
}

void runChecks(
    const engine::Device& device, std::span<const Check> checks,
    std::span<const CheckedSolver> solvers, PhysicsReport& report) {
    measure::Progress progress(checks.size() * solvers.size());
    for (const Check& check : checks)
        for (const CheckedSolver& solver : solvers) {
            if (report.interrupted) break;
            progress.begin(std::string(check.name) + ", " + nameOf(solver));
            runCheck(device, check, solver, report);
        }
    progress.clear();
}

namespace {

// ---- Energy -------------------------------------------------------------------------------------

// A hair released from the horizontal. Energies are relative to weight times half the length, which
// is released between the horizontal and hanging down.

constexpr std::uint32_t kEnergySegments = 16;
constexpr double kEnergyLength = 0.15;  // m
constexpr double kEnergyWindow = 0.25;  // s
// The greatest sampled energy of a window may exceed that of the previous window by rounding and by
// the samples' distance from the true maximum.
constexpr double kEnergyTolerance = 1e-3;

std::vector<double>
energies(const engine::Device& device, const hair::SimulationSettings& settings, double seconds) {
    Experiment experiment(
        device, straightStrand(kEnergySegments, kEnergyLength, {1.0, 0.0, 0.0}), settings);
    const double scale =
        lineDensity(settings.material) * kGravity * kEnergyLength * kEnergyLength / 2.0;
    std::vector<double> samples;
    std::vector<glm::dvec3> before = experiment.positions();
    for (std::uint32_t i = 0; i < experiment.stepsIn(seconds); ++i) {
        experiment.advance(1);
        std::vector<glm::dvec3> after = experiment.positions();
        samples.push_back(energyOf(before, after, settings, kEnergyLength) / scale);
        before = std::move(after);
    }
    return samples;
}

// Slope of the least-squares line through the samples, per interval.
double slopeOf(std::span<const double> samples) {
    const double middle = static_cast<double>(samples.size() - 1) / 2.0;
    double products = 0.0;
    double squares = 0.0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double t = static_cast<double>(i) - middle;
        products += t * samples[i];
        squares += t * t;
    }
    return products / squares;
}

// Greatest increase of the maximum energy from one window to the next.
double greatestGrowth(std::span<const double> samples, std::size_t window) {
    double growth = 0.0;
    double before = std::numeric_limits<double>::infinity();
    for (std::size_t start = 0; start + window <= samples.size(); start += window) {
        double greatest = samples[start];
        for (const double sample : samples.subspan(start, window))
            greatest = worst(greatest, sample);
        growth = worst(growth, greatest - before);
        before = greatest;
    }
    return growth;
}

}  // namespace

void checkEnergy(const engine::Device& device, const CheckedSolver& solver, Findings& findings) {
    // Uses one solver step per time step; otherwise the energy would be averaged over several.
    hair::SimulationSettings settings = freeHair(solver);
    settings.time_step = hair::simulation::stepOf(settings).sub;
    settings.substeps = 1;
    // Shape constraints have no countable energy, and a ghost's energy is not counted.
    settings.local.stiffness = 0.0f;
    settings.augmented_mass_spring.integrity = 0.0f;
    settings.augmented_mass_spring.angular_stiffness = 0.0f;
    const double step = settings.time_step;
    const std::vector<Parameter> parameters{{"time_step", step, "s"}};
    findings.value(
        {"drift without friction, per second", "1/s", parameters},
        slopeOf(energies(device, settings, 2.0)) / step);

    settings.friction = defaultHair(solver).friction;
    findings.deviation(
        {"growth from window to window with friction", "1", parameters},
        greatestGrowth(
            energies(device, settings, 4.0),
            static_cast<std::size_t>(std::lround(kEnergyWindow / step))),
        kEnergyTolerance);

    settings.friction = 0.0f;
    settings.wind.mode = hair::WindMode::drag;
    findings.deviation(
        {"growth from window to window in still air", "1", parameters},
        greatestGrowth(
            energies(device, settings, 4.0),
            static_cast<std::size_t>(std::lround(kEnergyWindow / step))),
        kEnergyTolerance);
    if (solver != hair::Solver::rod) return;

    settings.wind.mode = hair::WindMode::thesis;
    settings.rod.integrator = hair::RodIntegrator::generalized_alpha;
    const std::vector<double> samples = energies(device, settings, 4.0);
    findings.value(
        {"drift with generalized_alpha, per second", "1/s", parameters}, slopeOf(samples) / step);
    findings.deviation(
        {"growth with generalized_alpha without friction", "1", parameters},
        greatestGrowth(samples, static_cast<std::size_t>(std::lround(kEnergyWindow / step))),
        kEnergyTolerance);
}

namespace {

// ---- State hash ---------------------------------------------------------------------------------

std::vector<glm::vec3> play(const engine::Device& device, const CheckedSolver& solver) {
    Experiment experiment(device, livelyGroom(), livelyHair(solver));
    experiment.advance(experiment.stepsIn(2.0));
    const std::vector<glm::dvec3> points = experiment.positions();  // exactly the values that were
                                                                    // read
    return {points.begin(), points.end()};
}

}  // namespace

void checkStateHash(const engine::Device& device, const CheckedSolver& solver, Findings& findings) {
    const std::vector<glm::vec3> first = play(device, solver);
    const std::vector<glm::vec3> second = play(device, solver);
    double different = 0.0;
    for (std::size_t i = 0; i < first.size(); ++i)
        different += std::memcmp(&first[i], &second[i], sizeof first[i]) != 0 ? 1.0 : 0.0;
    findings.deviation({"vertices that differ in any bit", "count"}, different, 0.0).state_hash =
        report::hashBytes(std::as_bytes(std::span(first)));
}

}  // namespace benchmarks::physics
