#include "hair/simulation/solver_rod.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "engine/transfer.h"
#include "hair/simulation/dispatch_groups.h"

namespace hair {

namespace {

static_assert(sizeof(gpu::RodSegment) == 32 && sizeof(gpu::RodMotion) == 52);
static_assert(offsetof(gpu::RodParameters, most_strands) == 32);

constexpr std::size_t kMostScratch = std::size_t{64} << 20;  // B, for more than one group

std::size_t scratchOfStrand(const Groom& groom) {
    return sizeof(glm::vec4) * gpu::kRodScratchRows * groom.vertices_per_strand;
}

// Whole groups whose scratch memory fits, at least one.
std::uint32_t strandsInDispatch(const Groom& groom) {
    const std::size_t groups = kMostScratch / (gpu::kRodGroupSize * scratchOfStrand(groom));
    const std::size_t most = gpu::kRodGroupSize * std::max<std::size_t>(groups, 1);
    return static_cast<std::uint32_t>(std::min<std::size_t>(most, groom.strand_count));
}

}  // namespace

RodSolver::RodSolver(
    const engine::Device& device, const Groom& groom, const SimulationSettings& settings,
    const gpu::Step& step)
    : RodSolver(device, groom, settings, restOfRods(groom, settings.material, step)) {}

RodSolver::RodSolver(
    const engine::Device& device, const Groom& groom, const SimulationSettings& settings,
    const RodRest& rest)
    : strand_count_(groom.strand_count), most_strands_(strandsInDispatch(groom)),
      segments_(engine::makeBuffer(
          device, std::span<const gpu::RodSegment>(rest.segments), "rod segments")),
      units_(engine::makeBuffer(device, std::span<const float>(rest.units), "rod units")),
      motion_(device, {.size = sizeof(gpu::RodMotion) * groom.points.size(), .name = "rod motion"}),
      scratch_(device, {.size = scratchOfStrand(groom) * most_strands_, .name = "rod scratch"}),
      parameters_(engine::makeBuffer(
          device,
          std::span<const gpu::RodParameters>(std::array{gpu::RodParameters{
              .segments = segments_.address(),
              .units = units_.address(),
              .motion = motion_.address(),
              .scratch = scratch_.address(),
              .most_strands = most_strands_,
              .iterations = settings.rod.iterations}}),
          "rod parameters")),
      step_(device, {.shader = "simulation/rod.comp", .push_size = sizeof(gpu::SubstepPush)}),
      adopt_(
          device, {.shader = "simulation/rod_adopt.comp", .push_size = sizeof(gpu::SubstepPush)}) {}

void RodSolver::record(engine::Commands& commands, gpu::SubstepPush push) const {
    push.solver = parameters_.address();
    for (std::uint32_t first = 0; first < strand_count_; first += most_strands_) {
        // The scratch memory of the strands before.
        if (first > 0)
            commands.barrier(engine::Access::compute_write, engine::Access::compute_write);
        push.first_strand = first;
        commands.bind(step_, push);
        dispatchInvocations(
            commands, std::min(most_strands_, strand_count_ - first), gpu::kRodGroupSize);
    }
}

void RodSolver::recordAdopt(engine::Commands& commands, gpu::SubstepPush push) const {
    push.solver = parameters_.address();
    commands.bind(adopt_, push);
    dispatchInvocations(commands, strand_count_, gpu::kRodGroupSize);
}

}  // namespace hair
