#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "benchmarks/physics/checks.h"
#include "benchmarks/physics/experiment.h"
#include "benchmarks/physics/kirchhoff.h"
#include "benchmarks/physics/theory.h"
#include "hair/simulation/hair_hair.h"
#include "hair/simulation/solvers.h"
#include "hair/simulation/stiffness.h"

namespace benchmarks::physics {
namespace {

// Two bundles that cross far from their roots, without other forces: the momentum that one gains,
// the other loses. Their position relative to the grid's cells is varied, because the error of
// repulsion depends on it.

constexpr std::uint32_t kAcross = 5;  // strands of a bundle, each way
constexpr std::uint32_t kCrossingVertices = 33;
constexpr double kCrossingLength = 0.2;  // m
constexpr double kCrossingSpacing = 0.004;  // m
constexpr int kPlacements = 8;
constexpr double kClosing = 0.5;  // m/s, of each bundle towards the other
// Positions are rounded to 3e-8 m, a part in 10^5 of the change by friction in a step. The error of
// the grids' integers is smaller.
constexpr double kFrictionTolerance = 1e-4;

// One along x and one along z, meeting at their middles.
hair::groom::Groom crossing(double offset) {
    hair::groom::Groom groom{.vertices_per_strand = kCrossingVertices};
    for (int bundle = 0; bundle < 2; ++bundle)
        for (std::uint32_t row = 0; row < kAcross; ++row)
            for (std::uint32_t column = 0; column < kAcross; ++column) {
                ++groom.strand_count;
                for (std::uint32_t i = 0; i < kCrossingVertices; ++i) {
                    const double along =
                        kCrossingLength * (static_cast<double>(i) / (kCrossingVertices - 1) - 0.5);
                    const double beside =
                        kCrossingSpacing * (static_cast<double>(row) - 0.5 * (kAcross - 1));
                    const double height = kCrossingSpacing * column + offset;
                    if (bundle == 0)
                        groom.points.emplace_back(along, height, beside);
                    else
                        groom.points.emplace_back(beside, height + kCrossingSpacing, along);
                }
            }
    return groom;
}

// The momentum gained in a step by all vertices except the roots, over the sum of its magnitudes.
double momentumLost(
    const engine::Device& device, const hair::SimulationSettings& settings, double offset,
    double closing) {
    const hair::groom::Groom groom = crossing(offset);
    const std::vector<double> shares = hair::simulation::lengthShares(groom);
    std::vector<glm::dvec3> points(groom.points.begin(), groom.points.end());
    std::vector<glm::dvec3> velocities(points.size(), {0.0, closing, 0.0});
    for (std::size_t i = points.size() / 2; i < points.size(); ++i) velocities[i] *= -1.0;
    Experiment experiment(device, groom, settings);
    experiment.launch(points, velocities);
    experiment.advance(1);
    const std::vector<glm::dvec3> after = experiment.positions();
    glm::dvec3 sum(0.0);
    double total = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (i % kCrossingVertices == 0) continue;
        const glm::dvec3 gained = (after[i] - points[i]) / experiment.timeStep() - velocities[i];
        sum += shares[i] * gained;
        total += shares[i] * glm::length(gained);
    }
    return glm::length(sum) / total;
}

double worstPlacement(
    const engine::Device& device, const hair::SimulationSettings& settings, double closing) {
    // Covers one cell of a grid of this resolution. The grid extends 1.1 lengths beyond the strand
    // on every side.
    const double cell = 3.2 * kCrossingLength / settings.hair_hair.resolution;
    double lost = 0.0;
    for (int i = 0; i < kPlacements; ++i)
        lost = worst(lost, momentumLost(device, settings, cell * i / kPlacements, closing));
    return lost;
}

}  // namespace

void checkContactMomentum(
    const engine::Device& device, const CheckedSolver& solver, Findings& findings) {
    if (const auto why = lack(solver, Need::free_vertices)) return findings.skip(*why);
    hair::SimulationSettings settings = freeHair(solver);
    settings.gravity = glm::vec3(0.0f);
    settings.local.stiffness = 0.0f;
    settings.length.iterations = 0;
    settings.hair_hair.resolution = 64;
    settings.hair_hair.crowding = 1.2f;

    settings.hair_hair.friction = 0.5f;
    findings.deviation(
        {"momentum lost to friction / momentum exchanged", "1", {{"closing", kClosing, "m/s"}}},
        worstPlacement(device, settings, kClosing), kFrictionTolerance);
    settings.hair_hair.friction = 0.0f;
    settings.hair_hair.cohesion = 0.1f;
    findings.deviation(
        {"momentum lost to cohesion / momentum exchanged", "1", {{"closing", kClosing, "m/s"}}},
        worstPlacement(device, settings, kClosing), kFrictionTolerance);
    settings.hair_hair.cohesion = 0.0f;
    settings.hair_hair.attraction = 0.1f;
    findings.deviation(
        {"momentum lost to attraction / momentum exchanged", "1", {}},
        worstPlacement(device, settings, 0.0));
    settings.hair_hair.attraction = 0.0f;
    settings.hair_hair.repulsion = 0.5f;
    findings.deviation(
        {"momentum lost to repulsion / momentum exchanged", "1", {}},
        worstPlacement(device, settings, 0.0));
}

