#include "hair/simulation/solver_shape.h"

#include <array>
#include <cstddef>
#include <span>
#include <utility>

#include "engine/transfer.h"
#include "hair/simulation/dispatch_groups.h"
#include "hair/simulation/rest_shape.h"
#include "hair/simulation/stiffness.h"

namespace hair {

namespace {

static_assert(offsetof(gpu::ShapeParameters, length_iterations) == 24);

std::vector<float>
localStiffnesses(const Groom& groom, const SimulationSettings& settings, const gpu::Step& step) {
    std::vector<float> factors;
    for (const double length : meanSegmentLengths(groom))
        factors.push_back(static_cast<float>(localStiffness(settings, step, length)));
    return factors;
}

engine::ComputePipeline pipelineOf(const engine::Device& device, const ShapePlan& plan) {
    engine::Constants constants = plan.constants;
    constants.emplace_back(gpu::kShapeCollidesConstant, plan.collides);
    return {
        device,
        {.shader = plan.shader, .constants = constants, .push_size = sizeof(gpu::SubstepPush)}};
}

}  // namespace

ShapeSolver::ShapeSolver(
    const engine::Device& device, const Groom& groom, const SimulationSettings& settings,
    const gpu::Step& step)
    : strand_count_(groom.strand_count),
      plan_(planShape(device.info(), settings, groom.strand_count, groom.vertices_per_strand)),
      rest_edges_(engine::makeBuffer(
          device, std::span<const glm::vec4>(transportedRestEdges(groom)), "guide rest edges")),
      local_stiffness_(engine::makeBuffer(
          device, std::span<const float>(localStiffnesses(groom, settings, step)),
          "guide local stiffness")),
      parameters_(engine::makeBuffer(
          device,
          std::span<const gpu::ShapeParameters>(std::array{gpu::ShapeParameters{
              .rest_edges = rest_edges_.address(),
              .local_stiffness = local_stiffness_.address(),
              .global_stiffness = static_cast<float>(globalStiffness(settings, step)),
              .local_iterations = settings.local.iterations,
              .length_iterations = settings.length.iterations}}),
          "shape parameters")),
      pipeline_(pipelineOf(device, plan_)) {}

void ShapeSolver::record(engine::Commands& commands, gpu::SubstepPush push) const {
    push.solver = parameters_.address();
    commands.bind(pipeline_, push);
    dispatchInvocations(commands, strand_count_, plan_.strands_per_group);
}

void ShapeSolver::expectBodies(const engine::Device& device) {
    if (plan_.collides) return;
    ShapePlan plan = plan_;
    plan.collides = true;
    pipeline_ = pipelineOf(device, plan);
    plan_ = std::move(plan);
}

}  // namespace hair
