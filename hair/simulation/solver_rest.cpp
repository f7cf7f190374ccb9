#include "hair/simulation/solver_rest.h"

#include "hair/simulation/dispatch_groups.h"

namespace hair {

RestSolver::RestSolver(const engine::Device& device, const Groom& groom)
    : vertex_count_(groom.strand_count * groom.vertices_per_strand),
      pipeline_(device, {.shader = "simulation/rest.comp", .push_size = sizeof(gpu::SubstepPush)}) {
}

void RestSolver::record(engine::Commands& commands, gpu::SubstepPush push) const {
    commands.bind(pipeline_, push);
    dispatchInvocations(commands, vertex_count_, gpu::kGuideGroupSize);
}

}  // namespace hair