namespace {

// ---- Stick and slip -----------------------------------------------------------------------------

// The set-up of the stick-slip test of Romero et al. 2021, after Sano, Yamaguchi and Wada 2017. A
// weightless hair, clamped straight down above the ground, is pressed onto it. It buckles, its tip
// sticks, and it slips when the ground's force leaves the friction cone. The ground is a capsule
// along the buckling direction.

constexpr std::uint32_t kPressedSegments = 32;
constexpr double kPressedLength = 0.05;  // m
constexpr double kGroundRadius = 0.5;  // m
constexpr double kGroundLength = 0.2;  // m
constexpr double kPressingSpeed = 0.12;  // lengths per second; the hair's slowest period is 1/30 s
// Amplitude of the initial shape, rad. It is Euler's shape of the buckling column, because a
// straight hair has no preferred direction. The ground's force is then 0.033 off the vertical.
constexpr double kBuckledBy = 0.15;
// Critical damping for the slowest mode of the hair between clamp and hinge, 15.4 sqrt(EI / lambda)
// / L^2.
constexpr double kPressedFriction = 400.0;  // 1/s
constexpr float kPressedStep = 1.0f / 480.0f;  // s
// In the first substep no force holds the tip. It slides in proportion to the substep's square: at
// 1/480 s by 1 % of the length. That would be 16 % of the compression at the next slip.
constexpr std::uint32_t kPressedSubsteps = 4;
// Distance that counts as slip, over the length. Rounding moves a sticking tip by less.
constexpr double kSlipped = 2e-3;
// Coefficients of friction. From about 0.35 on, the hair lies on the ground beside its tip before
// it slips.
constexpr double kPressedFrictions[] = {0.1, 0.2, 0.3};
constexpr double kSticking = 1.0;  // coefficient without slip
// 32 segments are within 0.3 % of a rod's statics. The slip is seen one step late, and the
// compression is measured then: 5 % of the compression is 2 % of the ratio of the forces.
constexpr double kSlipTolerance = 0.05;
constexpr double kPressedTolerance = 0.02;  // of the length

struct Pressed {
    double compression;
    double slid;  // distance of the tip from its position after the first step, over the length
    glm::dvec2 middle;  // as in PressedRod
};

// A hair that has just buckled, between a clamp at (0, -compression) and its tip on the ground at
// (0, -1): psi = c (cos k z - cos k), tan k = k, with z from the tip. In units of its length.
std::vector<glm::dvec3> buckledColumn() {
    constexpr double kRoot = 4.493409457909064;
    std::vector<glm::dvec3> points{{0.0, -1.0, 0.0}};
    for (std::uint32_t i = 0; i < kPressedSegments; ++i) {
        const double z = (i + 0.5) / kPressedSegments;
        const double angle = kBuckledBy * (std::cos(kRoot * z) - std::cos(kRoot));
        points.push_back(
            points.back() +
            glm::dvec3(std::sin(angle), std::cos(angle), 0.0) / double{kPressedSegments});
    }
    std::ranges::reverse(points);
    return points;
}

// Presses a hair until `ends` returns true for its state, or until it is compressed by 0.35 of its
// length.
template <class Ends>
std::vector<Pressed> press(
    const engine::Device& device, hair::SimulationSettings settings, double friction,
    const Ends& ends) {
    std::vector<glm::dvec3> start = buckledColumn();
    // The shape is of first order, so its tip is off in third order. The clamp is moved above it.
    for (glm::dvec3& point : start) point.x -= start.front().x * (point.y + 1.0);
    constexpr double kMostCompression = 0.35;
    const double least = -start.front().y;
    const double time = (kMostCompression - least) / kPressingSpeed;  // s
    settings.gravity = {};
    settings.time_step = kPressedStep;
    settings.substeps = kPressedSubsteps;
    settings.friction = frictionOf(kPressedFriction);
    settings.collision.friction = static_cast<float>(friction);
    const auto depth = static_cast<float>(-kPressedLength - kGroundRadius);
    const auto reach = static_cast<float>(kGroundLength / 2.0);
    settings.colliders = {
        {.a = {-reach, depth, 0.0f},
         .b = {reach, depth, 0.0f},
         .radius = static_cast<float>(kGroundRadius),
         .follows = hair::Follows::world}};
    const auto pressedBy = [](double compression) {
        return glm::dvec3(0.0, -compression * kPressedLength, 0.0);
    };
    settings.motion.keyframes = {
        {.time = 0.0f, .rotation = {}, .translation = pressedBy(least)},
        {.time = static_cast<float>(time),
         .rotation = {},
         .translation = pressedBy(kMostCompression)}};
    Experiment experiment(
        device, straightStrand(kPressedSegments, kPressedLength, {0.0, -1.0, 0.0}), settings);
    for (glm::dvec3& point : start) point *= kPressedLength;
    experiment.place(start);
    std::vector<Pressed> states;
    experiment.advance(1);
    const glm::dvec3 touched = experiment.positions().back();
    for (std::uint32_t i = 1; i < experiment.stepsIn(time); ++i) {
        experiment.advance(1);
        const std::vector<glm::dvec3> points = experiment.positions();
        const glm::dvec3 middle = points[kPressedSegments / 2] / kPressedLength;
        states.push_back(
            {.compression = -points[0].y / kPressedLength,
             .slid = glm::distance(points.back(), touched) / kPressedLength,
             .middle = {std::hypot(middle.x, middle.z), middle.y + 1.0}});
        if (ends(states.back())) break;
    }
    return states;
}

// ---- Friction -----------------------------------------------------------------------------------

// Two bundles that interpenetrate and slide lengthwise. Every cell has equal shares of both, so
// friction with the rate r, exp(-r / 60 s) = 1 - setting, drags each towards the mean velocity.
// Without other forces, the velocity difference decays as exp(-r t). If one bundle is held and the
// other falls, it falls at 2 g / r. The ends stick out and are omitted; their influence extends
// over some cells.

constexpr std::uint32_t kSlidingStrands = 3;  // per bundle
constexpr std::uint32_t kSlidingVertices = 65;
constexpr double kSlidingLength = 0.2;  // m
constexpr double kSlidingSpeed = 0.05;  // m/s, of each bundle
constexpr double kSlidingTime = 1.0 / 15.0;  // s
constexpr float kSlidingFriction = 0.5f;
constexpr double kSlidingRates[] = {30.0, 60.0, 120.0, 480.0};  // time steps, 1/s
// Friction settings for the falling hair, and its weight. It is slow, so that it moves only some
// cells.
constexpr float kFallingFrictions[] = {0.5f, 0.8f};
constexpr double kFallingWeight = 1.0;  // m/s^2
constexpr double kFallingTime = 0.5;  // s; over ten times the time to reach the final speed
// Floats of 0.1 m are rounded to 4e-9 m, which at 1/480 s is 1e-3 of the lowest speed. Vertices are
// less than half a cell apart, and their splines deviate from a constant density by 2e-3.
constexpr double kSlidingTolerance = 5e-3;

hair::SimulationSettings slidingHair(const CheckedSolver& solver, float friction, double rate) {
    hair::SimulationSettings settings = freeHair(solver);
    settings.gravity = glm::vec3(0.0f);
    settings.local.stiffness = 0.0f;
    settings.length.iterations = 0;
    settings.hair_hair.resolution = 64;
    settings.hair_hair.friction = friction;
    settings.time_step = static_cast<float>(1.0 / rate);
    return settings;
}

hair::groom::Groom slidingGroom() {
    hair::groom::Groom groom{
        .strand_count = 2 * kSlidingStrands, .vertices_per_strand = kSlidingVertices};
    for (std::uint32_t strand = 0; strand < groom.strand_count; ++strand)
        for (std::uint32_t i = 0; i < kSlidingVertices; ++i)
            groom.points.emplace_back(
                0.0, kSlidingLength * (0.5 - static_cast<double>(i) / (kSlidingVertices - 1)), 0.0);
    return groom;
}

// Mean velocities along y of the two bundles' middle thirds, over the experiment's next step.
std::array<double, 2> slidingVelocities(Experiment& experiment) {
    const std::vector<glm::dvec3> before = experiment.positions();
    experiment.advance(1);
    const std::vector<glm::dvec3> after = experiment.positions();
    std::array<double, 2> velocities{};
    constexpr std::uint32_t kFirst = kSlidingVertices / 3;
    constexpr std::uint32_t kLast = kSlidingVertices - kFirst;
    for (std::uint32_t strand = 0; strand < 2 * kSlidingStrands; ++strand)
        for (std::uint32_t i = kFirst; i < kLast; ++i) {
            const std::size_t vertex = std::size_t{strand} * kSlidingVertices + i;
            velocities[strand / kSlidingStrands] += (after[vertex].y - before[vertex].y) /
                                                    experiment.timeStep() /
                                                    (kSlidingStrands * (kLast - kFirst));
        }
    return velocities;
}

double frictionRate(float setting) {
    return -std::log1p(-double{setting}) / hair::simulation::kReferenceStep;
}

// ---- Layers -------------------------------------------------------------------------------------

// Layers of straight hair on others that are held, without weight, driven along themselves. A layer
// of the height h on a slip surface with the stress tau rests up to the drive tau / (rho h), and
// beyond it slides with the rest of the drive, whatever its speed. Strands are rows of vertices on
// a lattice; each root is so far from the next vertex that it shares no cell with others.

constexpr std::uint32_t kLayerFiles = 8;
constexpr std::uint32_t kHeldLayers = 8;
constexpr std::uint32_t kLayerVertices = 16;
constexpr std::uint32_t kLayerGap = 8;  // spacings between the root and the next vertex
constexpr double kLayerSpacing = 0.005;  // m
constexpr float kLayerFriction = 5.0f;
constexpr std::uint32_t kThinLayers = 2;
constexpr std::uint32_t kThickLayers = 8;
constexpr double kLayerRates[] = {60.0, 240.0};  // time steps, 1/s
// Steps until hair slides steadily, and as many in which it is measured. Thick layers at rest need
// longer, because each step carries stress on by a cell.
constexpr std::uint32_t kLayerSteps = 20;
constexpr std::uint32_t kHeldSteps = 200;
// Distance that the greatest drive would move free layers until the end, spacings: less than a
// cell. The weakest drive moves them by floats' rounding of 1e-8 m a hundred times in a step.
constexpr double kLayerWay = 1.5;
// Drives over that at which the slip surface yields. hair_hair.h has the stress's error on a grid.
constexpr double kLayerDrives[] = {0.8, 1.25, 2.5};
constexpr double kStressTolerance = 0.12;
// Its elastic stress needs some steps to balance the drive.
constexpr double kHeldTolerance = 0.01;
// Near the yield stress, layers should stop and not creep. The yield stress itself is within a
// twentieth of theory here. Speeds are rounded to some 1e-7 m/s, 1e-5 of the free speed.
constexpr double kNearDrives[] = {0.95};
constexpr double kNearTime = 2.0;  // s
constexpr double kCreepShare = 1e-4;

struct Layers {
    std::uint32_t free;  // layers that move
    double rate;  // 1/s
    bool pressed;  // friction in hair under pressure, instead of cohesion
    std::uint32_t held_steps;
    std::span<const double> drives = kLayerDrives;
    double held_tolerance = kHeldTolerance;
};

hair::groom::Groom layersOf(std::uint32_t free) {
    hair::groom::Groom groom{
        .strand_count = (kHeldLayers + free) * kLayerFiles,
        .vertices_per_strand = kLayerVertices + 1};
    for (std::uint32_t layer = 0; layer < kHeldLayers + free; ++layer)
        for (std::uint32_t file = 0; file < kLayerFiles; ++file)
            for (std::uint32_t i = 0; i <= kLayerVertices; ++i) {
                const std::uint32_t along = i == 0 ? 0 : kLayerGap + i - 1;
                groom.points.emplace_back(
                    kLayerSpacing * along, kLayerSpacing * layer, kLayerSpacing * file);
            }
    return groom;
}

// The mean of 1 - crowded / share over the places where both bodies of hair touch: cells, by the
// product of both bodies' shares over their sum. `first`: vertices of the first body.
double crowdingBetween(
    const hair::groom::Groom& groom, std::size_t first, const hair::HairHairSettings& settings) {
    const hair::simulation::VolumeGrid grid =
        hair::simulation::volumeGrid(groom, settings.resolution);
    const std::vector<double> shares = hair::simulation::lengthShares(groom);
    const double crowded =
        double{settings.crowding} * hair::simulation::meanRestDensity(groom, grid);
    const auto spline = [](double t) {
        const double tail = std::max(1.5 - std::abs(t), 0.0);
        return std::abs(t) < 0.5 ? 0.75 - t * t : 0.5 * tail * tail;
    };
    const std::size_t side = grid.resolution;
    std::vector<std::array<double, 2>> cells(side * side * side);
    for (std::size_t p = 0; p < groom.points.size(); ++p) {
        const glm::dvec3 point = (glm::dvec3(groom.points[p]) - grid.origin) / grid.cell;
        const glm::ivec3 middle(point);
        for (int i = 0; i < 27; ++i) {
            const glm::ivec3 cell = middle + glm::ivec3(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
            const glm::dvec3 away = point - glm::dvec3(cell) - 0.5;
            cells[(cell.z * side + cell.y) * side + cell.x][p < first ? 0 : 1] +=
                shares[p] * spline(away.x) * spline(away.y) * spline(away.z);
        }
    }
    double sum = 0.0;
    double weights = 0.0;
    for (const auto& [a, b] : cells) {
        if (a <= 0.0 || b <= 0.0) continue;
        weights += a * b / (a + b);
        sum += a * b / (a + b) * std::max(1.0 - crowded / (a + b), 0.0);
    }
    return sum / weights;
}

void compareLayers(
    const engine::Device& device, const CheckedSolver& solver, const Layers& layers,
    Findings& findings) {
    const hair::groom::Groom groom = layersOf(layers.free);
    const std::size_t held_vertices =
        std::size_t{kHeldLayers} * kLayerFiles * groom.vertices_per_strand;
    hair::SimulationSettings settings = freeHair(solver);
    settings.local.stiffness = 0.0f;
    settings.length.iterations = 0;
    settings.substeps = 1;
    settings.time_step = static_cast<float>(1.0 / layers.rate);
    settings.hair_hair.resolution = 40;
    settings.hair_hair.crowding = 0.1f;
    const double height = layers.free * kLayerSpacing;
    const double time = 2.0 * (kLayerSteps + 1) / layers.rate;
    const double wanted =
        2.0 * kLayerWay * kLayerSpacing / (time * time) * height / kLayerDrives[2];  // m^2/s^2
    if (layers.pressed) {
        settings.hair_hair.friction_coefficient = kLayerFriction;
        settings.hair_hair.repulsion = static_cast<float>(wanted) / kLayerFriction;
    } else {
        settings.hair_hair.cohesion = static_cast<float>(wanted);
    }
    const double strength = double{settings.hair_hair.cohesion} +
                            double{settings.hair_hair.repulsion} *
                                double{settings.hair_hair.friction_coefficient} *
                                crowdingBetween(groom, held_vertices, settings.hair_hair);
    std::vector<std::uint32_t> held(held_vertices);
    std::iota(held.begin(), held.end(), 0u);
    const std::vector<double> shares = hair::simulation::lengthShares(groom);
    // The mean velocity of free hair along the drive in the next step.
    const auto speed = [&](Experiment& experiment) {
        const std::vector<glm::dvec3> before = experiment.positions();
        experiment.advance(1);
        const std::vector<glm::dvec3> after = experiment.positions();
        double moved = 0.0;
        double whole = 0.0;
        for (std::size_t i = held_vertices; i < shares.size(); ++i) {
            if (i % groom.vertices_per_strand == 0) continue;
            moved += shares[i] * (after[i].x - before[i].x);
            whole += shares[i];
        }
        return moved / whole / experiment.timeStep();
    };
    for (const double part : layers.drives) {
        const double drive = part * strength / height;
        settings.gravity = {static_cast<float>(drive), 0.0f, 0.0f};
        Experiment experiment(device, groom, settings);
        experiment.pin(held);
        const std::vector<Parameter> with{
            {"layers", static_cast<double>(layers.free), "count"},
            {"cohesion", settings.hair_hair.cohesion, "m^2/s^2"},
            {"repulsion", settings.hair_hair.repulsion, "m^2/s^2"},
            {"time_step", 1.0 / layers.rate, "s"},
            {"drive", part, "1"}};
        if (part < 1.0) {
            experiment.advance(layers.held_steps);
            findings.deviation(
                {"speed of hair that cohesion or friction holds / its free speed", "1", with},
                std::abs(speed(experiment)) /
                    (drive * (layers.held_steps + 1) * experiment.timeStep()),
                layers.held_tolerance);
            continue;
        }
        experiment.advance(kLayerSteps);
        const double last = speed(experiment);
        experiment.advance(kLayerSteps);
        const double later = speed(experiment);
        const double acceleration = (later - last) / ((kLayerSteps + 1) * experiment.timeStep());
        findings.compare(
            {"stress on a slip surface between hairs / density", "m^2/s^2", with},
            (drive - acceleration) * height, strength, kStressTolerance);
    }
}

// ---- Wet hair -----------------------------------------------------------------------------------

// Two hairs hang beside each other, without weight, and water joins them from the tips up (Bico,
// Roman, Moulin and Boudaoud 2004, Elastocapillary coalescence in wet hair). A pair gains the
// energy F per joined length, each hair bends with the stiffness B, and the clamps are d apart. The
// energy of the part that is not joined, 3 B d^2 / L^3 + F L, is least at L = (9 B d^2 / F)^(1/4),
// where each hair's curvature at the clamp is sqrt(F / B). On the grid hairs attract each other
// before they touch: the pair's energy is that of the grid's spline, and the rest shape follows
// from it alone.

constexpr std::uint32_t kWetSegments = 64;
constexpr double kWetLength = 0.08;  // m
constexpr std::uint32_t kWetResolution = 64;
constexpr double kWetStep = 1.0 / 1000.0;  // s
constexpr double kWetRate = 30.0;  // friction, 1/s
constexpr double kWetPatience = 4.0;  // s
// A row of cells has 0.55^2 of a strand on average, and up to 2 * 0.75^2 where two strands lie on
// each other: 3.7 times as much. They attract each other like strands that are not crowded.
constexpr float kWetCrowding = 4.0f;
struct WetPair {
    double distance;  // m
    double attraction;  // m^2/s^2
};
// Distances of 2.3 and 3.4 cells.
constexpr WetPair kWetPairs[] = {{0.008, 1.0}, {0.008, 0.25}, {0.012, 0.25}};
// Places of a lone hair, which moves the grid by up to half a cell beside the pair. It is too far
// away to attract it.
constexpr double kLoneHairs[] = {0.03, 0.0315};  // m
// The energy of two splines on two grids varies with their place by 2 %, so L by a quarter of that;
// the mirrored hair's slope adds up to 0.2 in a hundred, and 64 segments the same.
constexpr double kWetTolerance = 0.01;
// The spline's range, over the distance, makes L longer than with water that only acts on contact:
// by 4.9 % at 2.3 cells and 2.5 % at 3.4 in the equations of thin beams.
constexpr double kBicoTolerance = 0.06;
// Masses of water over that of the hair.
constexpr float kWater[] = {0.5f, 2.0f};
constexpr double kDryGamma = 5.0;
constexpr double kBalancedGamma = 0.1;  // of dry hair

// The quintic B-spline as a difference of truncated powers, and its slope.
double quinticSlope(double t) {
    constexpr double kBinomials[] = {1.0, 6.0, 15.0, 20.0, 15.0, 6.0, 1.0};
    double sum = 0.0;
    for (int i = 0; i < 7; ++i)
        sum += (i % 2 == 0 ? 1.0 : -1.0) * kBinomials[i] *
               std::pow(std::max(t + 3.0 - i, 0.0), 4.0) / 24.0;
    return sum;
}
constexpr double kQuinticTop = 0.55;

double bicoLength(const hair::MaterialSettings& material, const WetPair& pair) {
    return std::pow(
        9.0 * bendingStiffness(material) * pair.distance * pair.distance /
            (pair.attraction * lineDensity(material)),
        0.25);
}

// One hair of the pair, whose other hair is its mirror image.
PlanarRod wetRod(const hair::SimulationSettings& settings, const WetPair& pair, double cell) {
    PlanarRod rod = planarHair(settings, kWetSegments, kWetLength);
    rod.root = {pair.distance / 2.0, 0.0};
    rod.field = [=](const glm::dvec2& at) {
        return glm::dvec2(
            pair.attraction / kQuinticTop / cell * quinticSlope(2.0 * at.x / cell), 0.0);
    };
    return rod;
}

// Angles of a hair that joins its mirror image over `length`: that of the beam that is clamped at
// both ends.
std::vector<double> joinedAngles(double distance, double length) {
    std::vector<double> angles;
    for (std::uint32_t i = 0; i < kWetSegments; ++i) {
        const double s = std::min((i + 0.5) * kWetLength / kWetSegments / length, 1.0);
        angles.push_back(-std::asin(3.0 * distance / length * s * (1.0 - s)));
    }
    return angles;
}

void comparePair(
    const engine::Device& device, const CheckedSolver& solver, const WetPair& pair, double lone,
    Findings& findings) {
    hair::SimulationSettings settings = freeHair(solver);
    settings.gravity = {};
    settings.time_step = static_cast<float>(kWetStep);
    settings.friction = frictionOf(kWetRate);
    settings.hair_hair.attraction = static_cast<float>(pair.attraction);
    settings.hair_hair.crowding = kWetCrowding;
    settings.hair_hair.resolution = kWetResolution;
    hair::groom::Groom groom = straightStrand(kWetSegments, kWetLength, {0.0, -1.0, 0.0});
    const std::vector<glm::vec3> one = std::move(groom.points);
    groom.points.clear();
    groom.strand_count = 3;
    for (const double x : {pair.distance / 2.0, -pair.distance / 2.0, lone})
        for (const glm::vec3& point : one)
            groom.points.push_back(point + glm::vec3(static_cast<float>(x), 0.0f, 0.0f));
    const double cell = hair::simulation::volumeGrid(groom, kWetResolution).cell;
    const double theory = bicoLength(settings.material, pair);
    const double segment = kWetLength / kWetSegments;

    const PlanarRod rod = wetRod(settings, pair, cell);
    const std::vector<double> guess = joinedAngles(pair.distance, theory);
    const auto rest = planarRest(rod, guess);
    double expected = std::numeric_limits<double>::quiet_NaN();
    if (rest) {
        std::vector<double> apart;
        for (const glm::dvec2& point : planarPoints(rod, *rest)) apart.push_back(2.0 * point.x);
        expected = joiningLength(apart, pair.distance, segment);
    }

    Experiment experiment(device, groom, settings);
    std::vector<glm::dvec3> points = experiment.positions();
    const std::vector<glm::dvec2> joined = planarPoints(rod, guess);
    for (std::size_t i = 0; i < joined.size(); ++i) {
        points[i] = {joined[i].x, joined[i].y, 0.0};
        points[i + joined.size()] = {-joined[i].x, joined[i].y, 0.0};
    }
    experiment.place(points);
    const bool still = experiment.settle(1e-6, kWetPatience);
    points = experiment.positions();
    std::vector<double> apart;
    for (std::size_t i = 0; i < joined.size(); ++i)
        apart.push_back(glm::distance(points[i], points[i + joined.size()]));
    const double measured = joiningLength(apart, pair.distance, segment);
    const auto promised = [&](double tolerance) {
        return solver == hair::Solver::rod ? std::optional(tolerance) : std::nullopt;
    };
    const std::vector<Parameter> with{
        {"distance", pair.distance, "m"},
        {"attraction", pair.attraction, "m^2/s^2"},
        {"cell", cell, "m"},
        {"place", lone, "m"}};
    Outcome& outcome = findings.compare(
        {"length over which wet hairs join", "m", with}, measured, expected,
        promised(kWetTolerance));
    if (!still) outcome.reason = "still moving";
    findings.compare(
        {"the same against water that acts on contact", "m", with}, measured, theory,
        promised(kBicoTolerance));
}

// ---- Slide --------------------------------------------------------------------------------------

// A limp hair lies across a slope with its whole length and slides down. The slope is a level
// capsule, whose incline grows on the way; the plane side of a field; or the level top of a capsule
// on a head that accelerates sideways by A, so that gravity is sqrt(g^2 + A^2) at atan(A / g) from
// the vertical. On the first two the head moves the root as theory says. On the last the root stays
// in its place on the capsule. The tip is 7 segments away and moves by less than half of one.
// Finally a hair slides over a level field until friction has stopped it.

enum class Slope { capsule, field, moving_head };

constexpr const char* kSlopeNames[] = {"capsule", "field", "moving head"};
constexpr std::uint32_t kSlidingSegments = 8;
constexpr double kSlidingHair = 0.1;  // m
constexpr double kSlopeRadius = 0.5;  // m
constexpr double kSlideTime = 0.1;  // s
constexpr double kLeashedSlide = 0.005;  // m, with a root that stays
constexpr double kRestTime = 0.5;  // s
constexpr double kSlopes[] = {10.0, 30.0, 60.0};  // degrees
// Friction over the tangent of the slope: at the last one it rests.
constexpr double kShares[] = {0.0, 0.5, 0.9, 1.05};
constexpr double kSlideSteps[] = {1.0 / 60.0, 1.0 / 240.0, 1.0 / 1920.0};  // s
// Positions are rounded to 7.5e-9 m, and a vertex starts within that of the surface or off it.
constexpr double kSlideTolerance = 0.02;
constexpr double kStillTolerance = 1e-3;  // of the length
constexpr double kThrown = 0.2;  // m/s, along the level field
constexpr double kStoppingFriction = 0.5;
// A vertex may come to rest one substep early or late. Its displacement in that substep is less
// than friction's, mu g h^2.

// In a step of 1/60 s hair falls into the slope by up to 2.7 mm, a fifth of a segment. `shape` and
// `ftl` then correct lengths, which moves hair along the slope before friction acts.
std::optional<double> slidePromise(const CheckedSolver& solver, bool rests, double step) {
    double longest = 1.0;  // s
    if (solver == hair::Solver::ftl || solver == hair::Solver::shape) longest = 1.0 / 200.0;
    if (solver == hair::Solver::shape && !rests) longest = 1.0 / 1000.0;
    if (step > longest) return {};
    return rests ? kStillTolerance : kSlideTolerance;
}

struct Incline {
    Slope slope;
    double angle;  // rad
    double friction;
    double step;  // s
};

// A box of half a metre with its upper side through the origin, which falls by `angle` towards +x.
hair::groom::Mesh tiltedBox(double angle) {
    constexpr double kHalf = 0.25;  // m
    hair::groom::Mesh mesh;
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 corner{
            i & 1 ? kHalf : -kHalf, i & 2 ? 0.0 : -2.0 * kHalf, i & 4 ? kHalf : -kHalf};
        mesh.positions.emplace_back(
            corner.x * std::cos(angle) + corner.y * std::sin(angle),
            corner.y * std::cos(angle) - corner.x * std::sin(angle), corner.z);
    }
    mesh.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
    return mesh;
}

struct Slid {
    double measured;  // m, of the tip
    double expected;
    double substep = 0.0;  // s
};

// Plays the hair for kSlideTime, or for kRestTime if it should rest.
Slid slide(
    const engine::Device& device, hair::SimulationSettings settings, const Incline& incline) {
    const bool rests = incline.friction >= std::tan(incline.angle);
    const bool on_head = incline.slope == Slope::moving_head;
    const double gravity = on_head ? kGravity / std::cos(incline.angle) : kGravity;
    const double radius =
        incline.slope == Slope::field ? std::numeric_limits<double>::infinity() : kSlopeRadius;
    settings.time_step = static_cast<float>(incline.step);
    settings.collision.friction = static_cast<float>(incline.friction);
    settings.collision.margin = 0.0f;
    const double substep = incline.step / hair::simulation::stepOf(settings).count;
    // Hair that falls freely by implicit Euler's method or Verlet's has fallen n (n + 1) / 2 g h^2
    // after n substeps h, as at the time sqrt(n (n + 1)) h.
    const auto reached = [&](double time) { return std::sqrt(time * (time + substep)); };
    const auto expected = [&](double time) {
        return slideDistance(gravity, incline.angle, radius, incline.friction, reached(time));
    };
    double time = rests ? kRestTime : kSlideTime;
    if (on_head && !rests)
        while (time > incline.step && expected(time) > kLeashedSlide) time /= 2.0;
    time = incline.step * std::max(1.0, std::round(time / incline.step));

    const double angle = on_head ? 0.0 : incline.angle;
    const auto placeAt = [&](double distance) {
        if (incline.slope == Slope::field)
            return distance * glm::dvec3(std::cos(angle), -std::sin(angle), 0.0);
        const double there = angle + distance / radius;
        return radius *
               glm::dvec3(
                   std::sin(there) - std::sin(angle), std::cos(there) - std::cos(angle), 0.0);
    };
    const double acceleration = gravity * std::sin(incline.angle);  // of the moving head
    const auto headAt = [&](double at) {
        if (on_head) return glm::dvec3(-acceleration / 2.0 * at * (at + substep), 0.0, 0.0);
        return placeAt(expected(at));
    };
    for (std::uint32_t i = 0; !(rests && !on_head) && i * substep < time + incline.step; ++i)
        settings.motion.keyframes.push_back(
            {.time = static_cast<float>(i * substep),
             .rotation = {},
             .translation = headAt(i * substep)});
    std::vector<hair::groom::Mesh> meshes;
    if (incline.slope == Slope::field) {
        settings.distance_fields = {
            {.mesh = "", .resolution = 16, .follows = hair::Follows::world}};
        meshes.push_back(tiltedBox(angle));
    } else {
        const glm::dvec3 axis = -radius * glm::dvec3(std::sin(angle), std::cos(angle), 0.0);
        constexpr double kReach = 2.0 * kSlidingHair;
        settings.colliders = {
            {.a = axis - glm::dvec3(0.0, 0.0, kReach),
             .b = axis + glm::dvec3(0.0, 0.0, kReach),
             .radius = static_cast<float>(radius),
             .follows = on_head ? hair::Follows::head : hair::Follows::world}};
    }
    Experiment experiment(
        device, straightStrand(kSlidingSegments, kSlidingHair, {0.0, 0.0, 1.0}), settings, meshes);
    const std::uint32_t steps = experiment.stepsIn(time);
    experiment.advance(steps);
    const glm::dvec3 from{0.0, 0.0, kSlidingHair};
    glm::dvec3 tip = experiment.positions().back();
    if (on_head) tip -= headAt(steps * incline.step);
    if (rests) return {glm::distance(tip, from), 0.0};
    tip -= from;
    const double chord = glm::length(glm::dvec2(tip.x, tip.y));
    return {
        incline.slope == Slope::field ? chord : 2.0 * radius * std::asin(chord / (2.0 * radius)),
        expected(steps * incline.step)};
}

// The distance in m that a hair slides over a level field, and that of theory in substeps h, which
// is the sum of (v - n mu g h) h while it is positive.
Slid stop(const engine::Device& device, hair::SimulationSettings settings, double step) {
    settings.time_step = static_cast<float>(step);
    settings.collision.friction = static_cast<float>(kStoppingFriction);
    settings.collision.margin = 0.0f;
    settings.distance_fields = {{.mesh = "", .resolution = 16, .follows = hair::Follows::world}};
    const std::array meshes{tiltedBox(0.0)};
    const hair::groom::Groom groom =
        straightStrand(kSlidingSegments, kSlidingHair, {0.0, 0.0, 1.0});
    Experiment experiment(device, groom, settings, meshes);
    const std::vector<glm::dvec3> points = experiment.positions();
    experiment.launch(points, std::vector<glm::dvec3>(points.size(), {kThrown, 0.0, 0.0}));
    experiment.advance(experiment.stepsIn(kRestTime));
    const double h = experiment.substep();
    double expected = 0.0;
    for (double speed = kThrown; (speed -= kStoppingFriction * kGravity * h) > 0.0;)
        expected += speed * h;
    return {experiment.positions().back().x, expected, h};
}

}  // namespace

