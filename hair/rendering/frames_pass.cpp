#include "hair/rendering/frames_pass.h"

#include <algorithm>
#include <cstddef>

#include "hair/gpu_structs.h"

namespace hair {
namespace {

static_assert(sizeof(gpu::FramesPush) == 96 && offsetof(gpu::FramesPush, guides) == 64);

}  // namespace

FramesPass::FramesPass(const engine::Device& device, const StrandView& view)
    : pipeline_(device, {.shader = "strands/frames.comp", .push_size = sizeof(gpu::FramesPush)}),
      normals_(
          device, {.size = std::max<std::size_t>(
                               std::size_t{view.guide_count} * view.vertices_per_guide, 1) *
                           sizeof(glm::vec3),
                   .name = "guide normals"}) {}

void FramesPass::record(engine::Commands& commands, const StrandView& view) const {
    using engine::Access;
    // After the simulation, and whoever still draws with the frames that are overwritten.
    commands.barrier(Access::anything, Access::compute_write);
    commands.bind(
        pipeline_, gpu::FramesPush{
                       .head = view.head,
                       .guides = view.guides,
                       .root_frames = view.root_frames,
                       .normals = normals_.address(),
                       .guide_count = view.guide_count,
                       .vertices_per_guide = view.vertices_per_guide});
    commands.dispatch((view.guide_count + gpu::kFramesGroupSize - 1) / gpu::kFramesGroupSize);
    commands.barrier(Access::compute_write, Access::anything);
}

}  // namespace hair
