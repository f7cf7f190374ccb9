#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "engine/pipeline.h"

namespace hair::simulation {

// Guides between two steps, for drawing. If steps do not divide frames, frames advance by unequal
// numbers of steps, and guides that are drawn where the last step left them jump. Between the last
// two steps they move evenly. They are then drawn one time step late. A position is linear between
// two steps, so a turn by an angle a in a step cuts off at most the sagitta, a^2 / 8 of the radius.
class GuideInterpolation {
public:
    GuideInterpolation(const engine::Device& device, std::uint32_t vertex_count);

    // Writes the positions at a share, 0 to 1, of the way from those at address `from` to those at
    // `to`, both vec4 [vertex], m, in compute. Afterwards they are visible as after a step.
    void
    record(engine::Commands& commands, std::uint64_t from, std::uint64_t to, double share) const;

    const engine::Buffer& positions() const { return positions_; }  // vec4 [vertex], m

private:
    std::uint32_t vertex_count_;
    engine::Buffer positions_;
    engine::ComputePipeline pipeline_;
};

}  // namespace hair::simulation
