#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "benchmarks/physics/checks.h"
#include "benchmarks/physics/experiment.h"
#include "benchmarks/physics/kirchhoff.h"
#include "benchmarks/physics/theory.h"
#include "benchmarks/report/statistics.h"
#include "hair/simulation/solvers.h"

namespace benchmarks::physics {
namespace {

// ---- Catenary -----------------------------------------------------------------------------------

constexpr std::uint32_t kCatenarySegments = 32;
constexpr double kCatenaryLength = 0.2;  // m
constexpr double kCatenarySpan = 0.1;  // m
// 32 links differ from a chain by l^2 / (8 a L) at the lowest point, 0.04 %. The rest is for the
// solver's stretch and for a rod's stiffness at its clamp.
constexpr double kCatenaryTolerance = 0.01;

// Two straight halves from pin to pin.
hair::groom::Groom vee() {
    const double depth =
        std::sqrt(kCatenaryLength * kCatenaryLength - kCatenarySpan * kCatenarySpan) / 2.0;
    hair::groom::Groom groom = straightStrand(kCatenarySegments, kCatenaryLength, {0.0, -1.0, 0.0});
    for (std::uint32_t i = 0; i <= kCatenarySegments; ++i) {
        const double s = 2.0 * i / kCatenarySegments;
        groom.points[i] = {kCatenarySpan / 2.0 * s, -depth * (s < 1.0 ? s : 2.0 - s), 0.0};
    }
    return groom;
}

}  // namespace

void checkCatenary(const engine::Device& device, const CheckedSolver& solver, Findings& findings) {
    if (const auto why = lack(solver, Need::pinned_tip)) return findings.skip(*why);
    hair::SimulationSettings settings = chain(solver, kCatenaryLength);
    settings.time_step = 1.0f / 480.0f;
    settings.substeps = 1;
    settings.friction = frictionOf(std::sqrt(kGravity / kCatenaryLength) * 2.0);
    Experiment experiment(device, vee(), settings);
    experiment.pin(std::array{kCatenarySegments});
    const bool still = experiment.settle(1e-5 * kCatenaryLength, 10.0);

    const Catenary catenary(kCatenarySpan, kCatenaryLength);
    std::vector<glm::dvec3> expected;
    for (std::uint32_t i = 0; i <= kCatenarySegments; ++i)
        expected.emplace_back(catenary.at(kCatenaryLength * i / kCatenarySegments), 0.0);
    std::optional<double> tolerance;
    // Springs against bending and torsion keep the kink of the strand's rest shape.
    if (solver != hair::Solver::position_based_rod && solver != hair::Solver::augmented_mass_spring)
        tolerance = kCatenaryTolerance;
    Outcome& outcome = findings.deviation(
        {"deviation / length",
         "1",
         {{"segments", double{kCatenarySegments}, "count"},
          {"span / length", kCatenarySpan / kCatenaryLength, "1"}}},
        greatestDistance(experiment.positions(), expected) / kCatenaryLength, tolerance);
    if (!still && outcome.reason.empty()) outcome.reason = "still moving after 10 s";
}

namespace {

// ---- Free fall ----------------------------------------------------------------------------------

// By the equivalence principle, nothing acts on hair that falls together with its head. The head
// follows a true parabola, with a keyframe at every step. In between, the harmonic mean of slopes v
// and v + dv is off by dv^2 / 4 v, which moves substeps by less than 1e-6 m at the speeds below.

constexpr double kFallLength = 0.15;  // m
constexpr double kFallInterval = 1.0 / 240.0;  // of a step, s
constexpr int kKeyframes = 145;  // to 0.6 s
constexpr double kFallStart = 0.1;  // s
constexpr double kFallEnd = 0.5;  // s
// Positions are rounded in single precision by 1.2e-7 m at 1 m, which acts as motion in each of 96
// steps. The sum is at most 96^2 / 2 times that, 0.4 % of the length, and typically a tenth of it.
constexpr double kFallTolerance = 1e-3;

glm::dvec3 fallen(double time) {
    return time * glm::dvec3(0.5, -0.5, 0.3) + 0.5 * time * time * glm::dvec3(0.0, -kGravity, 0.0);
}

std::vector<glm::dvec3> moved(std::vector<glm::dvec3> points, const glm::dvec3& by) {
    for (glm::dvec3& point : points) point += by;
    return points;
}

}  // namespace

void checkFreeFall(const engine::Device& device, const CheckedSolver& solver, Findings& findings) {
    hair::SimulationSettings settings = defaultHair(solver);
    settings.friction = 0.0f;  // drag, because the air does not fall
    settings.time_step = static_cast<float>(kFallInterval);
    for (int i = 0; i < kKeyframes; ++i)
        settings.motion.keyframes.push_back(
            {.time = static_cast<float>(i * kFallInterval),
             .rotation = {},
             .translation = fallen(i * kFallInterval)});
    Experiment experiment(device, curvedStrand(15, kFallLength, 8.0), settings);
    const std::vector<glm::dvec3> rest = experiment.positions();

    experiment.advance(experiment.stepsIn(kFallStart));
    const double h = experiment.substep();
    const glm::dvec3 velocity = (fallen(kFallStart) - fallen(kFallStart - h)) / h;
    experiment.launch(
        moved(rest, fallen(kFallStart)), std::vector<glm::dvec3>(rest.size(), velocity));

    double farthest = 0.0;
    for (int i = 1; i <= 8; ++i) {
        experiment.advance(experiment.stepsIn((kFallEnd - kFallStart) / 8.0));
        const double time = kFallStart + i * (kFallEnd - kFallStart) / 8.0;
        farthest =
            worst(farthest, greatestDistance(experiment.positions(), moved(rest, fallen(time))));
    }
    findings.deviation(
        {"deformation / length", "1", {{"time_step", experiment.timeStep(), "s"}}},
        farthest / kFallLength, kFallTolerance);
}

namespace {

// ---- Hanging chain ------------------------------------------------------------------------------

constexpr std::uint32_t kHangingSegments = 64;
constexpr double kHangingLength = 0.3;  // m
constexpr float kHangingTimeSteps[] = {0.001f, 1.0f / 60.0f};  // s
constexpr glm::dvec3 kHangingDown{0.0, -1.0, 0.0};
constexpr glm::dvec3 kHangingSideways{1.0, 0.0, 0.0};

// 64 equal masses swing 0.4 % slower than a chain; a rod of Gamma = 10^6 swings 0.1 % faster.
// Implicit Euler at 1/60 s swings slower by (w h)^2 / 3, 0.4 %.
constexpr double kHangingTolerance = 0.01;

}  // namespace

void checkHangingChain(
    const engine::Device& device, const CheckedSolver& solver, Findings& findings) {
    hair::SimulationSettings settings = chain(solver, kHangingLength);
    settings.substeps = 1;
    const double segment = kHangingLength / kHangingSegments;
    std::vector<double> shape = pendulumModes(kHangingSegments, segment, kGravity).front().shape;
    shape.insert(shape.begin(), 0.0);  // the root
    const double period = hangingChainPeriod(kHangingLength, kGravity);

    for (const float time_step : kHangingTimeSteps) {
        settings.time_step = time_step;
        Experiment experiment(
            device, straightStrand(kHangingSegments, kHangingLength, kHangingDown), settings);
        const auto frequency = measureFrequency(
            experiment, {.shape = shape,
                         .segment = segment,
                         .direction = kHangingDown,
                         .sideways = kHangingSideways,
                         .expected_frequency = 1.0 / period});
        std::optional<double> tolerance;
        if (solver == hair::Solver::shape || solver == hair::Solver::rod)
            tolerance = kHangingTolerance;
        Outcome& outcome = findings.compare(
            {"first period",
             "s",
             {{"segments", double{kHangingSegments}, "count"},
              {"length", kHangingLength, "m"},
              {"time_step", time_step, "s"}}},
            frequency ? 1.0 / *frequency : std::numeric_limits<double>::quiet_NaN(), period,
            tolerance);
        if (!frequency) outcome.reason = "it does not swing";
    }
}

namespace {

// ---- Large swings of a chain --------------------------------------------------------------------

// A chain of equal links is released at rest in the shape of its first mode, with the lowest link
// at a large angle. The reference integrates the equations of the same links and masses in double
// precision: benchmarks/physics/kirchhoff.h. Both are limp, so only the masses matter.

constexpr std::uint32_t kSwingSegments = 16;
constexpr double kSwingLength = 0.3;  // m
constexpr double kSwingAngle = kPi / 3.0;  // of the lowest link
constexpr double kSwingTime = 2.5;  // s
constexpr float kSwingRates[] = {60.0f, 240.0f, 960.0f};  // steps per second
// Step of the reference, s. The fastest mode has 170/s, so a step is off by (w h)^5 / 120, 4e-8.
constexpr double kSwingStep = 5e-4;
// Implicit Euler at 1/480 s takes (w h)^2 / 3 from a frequency, 1e-4. It also takes w^2 h of the
// energy per second: the amplitude of the first period falls by 3 %, and a swing of 60 degrees,
// 7 % slower than a small one, becomes faster by 0.4 %. The rest is for stretch.
constexpr double kSwingTolerance = 0.01;

// The period, s, between the first and the third crossing of the sum of horizontal displacements,
// `interval` s apart.
double periodOf(std::span<const double> samples, double interval) {
    std::vector<double> crossings;
    for (std::size_t i = 1; i < samples.size(); ++i) {
        const double a = samples[i - 1];
        const double b = samples[i];
        if ((a < 0.0) != (b < 0.0))
            crossings.push_back((static_cast<double>(i - 1) + a / (a - b)) * interval);
    }
    return crossings.size() < 3 ? std::numeric_limits<double>::quiet_NaN()
                                : crossings[2] - crossings[0];
}

// The angles of the first mode's links, scaled to kSwingAngle.
std::vector<double> swingingAngles() {
    std::vector<double> shape =
        pendulumModes(kSwingSegments, kSwingLength / kSwingSegments, kGravity).front().shape;
    shape.insert(shape.begin(), 0.0);  // the root
    std::vector<double> angles;
    for (std::size_t i = 1; i < shape.size(); ++i) angles.push_back(shape[i] - shape[i - 1]);
    const double steepest = std::ranges::max(angles);
    for (double& angle : angles) angle *= kSwingAngle / steepest;
    return angles;
}

template <class Points>
double sumOfX(const Points& points) {
    double sum = 0.0;
    for (const auto& point : points) sum += point.x;
    return sum;
}

}  // namespace

void checkLargeSwing(
    const engine::Device& device, const CheckedSolver& solver, Findings& findings) {
    hair::SimulationSettings settings = chain(solver, kSwingLength);
    PlanarRod links = planarHair(settings, kSwingSegments, kSwingLength);
    links.stiffness = 0.0;
    if (!lack(solver, Need::equal_masses)) links.masses.back() = links.masses.front();
    std::vector<double> angles = swingingAngles();
    std::vector<glm::dvec3> start;
    for (const glm::dvec2& point : planarPoints(links, angles)) start.emplace_back(point, 0.0);
    std::vector<double> rates(angles.size(), 0.0);
    std::vector<double> sums;
    for (double time = 0.0; time < kSwingTime; time += kSwingStep) {
        advancePlanar(links, angles, rates, kSwingStep);
        sums.push_back(sumOfX(planarPoints(links, angles)));
    }
    const double expected = periodOf(sums, kSwingStep);

    for (const float rate : kSwingRates) {
        settings.time_step = 1.0f / rate;
        Experiment experiment(
            device, straightStrand(kSwingSegments, kSwingLength, {0.0, -1.0, 0.0}), settings);
        experiment.place(start);
        sums.clear();
        for (std::uint32_t i = 0; i < experiment.stepsIn(kSwingTime); ++i) {
            experiment.advance(1);
            sums.push_back(sumOfX(experiment.positions()));
        }
        const double period = periodOf(sums, experiment.timeStep());
        std::optional<double> tolerance;
        if (solver != hair::Solver::ftl) tolerance = kSwingTolerance;
        Outcome& outcome = findings.compare(
            {"first period",
             "s",
             {{"angle of the tip", kSwingAngle * 180.0 / kPi, "deg"},
              {"segments", double{kSwingSegments}, "count"},
              {"time_step", settings.time_step, "s"}}},
            period, expected, tolerance);
        if (!std::isfinite(period)) outcome.reason = "it does not swing";
    }
}

namespace {

// ---- Length -------------------------------------------------------------------------------------

constexpr double kStretchTolerance = 0.01;  // share of the worst segment's length, promised for all
                                            // solvers except `ftl`

}  // namespace

void checkLength(const engine::Device& device, const CheckedSolver& solver, Findings& findings) {
    const hair::SimulationSettings settings = livelyHair(solver);
    const hair::groom::Groom groom = livelyGroom();
    const double rest = kLivelyLength / groom.segmentsPerStrand();
    Experiment experiment(device, groom, settings);

    std::vector<double> errors;  // of every segment after every step
    double greatest = 0.0;
    double squares = 0.0;
    for (std::uint32_t step = 0; step < experiment.stepsIn(2.0); ++step) {
        experiment.advance(1);
        const std::vector<glm::dvec3> points = experiment.positions();
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (i % groom.vertices_per_strand == 0) continue;
            errors.push_back(std::abs(glm::distance(points[i], points[i - 1]) / rest - 1.0));
            greatest = worst(greatest, errors.back());
            squares += errors.back() * errors.back();
        }
    }
    const std::vector<Parameter> parameters{{"time_step", experiment.timeStep(), "s"}};
    std::optional<double> tolerance;
    if (solver != hair::Solver::ftl) tolerance = kStretchTolerance;
    findings.deviation(
        {"greatest error of a segment's length", "1", parameters}, greatest, tolerance);
    findings.deviation(
        {"99th percentile", "1", parameters},
        std::isnan(greatest) ? greatest : report::quantile(errors, 0.99));
    findings.deviation(
        {"root mean square", "1", parameters},
        std::sqrt(squares / static_cast<double>(errors.size())));
}

