#include "hair/simulation/interpolation.h"

#include <cstddef>

#include <glm/vec4.hpp>

#include "hair/gpu_structs.h"

namespace hair::simulation {

using engine::Access;

static_assert(sizeof(gpu::InterpolatePush) == 32 && offsetof(gpu::InterpolatePush, share) == 24);

GuideInterpolation::GuideInterpolation(const engine::Device& device, std::uint32_t vertex_count)
    : vertex_count_(vertex_count),
      positions_(
          device, {.size = sizeof(glm::vec4) * vertex_count, .name = "guide drawn positions"}),
      pipeline_(
          device,
          {.shader = "simulation/interpolate.comp", .push_size = sizeof(gpu::InterpolatePush)}) {}

void GuideInterpolation::record(
    engine::Commands& commands, std::uint64_t from, std::uint64_t to, double share) const {
    // Waits for the step, and for the drawing of the frame before.
    commands.bind(
        pipeline_, gpu::InterpolatePush{
                       .from = from,
                       .to = to,
                       .drawn = positions_.address(),
                       .share = static_cast<float>(share),
                       .vertex_count = vertex_count_});
    commands.uses(
        {{from, Access::compute_read},
         {to, Access::compute_read},
         {positions_, Access::compute_write}});
    commands.dispatchInvocations(vertex_count_, gpu::kGuideGroupSize);
}

}  // namespace hair::simulation
