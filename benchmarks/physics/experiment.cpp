#include "benchmarks/physics/experiment.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "benchmarks/measure/measure.h"
#include "benchmarks/scene/extensions.h"
#include "engine/commands.h"
#include "engine/process.h"
#include "engine/transfer.h"
#include "hair/simulation/solvers.h"
#include "hair/simulation/stiffness.h"

namespace benchmarks::physics {

CheckedSolver::CheckedSolver(const std::string& path)
    : solver(hair::Solver::extension), file(path) {
    hair::Settings settings;
    settings.simulation.solver = solver;
    settings.simulation.solver_file = path;
    settings = scene::withExtensions(settings, {});
    scene::checkExtensions(settings);
    parameters = settings.simulation.solver_parameters;
}

namespace {

// ---- Strands and their simulation ---------------------------------------------------------------

constexpr std::uint32_t kBatch = 64;  // steps per submission
constexpr std::uint32_t kSeed = 1;

std::vector<glm::vec3> toFloat(std::span<const glm::dvec3> points) {
    return {points.begin(), points.end()};
}

hair::groom::Groom groomOf(const std::vector<glm::dvec3>& points) {
    return {
        .strand_count = 1,
        .vertices_per_strand = static_cast<std::uint32_t>(points.size()),
        .points = toFloat(points),
        .root_normals = {},
        .root_triangles = {}};
}

bool hasWind(const hair::WindSettings& wind) {
    return wind.mode == hair::WindMode::drag || wind.strength != 0.0f;
}

}  // namespace

hair::groom::Groom
straightStrand(std::uint32_t segments, double length, const glm::dvec3& direction) {
    std::vector<glm::dvec3> points;
    for (std::uint32_t i = 0; i <= segments; ++i)
        points.push_back(length * i / segments * direction);
    return groomOf(points);
}

hair::groom::Groom straightStrands(
    std::uint32_t segments, std::span<const double> lengths, const glm::dvec3& direction) {
    hair::groom::Groom groom = straightStrand(segments, 1.0, direction);
    const std::vector<glm::vec3> points = std::move(groom.points);
    groom.strand_count = static_cast<std::uint32_t>(lengths.size());
    groom.points.clear();
    for (const double length : lengths)
        for (const glm::vec3& point : points)
            groom.points.push_back(static_cast<float>(length) * point);
    return groom;
}

hair::groom::Groom curvedStrand(std::uint32_t segments, double length, double curvature) {
    std::vector<glm::dvec3> points;
    for (std::uint32_t i = 0; i <= segments; ++i) {
        const double angle = curvature * length * i / segments;
        points.emplace_back((1.0 - std::cos(angle)) / curvature, -std::sin(angle) / curvature, 0.0);
    }
    return groomOf(points);
}

Experiment::Experiment(
    const engine::Device& device, const hair::groom::Groom& groom,
    const hair::SimulationSettings& settings, std::span<const hair::groom::Mesh> field_meshes)
    : device_(&device), settings_(settings),
      substep_(double{settings.time_step} / hair::simulation::stepOf(settings).count),
      simulation_(device, groom, settings, kSeed, field_meshes) {}

void Experiment::advance(std::uint32_t steps) {
    // Hair-hair contact adds to the accelerations of the air.
    const bool wind = hasWind(settings_.wind) || simulation_.hasVolume();
    while (steps > 0) {
        engine::checkInterrupted();
        const std::uint32_t batch = std::min(steps, kBatch);
        runOnce(*device_, [&](engine::Commands& commands) {
            for (std::uint32_t i = 0; i < batch; ++i) {
                if (wind) simulation_.recordWind(commands);
                if (simulation_.hasVolume()) simulation_.recordVolume(commands);
                simulation_.recordStep(commands);
            }
        });
        steps -= batch;
    }
}

bool Experiment::settle(double distance, double seconds) {
    const std::uint32_t look = stepsIn(0.1);
    std::vector<glm::dvec3> before = positions();
    for (std::uint32_t i = 0; i < stepsIn(seconds); i += look) {
        advance(look);
        std::vector<glm::dvec3> now = positions();
        if (greatestDistance(now, before) <= distance) return true;
        before = std::move(now);
    }
    return false;
}

void Experiment::place(std::span<const glm::dvec3> positions) {
    const std::vector<glm::vec3> points = toFloat(positions);
    simulation_.setState(points, points);
}

void Experiment::launch(
    std::span<const glm::dvec3> positions, std::span<const glm::dvec3> velocities) {
    std::vector<glm::vec3> previous;
    for (std::size_t i = 0; i < positions.size(); ++i)
        previous.emplace_back(positions[i] - substep_ * velocities[i]);
    simulation_.setState(toFloat(positions), previous);
}

void Experiment::pin(std::span<const std::uint32_t> vertices) { simulation_.pin(vertices); }

std::vector<glm::dvec3> Experiment::positions() const {
    const std::vector<glm::vec3> points = simulation_.readPositions();
    return {points.begin(), points.end()};
}

std::uint32_t Experiment::stepsIn(double seconds) const {
    return std::max(1u, static_cast<std::uint32_t>(std::lround(seconds / timeStep())));
}

double greatestDistance(std::span<const glm::dvec3> a, std::span<const glm::dvec3> b) {
    double greatest = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        greatest = worst(greatest, glm::distance(a[i], b[i]));
    return greatest;
}

namespace {

// ---- Settings of the solvers --------------------------------------------------------------------

// Weight over stiffness of a rod that hangs like a chain: it bends within L / sqrt(Gamma) of the
// clamp, a thousandth of its length.
constexpr double kChainGamma = 1e6;

struct Lack {
    hair::Solver solver;
    Need need;
    const char* reason;
};

constexpr Lack kLacks[] = {
    {hair::Solver::ftl, Need::free_vertices,
     "every segment keeps its length: no vertex flies freely"},
    {hair::Solver::rod, Need::free_vertices,
     "every segment keeps its length: no vertex flies freely"},
    {hair::Solver::stable_cosserat, Need::free_vertices,
     "its segments are springs: no vertex flies freely"},
    {hair::Solver::position_based_rod, Need::free_vertices,
     "its segments are springs: no vertex flies freely"},
    {hair::Solver::augmented_mass_spring, Need::free_vertices,
     "its segments are springs: no vertex flies freely"},
    {hair::Solver::ftl, Need::pinned_tip,
     "it places vertices from the root down and can't hold the tip"},
    {hair::Solver::rod, Need::equal_masses, "it is made of heavy segments: see hanging_chain"},
    {hair::Solver::stable_cosserat, Need::equal_masses,
     "it is made of heavy segments: see hanging_chain"},
    {hair::Solver::position_based_rod, Need::equal_masses,
     "it is made of heavy segments: see hanging_chain"},
    {hair::Solver::augmented_mass_spring, Need::equal_masses,
     "it is made of heavy segments: see hanging_chain"},
    {hair::Solver::ftl, Need::bending, "it has no bending stiffness"},
    {hair::Solver::ftl, Need::material, "it has no bending stiffness"},
    {hair::Solver::shape, Need::material, "its stiffness is not that of a material"},
    {hair::Solver::shape, Need::sections, "its stiffness is not that of a material"},
    {hair::Solver::ftl, Need::sections, "it has no bending stiffness"},
    {hair::Solver::stable_cosserat, Need::sections, "its cross-sections are round"},
    {hair::Solver::position_based_rod, Need::sections, "its cross-sections are round"},
    {hair::Solver::augmented_mass_spring, Need::material,
     "its stiffness is not that of a material"},
    {hair::Solver::augmented_mass_spring, Need::sections,
     "its stiffness is not that of a material"},
    {hair::Solver::ftl, Need::iterations, "it has no iterations"},
    {hair::Solver::extension, Need::free_vertices, "no setting frees the vertices of a file"},
    {hair::Solver::extension, Need::equal_masses, "its masses are its own"},
    {hair::Solver::extension, Need::sections, "its cross-sections are its own"},
    {hair::Solver::extension, Need::iterations, "its iterations are its own"},
};

// The Gamma of a hair of this length; see lengthOf().
double gammaOf(const hair::MaterialSettings& material, double length) {
    return lineDensity(material) * kGravity * std::pow(length, 3.0) / bendingStiffness(material);
}

}  // namespace

hair::SimulationSettings defaultHair(const CheckedSolver& solver) {
    hair::SimulationSettings settings;
    settings.solver = solver;
    settings.solver_file = solver.file;
    settings.solver_parameters = solver.parameters;
    settings.gravity = {0.0f, static_cast<float>(-kGravity), 0.0f};
    if (solver.adjust != nullptr) solver.adjust(settings);
    return settings;
}

hair::SimulationSettings freeHair(const CheckedSolver& solver) {
    hair::SimulationSettings settings = defaultHair(solver);
    settings.friction = 0.0f;
    settings.global.stiffness = 0.0f;
    return settings;
}

hair::SimulationSettings chain(const CheckedSolver& solver, double length) {
    hair::SimulationSettings settings = freeHair(solver);
    settings.local = {.stiffness = 0.0f, .iterations = 0};
    settings.augmented_mass_spring.integrity = 0.0f;
    settings.augmented_mass_spring.angular_stiffness = 0.0f;
    const double softer = gammaOf(settings.material, length) / kChainGamma;
    settings.material.youngs_modulus *= static_cast<float>(softer);
    settings.material.shear_modulus *= static_cast<float>(softer);
    return settings;
}

// K = EI / (lambda l^4). hair/simulation/stiffness.h has it as -4 * 10 ln(1 - k) / (2 h0^2) at
// segments of l0.
hair::SimulationSettings withEnergy(hair::SimulationSettings settings) {
    const double square = std::pow(hair::simulation::kReferenceStep, 2.0);
    const double stiffness = bendingStiffness(settings.material) / lineDensity(settings.material) /
                             std::pow(hair::simulation::kReferenceSegment, 4.0);
    settings.local.method = hair::LocalMethod::energy;
    settings.local.stiffness = static_cast<float>(-std::expm1(-square * stiffness / 20.0));
    return settings;
}

float frictionOf(double rate) {
    return static_cast<float>(-std::expm1(-rate * hair::simulation::kReferenceStep));
}

double lengthOf(const hair::MaterialSettings& material, double gamma) {
    return std::cbrt(gamma * bendingStiffness(material) / (lineDensity(material) * kGravity));
}

double bendingStiffness(const hair::MaterialSettings& material) {
    return double{material.youngs_modulus} * kPi / 4.0 * std::pow(double{material.radius}, 4.0);
}

double lineDensity(const hair::MaterialSettings& material) {
    return wetDensity(material) * kPi * std::pow(double{material.radius}, 2.0);
}

std::optional<std::string> lack(hair::Solver solver, Need need) {
    for (const Lack& each : kLacks)
        if (each.solver == solver && each.need == need) return each.reason;
    return {};
}

void setIterations(hair::SimulationSettings& settings, std::uint32_t iterations) {
    settings.local.iterations = iterations;
    settings.length.iterations = iterations;
    settings.rod.iterations = iterations;
    settings.stable_cosserat.iterations = iterations;
    settings.position_based_rod.iterations = iterations;
    settings.augmented_mass_spring.iterations = iterations;
}

// ---- Lively hair --------------------------------------------------------------------------------

hair::SimulationSettings livelyHair(const CheckedSolver& solver) {
    hair::SimulationSettings settings = defaultHair(solver);
    settings.wind.strength = 15.0f;  // the thesis's strongest
    settings.motion.keyframes = {
        {.time = 0.0f},
        {.time = 0.4f, .rotation = {0.0f, 60.0f, 0.0f}, .translation = {}},
        {.time = 0.8f, .rotation = {0.0f, -60.0f, 0.0f}, .translation = {0.1f, 0.0f, 0.0f}},
        {.time = 1.2f, .rotation = {40.0f, 0.0f, 0.0f}, .translation = {0.0f, -0.05f, 0.0f}},
        {.time = 1.6f}};
    return settings;
}

hair::groom::Groom livelyGroom() {
    constexpr std::uint32_t kStrands = 16;
    const hair::groom::Groom one = straightStrand(7, kLivelyLength, {0.0, -1.0, 0.0});
    hair::groom::Groom groom = one;
    groom.strand_count = kStrands;
    groom.points.clear();
    for (std::uint32_t strand = 0; strand < kStrands; ++strand)
        for (const glm::vec3& point : one.points)
            groom.points.push_back(
                point + glm::vec3(0.01f * static_cast<float>(strand), 0.1f, 0.0f));
    return groom;
}

namespace {

// ---- Release from the horizontal ----------------------------------------------------------------

constexpr std::uint32_t kPoints = 8;

// Tolerance, as a fraction of a step, for an integer number of steps: the step's length is rounded.
constexpr double kNoFraction = 1e-3;

}  // namespace

std::vector<glm::dvec3> eighthsOf(std::span<const glm::dvec3> points) {
    std::vector<glm::dvec3> some;
    for (std::size_t i = 0; i < points.size(); i += points.size() / kPoints)
        some.push_back(points[i]);
    return some;
}

Trajectory sampleTrajectory(Experiment& experiment) {
    Trajectory trajectory;
    std::uint32_t step = 0;
    const auto goTo = [&](std::uint32_t target) {
        experiment.advance(target - step);
        step = target;
        return eighthsOf(experiment.positions());
    };
    for (int i = 1; i <= kTrajectorySamples; ++i) {
        const double steps = i * kTrajectoryInterval / experiment.timeStep();
        const auto whole = static_cast<std::uint32_t>(steps + kNoFraction);
        std::vector<glm::dvec3> sample = goTo(whole);
        const double fraction = steps - whole;
        if (fraction > kNoFraction) {
            const std::vector<glm::dvec3> next = goTo(whole + 1);
            for (std::size_t point = 0; point < sample.size(); ++point)
                sample[point] = glm::mix(sample[point], next[point], fraction);
        }
        trajectory.push_back(std::move(sample));
    }
    return trajectory;
}

Trajectory playRelease(
    const engine::Device& device, const hair::SimulationSettings& settings,
    std::uint32_t segments) {
    Experiment experiment(
        device, straightStrand(segments, kTrajectoryLength, {1.0, 0.0, 0.0}), settings);
    return sampleTrajectory(experiment);
}

Trajectory restTrajectory(
    const engine::Device& device, const hair::SimulationSettings& settings, std::uint32_t segments,
    double seconds) {
    Experiment experiment(
        device, straightStrand(segments, kTrajectoryLength, {0.0, -1.0, 0.0}), settings);
    experiment.settle(1e-7, seconds);
    return {eighthsOf(experiment.positions())};
}

double differenceOf(const Trajectory& a, const Trajectory& b) {
    if (a.size() != b.size()) return std::nan("");
    double greatest = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        greatest = worst(greatest, greatestDistance(a[i], b[i]));
    return greatest / kTrajectoryLength;
}

}  // namespace benchmarks::physics