namespace {

// ---- Pendulum -----------------------------------------------------------------------------------

constexpr double kPendulumLink = 0.05;  // m
// w h. Projection along the predicted links lowers the frequency by (w h)^2 / 3, 8e-4. A much
// smaller step would measure single precision instead. For a hanging link, the part of a correction
// along the link is lost below the rounding of the position, while the part across it still counts.
constexpr double kPhasePerStep = 0.05;
// The effect of projection above, the amplitude's (6e-5), and about as much again for rounding.
constexpr double kPendulumTolerance = 0.005;

constexpr glm::dvec3 kPendulumDown{0.0, -1.0, 0.0};
constexpr glm::dvec3 kPendulumSideways{1.0, 0.0, 0.0};

}  // namespace

void checkPendulum(
    const engine::Device& device, const CheckedSolver& solver, std::span<const unsigned> masses,
    Findings& findings) {
    if (const auto why = lack(solver, Need::equal_masses)) return findings.skip(*why);
    for (const unsigned count : masses) {
        hair::SimulationSettings settings = chain(solver, count * kPendulumLink);
        settings.substeps = 1;
        unsigned number = 0;
        for (PendulumMode& mode : pendulumModes(count, kPendulumLink, kGravity)) {
            settings.time_step = static_cast<float>(kPhasePerStep / (2.0 * kPi * mode.frequency));
            mode.shape.insert(mode.shape.begin(), 0.0);  // the root
            Experiment experiment(
                device, straightStrand(count, count * kPendulumLink, kPendulumDown), settings);
            const auto frequency = measureFrequency(
                experiment, {.shape = mode.shape,
                             .segment = kPendulumLink,
                             .direction = kPendulumDown,
                             .sideways = kPendulumSideways,
                             .expected_frequency = mode.frequency});
            std::optional<double> tolerance;
            if (solver == hair::Solver::shape) tolerance = kPendulumTolerance;
            Outcome& outcome = findings.compare(
                {"frequency",
                 "Hz",
                 {{"masses", static_cast<double>(count), "count"},
                  {"mode", static_cast<double>(++number), "count"}}},
                frequency.value_or(std::numeric_limits<double>::quiet_NaN()), mode.frequency,
                tolerance);
            if (!frequency) outcome.reason = "it does not swing";
        }
    }
}

