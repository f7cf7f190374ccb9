#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/groom/groom.h"
#include "hair/reference/constraints.h"
#include "hair/reference/wind.h"
#include "hair/settings.h"
#include "hair/simulation/head_motion.h"

namespace hair::reference {

// A strand in a substep.
struct Substep {
    std::size_t strand = 0;
    Points positions;
    Points previous;  // becomes the positions before the substep, or what the solver makes of them
    ConstPoints rest;  // where the groom was made, m
    ConstPoints accelerations;  // of gravity and all that is held for a whole step, m/s^2
    ConstPoints air;  // its velocity at the vertices, m/s; empty: it does not brake
    simulation::RigidMotion frame;  // of the head at the substep's end
    simulation::RigidMotion frame_before;  // and at its start
    // Where a vertex comes to lie that the substep has moved from `before` to `position`.
    PushOut push_out;
};

// What moves the strands of a Reference, as GuideSolver moves those of a Simulation.
class Solver {
public:
    virtual ~Solver() = default;

    virtual void step(const Substep& substep) = 0;

    // Derives the state of its own from positions and previous positions that someone else wrote.
    // Accelerations and push_out are empty.
    virtual void adopt(const Substep&) {}
};

// The settings' solver; null where nothing moves: `none` without keyframes.
std::unique_ptr<Solver>
makeSolver(const groom::Groom& groom, const SimulationSettings& settings, const Step& step);

// The simulation on the CPU in double, on a head that moves: a Solver, substep by substep. Plain
// and slow; hair/simulation/simulation.h has the one that is measured.
class Reference {
public:
    Reference(const groom::Groom& groom, const SimulationSettings& settings, std::uint32_t seed);

    // Positions and those one substep earlier, [strand][vertex], m.
    void setState(std::span<const glm::dvec3> positions, std::span<const glm::dvec3> previous);

    // One time step under gravity, the wind and the hands of the current time.
    void step();
    // One time step under gravity and in still air; time stands still.
    void settle();

    double time() const { return steps_ * step_.whole; }
    std::span<const glm::dvec3> positions() const { return positions_; }
    std::span<const glm::dvec3> previous() const { return previous_; }

private:
    // What air does to every vertex now, [strand][vertex].
    Air airNow(const SimulationSettings& settings) const;
    // One step, in which the head goes from where it is now to where it is at the time `then`.
    void advance(const Air& air, double then);

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
