#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "hair/groom/groom.h"
#include "hair/reference/constraints.h"
#include "hair/reference/wind.h"
#include "hair/settings.h"
#include "hair/simulation/head_motion.h"

// The local constraint of `shape` as an energy, in double; simulation/constraints/bend.glsl has the
// equations. Here a substep is one dense system with two angles per joint, in the directions
// perpendicular to the axis of its torsion-free turn.

namespace hair::reference {

struct BendStep {
    // [vertex], root unused, both with air's part. `pushes`: free movement plus substep^2 times the
    // accelerations, m. `masses`: effective mass over the vertex's own.
    std::vector<glm::dvec3> pushes;
    std::vector<glm::dmat3> masses;
    // Push of air along the tangent at a vertex when the strand turns there, m.
    std::vector<glm::dvec3> turning_pushes;
    double stiffness = 0.0;  // substep^2 K
    double damping = 1.0;  // factor by which the stiffness is implicit
    glm::dmat3 frame{1.0};  // of the head at the substep's start
    glm::dvec3 turn{0.0};  // of the head during the substep, rad
    glm::dvec3 root{0.0};  // at the end of the substep, m
};

// Moves a strand. `rest` is in the groom's frame.
void bendStrand(Points positions, ConstPoints rest, const BendStep& step);

// A strand in a substep.
struct Substep {
    std::size_t strand = 0;
    Points positions;
    Points previous;  // becomes the positions before the substep, or what the solver needs
    ConstPoints rest;  // in the groom's frame, m
    ConstPoints accelerations;  // gravity and everything constant over a whole step, m/s^2
    ConstPoints air;  // air velocity at the vertices, m/s; empty: no drag
    simulation::RigidMotion frame;  // of the head at the substep's end
    simulation::RigidMotion frame_before;  // of the head at the substep's start
    // Returns the contact of a vertex that the substep moved from `before` to `position`.
    PushOut push_out;
};

// Moves the strands of a Reference, as GuideSolver moves those of a Simulation.
class Solver {
public:
    virtual ~Solver() = default;

    virtual void step(const Substep& substep) = 0;

    // Derives the solver's own state from positions and previous positions that other code wrote.
    // Accelerations and push_out are empty.
    virtual void adopt(const Substep&) {}
};

// Makes the solver of the settings; null if nothing moves: `none` without keyframes.
std::unique_ptr<Solver>
makeSolver(const groom::Groom& groom, const SimulationSettings& settings, const Step& step);

// The simulation on the CPU in double precision, on a moving head: a Solver, substep by substep.
// Simple and slow; hair/simulation/simulation.h has the measured one.
class Reference {
public:
    Reference(const groom::Groom& groom, const SimulationSettings& settings, std::uint32_t seed);

    // Sets positions, and positions one substep earlier, [strand][vertex], m.
    void setState(std::span<const glm::dvec3> positions, std::span<const glm::dvec3> previous);

    // Simulates one time step under gravity, wind and hands at the current time.
    void step();
    // Simulates one time step under gravity in still air. Simulated time does not advance.
    void settle();

    double time() const { return steps_ * step_.whole; }
    std::span<const glm::dvec3> positions() const { return positions_; }
    std::span<const glm::dvec3> previous() const { return previous_; }

private:
    // Returns the air at every vertex now, [strand][vertex].
    Air airNow(const SimulationSettings& settings) const;
    // Simulates one step, in which the head moves from its present pose to its pose at the time
    // `then`.
    void advance(Air air, double then);

    template <class Points>
    auto ofStrand(Points& points, std::size_t strand) const {
        return std::span(points).subspan(strand * vertices_, vertices_);
    }

    SimulationSettings settings_;
    Step step_;
    std::uint32_t seed_;
    simulation::HeadMotion motion_;
    std::size_t vertices_;  // per strand
    std::vector<glm::dvec3> rest_;
    std::vector<glm::dvec3> positions_;
    std::vector<glm::dvec3> previous_;
    std::vector<glm::dvec3> friction_kept_;  // VolumeState::kept
    std::unique_ptr<Solver> solver_;  // null: nothing moves
    std::uint32_t steps_ = 0;
};

}  // namespace hair::reference