namespace {

// ---- Projectile ---------------------------------------------------------------------------------

// n steps of Verlet in single precision at up to 4 m sum to about 1.5e-4 m of rounding, or 3e-5 of
// the drop (a random walk of velocity, 0.3 ulp a step). The tolerance is three times that.
constexpr double kProjectileTolerance = 1e-4;

}  // namespace

void checkProjectile(
    const engine::Device& device, const CheckedSolver& solver, Findings& findings) {
    if (const auto why = lack(solver, Need::free_vertices)) return findings.skip(*why);

    hair::SimulationSettings settings = freeHair(solver);
    settings.time_step = 1.0f / 240.0f;
    settings.local.iterations = 0;
    settings.length.iterations = 0;
    Experiment experiment(device, straightStrand(1, 0.15, {0.0, -1.0, 0.0}), settings);

    const glm::dvec3 velocity{1.0, 3.0, -2.0};
    const glm::dvec3 start = experiment.positions()[1];
    experiment.launch(experiment.positions(), std::vector<glm::dvec3>{glm::dvec3(0.0), velocity});
    const std::uint32_t steps = experiment.stepsIn(1.0);
    const std::uint32_t part = 24;
    double farthest = 0.0;
    for (std::uint32_t n = part; n <= steps; n += part) {
        experiment.advance(part);
        const glm::dvec3 flown = verletFlight(n, velocity, settings.gravity, experiment.substep());
        farthest = worst(farthest, glm::distance(experiment.positions()[1], start + flown));
    }
    const double drop = 0.5 * kGravity;  // in 1 s
    findings.deviation(
        {"deviation from the parabola / drop", "1", {{"time_step", experiment.timeStep(), "s"}}},
        farthest / drop, kProjectileTolerance);
}

