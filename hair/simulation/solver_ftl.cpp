#include "hair/simulation/solver_ftl.h"

#include <array>
#include <span>

#include "engine/buffer_image.h"
#include "engine/transfer.h"
#include "hair/simulation/stiffness.h"

namespace hair::simulation {

FtlSolver::FtlSolver(
    const engine::Device& device, const groom::Groom& groom, const SimulationSettings& settings,
    const gpu::Step& step)
    : strand_count_(groom.strand_count),
      parameters_(engine::makeBuffer(
          device,
          std::span<const gpu::FtlParameters>(std::array{gpu::FtlParameters{
              .global_stiffness = static_cast<float>(globalStiffness(settings, step)),
              .velocity_correction = settings.ftl.velocity_correction}}),
          "ftl parameters")),
      pipeline_(
          device, {.shader = "simulation/ftl.comp",
                   .constants =
                       {{gpu::kContinuousCollisionConstant, settings.collision.continuous},
                        {gpu::kSkinnedRootsConstant, hasSkinnedRoots(settings)}},
                   .push_size = sizeof(gpu::SubstepPush)}) {}

void FtlSolver::record(engine::Commands& commands, gpu::SubstepPush push) const {
    push.solver = parameters_.address();
    commands.bind(pipeline_, push);
    commands.dispatchInvocations(strand_count_, gpu::kGuideGroupSize);
}

}  // namespace hair::simulation
