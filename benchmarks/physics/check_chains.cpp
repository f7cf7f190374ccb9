#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <glm/geometric.hpp>

#include "benchmarks/physics/checks.h"
#include "benchmarks/physics/experiment.h"
#include "benchmarks/physics/kirchhoff.h"
#include "benchmarks/physics/theory.h"
#include "benchmarks/report/statistics.h"

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

}  // namespace benchmarks::physics