namespace {

// ---- Bending frequency --------------------------------------------------------------------------

constexpr std::uint32_t kBendingSegments = 32;
constexpr double kBendingLength = 0.1;  // m
constexpr float kBendingTimeStep = 0.0005f;  // s; implicit steps damp by w h / 2 = 0.3 % per radian
constexpr double kBendingTolerance = 0.02;  // promised for rods that are solved, not corrected

constexpr glm::dvec3 kBendingAlong{1.0, 0.0, 0.0};
constexpr glm::dvec3 kBendingSideways{0.0, 1.0, 0.0};

}  // namespace

void checkBendingFrequency(
    const engine::Device& device, const CheckedSolver& solver, Findings& findings) {
    if (const auto why = lack(solver, Need::bending)) return findings.skip(*why);
    hair::SimulationSettings settings = freeHair(solver);
    settings.gravity = {};
    settings.time_step = kBendingTimeStep;
    settings.substeps = 1;
    const double expected = cantileverFrequency(
        bendingStiffness(settings.material), lineDensity(settings.material), kBendingLength);
    std::vector<double> shape;
    for (std::uint32_t i = 0; i <= kBendingSegments; ++i)
        shape.push_back(cantileverShape(static_cast<double>(i) / kBendingSegments));

    Experiment experiment(
        device, straightStrand(kBendingSegments, kBendingLength, kBendingAlong), settings);
    const auto frequency = measureFrequency(
        experiment, {.shape = shape,
                     .segment = kBendingLength / kBendingSegments,
                     .direction = kBendingAlong,
                     .sideways = kBendingSideways,
                     .expected_frequency = expected});
    std::optional<double> tolerance;
    if (solver == hair::Solver::rod || solver == hair::Solver::stable_cosserat)
        tolerance = kBendingTolerance;
    Outcome& outcome = findings.compare(
        {"first frequency",
         "Hz",
         {{"segments", double{kBendingSegments}, "count"}, {"length", kBendingLength, "m"}}},
        frequency.value_or(std::numeric_limits<double>::quiet_NaN()), expected, tolerance);
    if (!frequency) outcome.reason = "it does not swing";
}