void checkSlide(const engine::Device& device, const CheckedSolver& solver, Findings& findings) {
    hair::SimulationSettings settings = chain(solver, kSlidingHair);
    for (const bool warm_start : {false, true}) {
        if (warm_start && solver != hair::Solver::rod) continue;
        settings.collision.warm_start = warm_start;
        for (const Slope slope : {Slope::capsule, Slope::field, Slope::moving_head})
            for (const double degrees : kSlopes)
                for (const double share : kShares)
                    for (const double step : kSlideSteps) {
                        const double angle = degrees * kPi / 180.0;
                        const double friction = share * std::tan(angle);
                        const Slid slid = slide(device, settings, {slope, angle, friction, step});
                        std::vector<Parameter> with{
                            {"slope", degrees, "degrees"},
                            {"friction", friction, "1"},
                            {"time_step", step, "s"}};
                        if (solver == hair::Solver::rod)
                            with.push_back({"warm_start", warm_start ? 1.0 : 0.0, "count"});
                        const std::string on =
                            std::string(" on a ") + kSlopeNames[static_cast<std::size_t>(slope)];
                        if (slid.expected == 0.0)
                            findings.deviation(
                                {"distance that hair moves at rest" + on + " / length", "1", with},
                                slid.measured / kSlidingHair, slidePromise(solver, true, step));
                        else
                            findings.compare(
                                {"distance that hair slides" + on, "m", with}, slid.measured,
                                slid.expected, slidePromise(solver, false, step));
                    }
        for (const double step : kSlideSteps) {
            const Slid slid = stop(device, settings, step);
            const double last = kStoppingFriction * kGravity * slid.substep * slid.substep;
            std::vector<Parameter> with{
                {"friction", kStoppingFriction, "1"}, {"time_step", step, "s"}};
            if (solver == hair::Solver::rod)
                with.push_back({"warm_start", warm_start ? 1.0 : 0.0, "count"});
            findings.compare(
                {"distance after which friction stops hair", "m", with}, slid.measured,
                slid.expected, kSlideTolerance + last / slid.expected);
        }
    }
}

