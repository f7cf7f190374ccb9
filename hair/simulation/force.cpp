#include "hair/simulation/force.h"

#include <cstddef>

#include "engine/error.h"
#include "hair/extension.h"
#include "hair/gpu_structs.h"

namespace hair::simulation {
namespace {

static_assert(sizeof(gpu::ForcePush) == 20 && offsetof(gpu::ForcePush, time) == 16);

engine::ComputeDescription forceStage(const SimulationSettings& settings) {
    if (!settings.force_parameters.file)
        throw engine::Error("/simulation/force", "names a file that was not read");
    return {
        .shader = "simulation/force.comp",
        .constants = extensionConstants(settings.force_parameters),
        .extensions = shaderExtensions(settings.force_parameters),
        .push_size = sizeof(gpu::ForcePush)};
}

}  // namespace

ForcePass::ForcePass(
    const engine::Device& device, std::uint32_t vertex_count, const SimulationSettings& settings)
    : vertex_count_(vertex_count), pipeline_(device, forceStage(settings)) {}

void ForcePass::record(
    engine::Commands& commands, const GuideAddresses& guides, double time) const {
    using engine::Access;
    commands.barrier(Access::compute_write, Access::compute_write);
    commands.bind(
        pipeline_, gpu::ForcePush{
                       .guides = guides.parameters,
                       .accelerations = guides.accelerations,
                       .time = static_cast<float>(time)});
    commands.uses(
        {{guides.positions, Access::compute_read},
         {guides.previous, Access::compute_read},
         {guides.accelerations, Access::compute_write}});
    commands.dispatchInvocations(vertex_count_, gpu::kGuideGroupSize);
}

}  // namespace hair::simulation