namespace {

// ---- Bending decay ------------------------------------------------------------------------------

// Kelvin-Voigt damping takes w^2 damping / 2 per second from a mode of w rad/s. A substep changes
// that by at most w^2 substep damping / 4, 0.8 %, and 32 segments swing 0.1 % too slowly.
constexpr double kDecayTolerance = 0.03;
constexpr double kHalfLives[] = {0.25, 2.0};  // s
constexpr float kDecayRates[] = {60.0f, 240.0f, 480.0f};  // steps per second
constexpr double kDecaySpeed = 0.02;  // of the tip, m/s
constexpr int kDecaySamples = 12;  // a quarter of a period apart

// Decay rate of a free oscillation, 1/s, by least squares of y[k + 1] = s y[k] - d y[k - 1], where
// d is exp(-2 rate interval).
double decayRateOf(std::span<const double> samples, double interval) {
    double yy = 0.0;
    double yz = 0.0;
    double zz = 0.0;
    double yx = 0.0;
    double zx = 0.0;
    for (std::size_t i = 1; i + 1 < samples.size(); ++i) {
        const double z = -samples[i - 1];
        yy += samples[i] * samples[i];
        yz += samples[i] * z;
        zz += z * z;
        yx += samples[i] * samples[i + 1];
        zx += z * samples[i + 1];
    }
    return -std::log((yy * zx - yz * yx) / (yy * zz - yz * yz)) / (2.0 * interval);
}

}  // namespace

