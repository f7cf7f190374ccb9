#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/groom/groom.h"
#include "hair/settings.h"

namespace hair {

// The `shape` solver on the CPU in double: the functions of reference_constraints.h in the order of
// thesis section 3.2, then collisions. Plain and slow; see simulation.h for the one that is
// measured.
class Reference {
public:
    Reference(const Groom& groom, const SimulationSettings& settings, std::uint32_t seed);

    // Positions and those one step earlier, [strand][vertex], m.
    void setState(std::span<const glm::dvec3> positions, std::span<const glm::dvec3> previous);

    // One time step under gravity and the wind of the current time.
    void step();
    // One time step under gravity alone; time stands still.
    void settle();

    double time() const { return steps_ * double{settings_.time_step}; }
    std::span<const glm::dvec3> positions() const { return positions_; }
    std::span<const glm::dvec3> previous() const { return previous_; }

private:
    void advance(std::span<const glm::dvec3> wind_accelerations);
    // Factors of strands with this mean segment length, m.
    double localFactor(double segment_length) const;
    double globalFactor() const;
    double keptFactor() const;

    SimulationSettings settings_;
    std::uint32_t seed_;
    std::size_t vertices_;  // per strand
    std::vector<glm::dvec3> rest_;
    std::vector<glm::dvec3> positions_;
    std::vector<glm::dvec3> previous_;
    std::uint32_t steps_ = 0;
};

}  // namespace hair
