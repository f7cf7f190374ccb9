#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/device.h"
#include "hair/groom/groom.h"
#include "hair/groom/mesh/mesh.h"
#include "hair/settings.h"
#include "hair/simulation/simulation.h"

// A strand or groom under one solver, played step by step, and the settings of each check.
namespace benchmarks::physics {

inline constexpr double kPi = 3.14159265358979323846;

// A solver that is checked: one of the program's, or that of a GLSL file with the file's defaults.
struct CheckedSolver {
    CheckedSolver(hair::Solver built_in) : solver(built_in) {}
    // Reads and compiles the file. Throws engine::Error "<file>:<line>: <reason>".
    explicit CheckedSolver(const std::string& path);

    operator hair::Solver() const { return solver; }

    hair::Solver solver;
    std::string file;  // empty: one of the program's
    std::string variant;  // behind its name: settings other than the defaults
    void (*adjust)(hair::SimulationSettings&) = nullptr;  // makes these settings; null: none
    hair::ExtensionParameters parameters;
};

// A strand in `segments` equal segments from the origin along a unit vector, at rest. m
hair::groom::Groom
straightStrand(std::uint32_t segments, double length, const glm::dvec3& direction);

// Strands of these lengths from the origin along a unit vector. m
hair::groom::Groom straightStrands(
    std::uint32_t segments, std::span<const double> lengths, const glm::dvec3& direction);

// A strand of length `length` with constant curvature (1/m) from -y towards +x. Its vertices lie on
// the circle.
hair::groom::Groom curvedStrand(std::uint32_t segments, double length, double curvature);

// A groom in a simulation that is played step by step. Throws engine::Interrupted between
// submissions if the user asked to stop. Borrows the device.
class Experiment {
public:
    Experiment(
        const engine::Device& device, const hair::groom::Groom& groom,
        const hair::SimulationSettings& settings,
        std::span<const hair::groom::Mesh> field_meshes = {});

    void advance(std::uint32_t steps);

    // Plays steps until no vertex moves by more than `distance` in a tenth of a second. Returns
    // false if that takes longer than `seconds`.
    bool settle(double distance, double seconds);

    // Sets the positions, without velocity.
    void place(std::span<const glm::dvec3> positions);
    // Sets positions and velocities, both at one substep ago. m/s
    void launch(std::span<const glm::dvec3> positions, std::span<const glm::dvec3> velocities);
    void pin(std::span<const std::uint32_t> vertices);

    std::vector<glm::dvec3> positions() const;

    double timeStep() const { return settings_.time_step; }
    double substep() const { return substep_; }
    // Number of steps in this time, at least one.
    std::uint32_t stepsIn(double seconds) const;

private:
    const engine::Device* device_;
    hair::SimulationSettings settings_;
    double substep_;
    hair::simulation::Simulation simulation_;
};

// Greatest distance between points of the same index, m.
double greatestDistance(std::span<const glm::dvec3> a, std::span<const glm::dvec3> b);

// Displacement after n steps of Verlet's integration with the initial `velocity`: n v h + n (n + 1)
// / 2 a h^2, the sum of the displacements (v + m a h) h. This is exact; the true parabola has n^2.
inline glm::dvec3
verletFlight(double n, const glm::dvec3& velocity, const glm::dvec3& acceleration, double step) {
    return n * step * velocity + 0.5 * n * (n + 1.0) * step * step * acceleration;
}

inline constexpr double kLivelyLength = 0.15;  // m, the thesis's

// Default hair in strong wind on a head that shakes once and nods, for 2 s.
hair::SimulationSettings livelyHair(const CheckedSolver& solver);

// Sixteen hanging strands of the thesis's 8 vertices, 1 cm apart.
hair::groom::Groom livelyGroom();

// The set-up of each solver for comparison with theory, and its limits.

inline constexpr double kGravity = 9.81;  // m/s^2, down -y

// A hair with the default settings except for this gravity.
hair::SimulationSettings defaultHair(const CheckedSolver& solver);

// The hair with only its stiffness and weight: neither friction nor a pull to rest.
hair::SimulationSettings freeHair(const CheckedSolver& solver);

// A chain: segments keep their length, as well as the solver can, and do not resist bending. Rods
// always resist; their modulus is so small that strands up to `length` bend under their weight at
// once.
hair::SimulationSettings chain(const CheckedSolver& solver, double length);

// The hair with the energy method for the local constraint of `shape`. The stiffness is that of the
// material, so that theory predicts the same rest as for rods.
hair::SimulationSettings withEnergy(hair::SimulationSettings settings);

// Friction that reduces the velocity to exp(-rate) in 1 s. `rate` in 1/s.
float frictionOf(double rate);

// The length, m, of a hair with this Gamma = rho g S L^3 / EI = 4 rho g L^3 / (E R^2), weight over
// stiffness: Romero et al. 2021, Physical validation of simulators in computer graphics.
double lengthOf(const hair::MaterialSettings& material, double gamma);

double bendingStiffness(const hair::MaterialSettings& material);  // EI, N m^2
double lineDensity(const hair::MaterialSettings& material);  // kg/m

// Capabilities that a check may need from a solver.
enum class Need {
    free_vertices,  // that fly freely without constraints
    pinned_tip,
    equal_masses,  // all vertices have the same mass
    bending,  // bending stiffness
    material,  // bending stiffness from a modulus
    sections,  // non-circular sections
    iterations
};

// Returns why a solver lacks what a check needs; absent if it does not.
std::optional<std::string> lack(hair::Solver solver, Need need);

// Sets the number of iterations, for a solver that has one.
void setIterations(hair::SimulationSettings& settings, std::uint32_t iterations);

inline constexpr double kTrajectoryLength = 0.15;  // m

// Points at eighths of the strand from the root, [sample][point], m.
using Trajectory = std::vector<std::vector<glm::dvec3>>;

// A strand released from the horizontal: 2 s, sampled every 1/30 s. A time between two steps is
// interpolated linearly between them. `segments` is a multiple of 8.
Trajectory playRelease(
    const engine::Device& device, const hair::SimulationSettings& settings, std::uint32_t segments);

inline constexpr int kTrajectorySamples = 60;
inline constexpr double kTrajectoryInterval = 1.0 / 30.0;  // s

// Points at eighths of a strand whose number of segments is a multiple of 8.
std::vector<glm::dvec3> eighthsOf(std::span<const glm::dvec3> points);

// The same samples of a strand that is already in motion.
Trajectory sampleTrajectory(Experiment& experiment);

// The strand hangs until it is at rest, at most this long: one sample.
Trajectory restTrajectory(
    const engine::Device& device, const hair::SimulationSettings& settings, std::uint32_t segments,
    double seconds);

// Greatest distance of a point at any time, relative to the strand's length.
double differenceOf(const Trajectory& a, const Trajectory& b);

// The greater of two errors. NaN is greater than any number, and stays.
inline double worst(double a, double b) { return std::isnan(a) || b <= a ? a : b; }

}  // namespace benchmarks::physics