namespace {

// The rate of a clamped hair of this length in its first mode, rad/s, without weight.
double firstMode(const hair::MaterialSettings& material, double length) {
    return 2.0 * kPi *
           cantileverFrequency(bendingStiffness(material), lineDensity(material), length);
}

// Decay rate of its vibration on the device, 1/s.
double vibrationsDecay(
    const engine::Device& device, const hair::SimulationSettings& settings, double length) {
    std::vector<glm::dvec3> velocities;
    for (std::uint32_t i = 0; i <= kBendingSegments; ++i)
        velocities.push_back(
            kDecaySpeed * cantileverShape(static_cast<double>(i) / kBendingSegments) *
            kBendingSideways);
    Experiment experiment(
        device, straightStrand(kBendingSegments, length, kBendingAlong), settings);
    experiment.launch(experiment.positions(), velocities);
    const std::uint32_t every =
        experiment.stepsIn(0.5 * kPi / firstMode(settings.material, length));
    std::vector<double> samples;
    for (int i = 0; i < kDecaySamples; ++i) {
        experiment.advance(every);
        samples.push_back(experiment.positions().back().y);
    }
    return decayRateOf(samples, every * experiment.timeStep());
}

// The integrators themselves damp a short hair. Implicit Euler multiplies a mode of w by
// 1 / (1 - i w h) in a substep, so it decays with ln(1 + w^2 h^2) / 2 h. The second-order method
// leaves only the material's damping.
constexpr double kShortLength = 0.07;  // m
constexpr double kShortDamping = 0.002;  // s, of the material, for the second-order method

void checkNumericalDecay(
    const engine::Device& device, hair::SimulationSettings settings, Findings& findings) {
    const double rate = firstMode(settings.material, kShortLength);
    settings.time_step = 1.0f / 480.0f;
    settings.material.damping = 0.0f;
    settings.rod.integrator = hair::RodIntegrator::implicit_euler;
    const double phase = rate * double{settings.time_step};
    findings.compare(
        {"decay with implicit_euler without damping",
         "1/s",
         {{"length", kShortLength, "m"}, {"time_step", settings.time_step, "s"}}},
        vibrationsDecay(device, settings, kShortLength),
        std::log1p(phase * phase) / (2.0 * double{settings.time_step}), kDecayTolerance);
    settings.material.damping = static_cast<float>(kShortDamping);
    settings.rod.integrator = hair::RodIntegrator::generalized_alpha;
    findings.compare(
        {"decay with generalized_alpha",
         "1/s",
         {{"length", kShortLength, "m"},
          {"damping", kShortDamping, "s"},
          {"time_step", settings.time_step, "s"}}},
        vibrationsDecay(device, settings, kShortLength), rate * rate * kShortDamping / 2.0,
        kDecayTolerance);
}

}  // namespace

