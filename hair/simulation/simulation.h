#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/buffer.h"
#include "engine/commands.h"
#include "engine/pipeline.h"
#include "hair/groom/groom.h"
#include "hair/settings.h"
#include "hair/simulation/guide_view.h"

namespace hair {

// The guides on the device and the two compute passes that move them. A step is recordWind, then
// recordStep; the constraints and their order are those of thesis section 3.2, then collisions.
// Simulated time is the number of recorded steps times the time step: nothing depends on frames or
// clocks. Solver `none` keeps the guides at rest and records nothing. Between submissions the
// device's work is ordered by the barriers that are recorded here. Borrows the device.
class Simulation {
public:
    // The groom needs at least one strand and two vertices. Settles the guides (see settle) for
    // settings.settle_steps. Throws Error for a wind direction without length, Unsupported if a
    // strand has more vertices than the device has invocations in a workgroup.
    Simulation(
        const engine::Device& device, const Groom& groom, const SimulationSettings& settings,
        std::uint32_t seed);

    // The wind's acceleration of every vertex at the current time. Recorded at strength 0 too, so
    // that frames with and without wind do the same work.
    void recordWind(engine::Commands& commands) const;

    // One time step under gravity and the wind recorded last. Positions are then visible to compute
    // and to every graphics stage.
    void recordStep(engine::Commands& commands);

    // Simulates steps without wind and waits for them; time stands still.
    void settle(std::uint32_t steps);

    // Back to the state after construction, when the device is done with what was submitted before.
    void reset();

    // Positions and those one step earlier, [strand][vertex], m.
    void setState(std::span<const glm::vec3> positions, std::span<const glm::vec3> previous);

    // Copied from the device after all that was submitted before, [strand][vertex], m.
    std::vector<glm::vec3> readPositions() const;

    double time() const { return static_cast<double>(steps_) * double{settings_.time_step}; }
    GuideView guides() const;

private:
    void recordSolver(engine::Commands& commands, std::uint64_t accelerations) const;
    void restore(const engine::Buffer& positions, const engine::Buffer& previous);
    void keepSettled();

    const engine::Device* device_;
    SimulationSettings settings_;
    std::uint32_t seed_;
    std::uint32_t strand_count_;
    std::uint32_t vertices_per_strand_;
    std::uint32_t strands_per_group_;
    std::array<glm::dvec3, 4> wind_cone_;
    engine::Buffer rest_positions_;
    engine::Buffer rest_edges_;
    engine::Buffer local_stiffness_;
    engine::Buffer capsules_;
    engine::Buffer positions_;
    engine::Buffer previous_;
    engine::Buffer settled_positions_;  // the state after construction
    engine::Buffer settled_previous_;
    engine::Buffer accelerations_;
    engine::ComputePipeline wind_;
    engine::ComputePipeline simulate_;
    std::uint64_t steps_ = 0;
};

}  // namespace hair
