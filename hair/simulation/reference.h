#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/groom/groom.h"
#include "hair/settings.h"
#include "hair/simulation/head_motion.h"
#include "hair/simulation/reference_solver.h"

namespace hair {

// The simulation on the CPU in double, on a head that moves: reference_solver.h, substep by
// substep. Plain and slow; see simulation.h for the one that is measured.
class Reference {
public:
    Reference(const Groom& groom, const SimulationSettings& settings, std::uint32_t seed);

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
    // What air does to every vertex now, [strand][vertex], m/s^2.
    std::vector<glm::dvec3> airAccelerations(const SimulationSettings& settings) const;
    // One step, in which the head goes from where it is now to where it is at the time `then`.
    void advance(std::span<const glm::dvec3> wind_accelerations, double then);

    template <class Points>
    auto ofStrand(Points& points, std::size_t strand) const {
        return std::span(points).subspan(strand * vertices_, vertices_);
    }

    SimulationSettings settings_;
    reference::Step step_;
    std::uint32_t seed_;
    HeadMotion motion_;
    std::size_t vertices_;  // per strand
    std::vector<glm::dvec3> rest_;
    std::vector<glm::dvec3> positions_;
    std::vector<glm::dvec3> previous_;
    std::unique_ptr<reference::Solver> solver_;  // null: nothing moves
    std::uint32_t steps_ = 0;
};

}  // namespace hair