void checkStickSlip(const engine::Device& device, const CheckedSolver& solver, Findings& findings) {
    if (const auto why = lack(solver, Need::material)) return findings.skip(*why);
    hair::SimulationSettings settings = freeHair(solver);
    settings.collision.warm_start = solver == hair::Solver::rod;
    const auto promised = [&](double tolerance) {
        return solver == hair::Solver::rod ? std::optional(tolerance) : std::nullopt;
    };
    constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

    std::vector<std::vector<double>> rows;
    for (const double friction : kPressedFrictions) {
        const auto theory = pressedRod(friction);
        const std::vector<Pressed> states = press(
            device, settings, friction, [](const Pressed& at) { return !(at.slid < kSlipped); });
        const bool slipped = !(states.back().slid < kSlipped);
        Outcome& outcome = findings.compare(
            {"compression at which it slips", "1", {{"friction", friction, "1"}}},
            slipped ? states.back().compression : kNothing, theory ? theory->compression : kNothing,
            promised(kSlipTolerance));
        if (!slipped) outcome.reason = "it sticks";
        rows.push_back({friction, outcome.measured, outcome.expected.value_or(kNothing)});
    }
    findings.curve(
        "compression at which it slips", {{"friction", "1"}, {"measured", "1"}, {"theory", "1"}},
        std::move(rows));

    // With enough friction, the same hair continues along the same branch.
    const std::vector<Pressed> states =
        press(device, settings, kSticking, [](const Pressed&) { return false; });
    double slid = 0.0;
    for (const Pressed& at : states) slid = worst(slid, at.slid);
    findings.deviation(
        {"distance that the tip slides / length", "1", {{"friction", kSticking, "1"}}}, slid,
        promised(kSlipped));
    for (const double ratio : kPressedFrictions) {
        const auto theory = pressedRod(ratio);
        double off = kNothing;
        for (std::size_t i = 1; theory && i < states.size(); ++i)
            if (states[i].compression >= theory->compression &&
                states[i - 1].compression < theory->compression)
                off = glm::distance(states[i].middle, theory->middle);
        findings.deviation(
            {"middle's distance from the elastica / length",
             "1",
             {{"compression", theory ? theory->compression : kNothing, "1"}}},
            off, promised(kPressedTolerance));
    }
}

