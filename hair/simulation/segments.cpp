#include "hair/simulation/segments.h"

#include <cstddef>

#include <glm/vec4.hpp>

namespace hair::simulation {
namespace {

using engine::Access;

static_assert(sizeof(gpu::SegmentPush) == 76 && offsetof(gpu::SegmentPush, frame_before) == 44);

}  // namespace

SegmentPass::SegmentPass(
    const engine::Device& device, std::uint32_t strand_count, std::uint32_t vertices_per_strand,
    const SimulationSettings& settings)
    : strand_count_(strand_count), keeps_rest_(settings.rest == RestShape::balanced ? 1 : 0),
      starts_(
          device,
          {.size = sizeof(glm::vec4) * strand_count * vertices_per_strand, .name = "guide starts"}),
      pipeline_(
          device, {.shader = "simulation/segments.comp",
                   .constants = {{gpu::kSegmentVerticesConstant, vertices_per_strand}},
                   .push_size = sizeof(gpu::SegmentPush)}) {}

void SegmentPass::recordStart(engine::Commands& commands, const engine::Buffer& positions) const {
    // Waits for the previous substep, which wrote the positions and read the copies of the
    // positions at its start.
    commands.barrier(
        {{Access::compute_write, Access::transfer_read},
         {Access::compute_write, Access::transfer_write}});
    commands.copy(positions, starts_, starts_.size());
    commands.barrier(Access::transfer_write, Access::compute_write);
}

void SegmentPass::record(
    engine::Commands& commands, const GuideAddresses& guides, const gpu::RigidFrame& frame,
    const gpu::RigidFrame& frame_before) const {
    commands.barrier(Access::compute_write, Access::compute_write);
    commands.uses(
        {{guides.positions, Access::compute_write},
         {guides.previous, Access::compute_write},
         {starts_, Access::compute_read}});
    commands.bind(
        pipeline_, gpu::SegmentPush{
                       .guides = guides.parameters,
                       .starts = starts_.address(),
                       .frame = frame,
                       .frame_before = frame_before,
                       .keeps_rest = keeps_rest_});
    commands.dispatchInvocations(strand_count_, gpu::kGuideGroupSize);
}

}  // namespace hair::simulation