void checkBendingDecay(
    const engine::Device& device, const CheckedSolver& solver, Findings& findings) {
    if (solver != hair::Solver::rod) return findings.skip("it has no damping of its material");
    hair::SimulationSettings settings = freeHair(solver);
    settings.gravity = {};
    const double rate_of_mode = firstMode(settings.material, kBendingLength);
    for (const auto& [integrator, name] :
         {std::pair{hair::RodIntegrator::implicit_euler, "half-life with implicit_euler"},
          std::pair{hair::RodIntegrator::generalized_alpha, "half-life with generalized_alpha"}})
        for (const double half_life : kHalfLives)
            for (const float rate : kDecayRates) {
                settings.rod.integrator = integrator;
                settings.time_step = 1.0f / rate;
                settings.material.damping = static_cast<float>(
                    2.0 * std::log(2.0) / (rate_of_mode * rate_of_mode * half_life));
                findings.compare(
                    {name,
                     "s",
                     {{"damping", settings.material.damping, "s"},
                      {"time_step", settings.time_step, "s"}}},
                    std::log(2.0) / vibrationsDecay(device, settings, kBendingLength), half_life,
                    kDecayTolerance);
            }
    checkNumericalDecay(device, settings, findings);
}

namespace {

// ---- A turning head -----------------------------------------------------------------------------

// Hair hangs from a head that turns steadily about the vertical. In the turning frame it is a rod
// under its weight and an acceleration away from the axis, in a plane. It starts in that rod's
// state at rest, moving with the head, and should stay there. Nothing damps it.

constexpr double kTurningRate = 8.0;  // rad/s
constexpr double kTurningRadius = 0.09;  // m, of the root from the axis
constexpr double kTurningLengths[] = {0.07, 0.1, 0.15};  // m
constexpr std::uint32_t kTurningSegments = 32;
constexpr double kTurningInterval = 0.1;  // s between keyframes; the head starts during the first
constexpr double kTurningStart = 0.2;  // s
constexpr double kTurningTime = 2.0;  // s
constexpr float kTurningRates[] = {60.0f, 240.0f, 1920.0f};  // steps per second
// A part of the length. Segments are off by their square, 1e-3. Implicit Euler takes forces at the
// end of a substep h, so hair lags as if the acceleration w^2 r were turned by the angle w h: by
// 0.017 at 1/480 s. As the acceleration is about that of the weight, the tip lags by about as much
// of the length. Hair that starts without lag swings about it.
constexpr double kTurningTolerance = 0.005;  // promised for `rod` with generalized_alpha

glm::dvec3 turned(const glm::dvec3& point, double angle) {
    return {
        point.x * std::cos(angle) + point.z * std::sin(angle), point.y,
        point.z * std::cos(angle) - point.x * std::sin(angle)};
}

// The greatest and the mean distance of the tip from where it started, m, in the head's frame.
struct Strayed {
    double farthest;
    double mean;
};

Strayed strayOnTurningHead(
    const engine::Device& device, hair::SimulationSettings settings,
    std::span<const glm::dvec2> rest, double length) {
    for (int i = 0; i * kTurningInterval < kTurningStart + kTurningTime + 1.0; ++i)
        settings.motion.keyframes.push_back(
            {.time = static_cast<float>(i * kTurningInterval),
             .rotation =
                 {0.0f, static_cast<float>(i * kTurningInterval * kTurningRate * 180.0 / kPi),
                  0.0f},
             .translation = {}});
    hair::groom::Groom groom = straightStrand(kTurningSegments, length, {0.0, -1.0, 0.0});
    for (glm::vec3& point : groom.points) point.x += static_cast<float>(kTurningRadius);
    Experiment experiment(device, groom, settings);
    std::uint32_t steps = experiment.stepsIn(kTurningStart);
    experiment.advance(steps);
    const auto angle = [&] { return kTurningRate * steps * experiment.timeStep(); };
    std::vector<glm::dvec3> points, velocities;
    for (const glm::dvec2& point : rest) {
        points.push_back(turned({point, 0.0}, angle()));
        velocities.push_back(kTurningRate * glm::cross(glm::dvec3(0.0, 1.0, 0.0), points.back()));
    }
    experiment.launch(points, velocities);
    Strayed strayed{.farthest = 0.0, .mean = 0.0};
    const glm::dvec3 start(rest.back(), 0.0);
    glm::dvec3 sum(0.0);
    const std::uint32_t every = experiment.stepsIn(1.0 / 60.0);
    const std::uint32_t samples = experiment.stepsIn(kTurningTime) / every;
    for (std::uint32_t i = 0; i < samples; ++i) {
        experiment.advance(every);
        steps += every;
        const glm::dvec3 tip = turned(experiment.positions().back(), -angle());
        strayed.farthest = worst(strayed.farthest, glm::distance(tip, start));
        sum += tip;
    }
    strayed.mean = glm::distance(sum / static_cast<double>(samples), start);
    return strayed;
}

double substepOf(const hair::SimulationSettings& settings) {
    return double{settings.time_step} / hair::simulation::stepOf(settings).count;
}

void compareTurning(
    const engine::Device& device, hair::SimulationSettings settings, const std::string& prefix,
    Findings& findings) {
    for (const double length : kTurningLengths) {
        PlanarRod rod = planarHair(settings, kTurningSegments, length);
        if (lack(settings.solver, Need::bending)) rod.stiffness = 0.0;
        rod.root = {kTurningRadius, 0.0};
        rod.field = [](const glm::dvec2& point) {
            return glm::dvec2(kTurningRate * kTurningRate * point.x, -kGravity);
        };
        const auto rest = planarRest(rod, std::vector<double>(kTurningSegments, 0.3));
        if (!rest) {
            findings.fail("the rod's state at rest is not found");
            continue;
        }
        for (const float rate : kTurningRates) {
            settings.time_step = 1.0f / rate;
            const Strayed strayed =
                strayOnTurningHead(device, settings, planarPoints(rod, *rest), length);
            const std::vector<Parameter> parameters{
                {"length", length, "m"}, {"time_step", settings.time_step, "s"}};
            findings.deviation(
                {prefix + "tip's greatest distance from the turning rod / length", "1", parameters},
                strayed.farthest / length);
            findings.deviation(
                {prefix + "tip's mean distance from the turning rod / length", "1", parameters},
                strayed.mean / length,
                settings.solver != hair::Solver::rod ? std::nullopt
                : settings.rod.integrator == hair::RodIntegrator::generalized_alpha
                    ? std::optional(kTurningTolerance)
                    : std::optional(kTurningTolerance + kTurningRate * substepOf(settings)));
        }
    }
}

}  // namespace

void checkTurningHead(
    const engine::Device& device, const CheckedSolver& solver, Findings& findings) {
    hair::SimulationSettings settings = freeHair(solver);
    compareTurning(device, settings, "", findings);
    if (solver == hair::Solver::shape)
        compareTurning(device, withEnergy(settings), "with an energy, ", findings);
    if (solver != hair::Solver::rod) return;
    settings.rod.integrator = hair::RodIntegrator::generalized_alpha;
    compareTurning(device, settings, "with generalized_alpha, ", findings);
}

}  // namespace benchmarks::physics