void checkHairFriction(
    const engine::Device& device, const CheckedSolver& solver, Findings& findings) {
    if (const auto why = lack(solver, Need::free_vertices)) return findings.skip(*why);
    for (const double rate : kLayerRates) {
        compareLayers(device, solver, {kThinLayers, rate, false, kLayerSteps}, findings);
        compareLayers(device, solver, {kThickLayers, rate, false, kHeldSteps}, findings);
        // Pressure parts the layers; it has no time for more than a tenth of a cell.
        compareLayers(device, solver, {kThinLayers, rate, true, kLayerSteps}, findings);
        const auto steps = static_cast<std::uint32_t>(kNearTime * rate);
        compareLayers(
            device, solver, {kThinLayers, rate, false, steps, kNearDrives, kCreepShare}, findings);
    }
}

void checkWetHair(const engine::Device& device, const CheckedSolver& solver, Findings& findings) {
    if (const auto why = lack(solver, Need::material)) return findings.skip(*why);
    const auto promised = [&](double tolerance) {
        return solver == hair::Solver::rod ? std::optional(tolerance) : std::nullopt;
    };
    hair::SimulationSettings settings = freeHair(solver);
    const double length = lengthOf(settings.material, kDryGamma);
    settings.friction = frictionOf(kWetRate);
    for (const float water : kWater) {
        settings.material.water = water;
        Experiment experiment(
            device, straightStrand(kWetSegments, length, {1.0, 0.0, 0.0}), settings);
        experiment.settle(1e-7, kWetPatience);
        const glm::dvec3 tip = experiment.positions().back();
        findings.compare(
            {"drop over reach of wet level hair",
             "1",
             {{"gamma of dry hair", kDryGamma, "1"}, {"water", water, "1"}}},
            -tip.y / tip.x, cantileverRatio(kDryGamma * (1.0 + double{water})), promised(0.02));
    }
    // Hair that hangs level when it is dry. The deflection of straight level hair under a small
    // load is an eighth of its gamma.
    if (solver == hair::Solver::rod) {
        settings.rest = hair::RestShape::balanced;
        settings.material.water = 1.0f;
        const double small = lengthOf(settings.material, 2.0 * kBalancedGamma);
        Experiment experiment(
            device, straightStrand(kWetSegments, small, {1.0, 0.0, 0.0}), settings);
        experiment.settle(1e-7, kWetPatience);
        findings.compare(
            {"sag of wet hair that hangs level when it is dry / length",
             "1",
             {{"gamma of dry hair", kBalancedGamma, "1"}, {"water", 1.0, "1"}}},
            -experiment.positions().back().y / small, kBalancedGamma / 8.0, 0.02);
    }
    for (const WetPair& pair : kWetPairs)
        for (const double lone : kLoneHairs) comparePair(device, solver, pair, lone, findings);
}

void checkFrictionInvariance(
    const engine::Device& device, const CheckedSolver& solver, Findings& findings) {
    if (const auto why = lack(solver, Need::free_vertices)) return findings.skip(*why);
    const hair::groom::Groom groom = slidingGroom();
    const std::vector<glm::dvec3> points(groom.points.begin(), groom.points.end());
    const std::size_t half = points.size() / 2;
    for (const double rate : kSlidingRates) {
        Experiment experiment(device, groom, slidingHair(solver, kSlidingFriction, rate));
        std::vector<glm::dvec3> velocities(points.size(), {0.0, kSlidingSpeed, 0.0});
        for (std::size_t i = half; i < points.size(); ++i) velocities[i] *= -1.0;
        experiment.launch(points, velocities);
        // The displacement of a vertex in the last step is its velocity at that step's end.
        experiment.advance(experiment.stepsIn(kSlidingTime) - 1);
        const auto [up, down] = slidingVelocities(experiment);
        findings.compare(
            {"difference of velocities that free hair keeps",
             "1",
             {{"time step", 1.0 / rate, "s"}}},
            (up - down) / (2.0 * kSlidingSpeed),
            std::exp(-frictionRate(kSlidingFriction) * kSlidingTime), kSlidingTolerance);
    }
    std::vector<std::uint32_t> held(half);
    std::iota(held.begin(), held.end(), 0u);
    for (const float friction : kFallingFrictions)
        for (const double rate : kSlidingRates)
            for (const std::uint32_t substeps : {1u, 4u}) {
                hair::SimulationSettings settings = slidingHair(solver, friction, rate);
                settings.gravity = {0.0f, static_cast<float>(-kFallingWeight), 0.0f};
                settings.substeps = substeps;
                Experiment experiment(device, groom, settings);
                experiment.pin(held);
                experiment.advance(experiment.stepsIn(kFallingTime) - 1);
                findings.compare(
                    {"speed at which hair slides down held hair",
                     "m/s",
                     {{"friction", friction, "1"},
                      {"time step", 1.0 / rate, "s"},
                      {"substeps", static_cast<double>(substeps), "1"}}},
                    -slidingVelocities(experiment)[1],
                    2.0 * kFallingWeight / frictionRate(friction), kSlidingTolerance);
            }
}

}  // namespace benchmarks::physics
