#include "hair/simulation/condition.h"

#include <cmath>
#include <cstddef>

#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "engine/pipeline.h"
#include "engine/transfer.h"

namespace hair::simulation {
namespace {

static_assert(sizeof(gpu::VertexCondition) == 12);
static_assert(offsetof(gpu::ConditionPush, frame) == 16);

void add(Worst& worst, double value, double limit, std::uint32_t guide, bool& counted) {
    if (!(value <= worst.value) && !std::isnan(worst.value)) {
        worst.value = value;
        worst.guide = guide;
    }
    if (!(value <= limit) && !counted) {
        ++worst.guides;
        counted = true;
    }
}

}  // namespace

GuideCondition worstOf(
    std::span<const gpu::VertexCondition> vertices, std::uint32_t vertices_per_strand,
    double substep, const ConditionLimits& limits) {
    GuideCondition condition;
    for (std::size_t first = 0; first < vertices.size(); first += vertices_per_strand) {
        const auto guide = static_cast<std::uint32_t>(first / vertices_per_strand);
        bool stretched = false, inside = false, moving = false;
        for (const gpu::VertexCondition& vertex : vertices.subspan(first, vertices_per_strand)) {
            add(condition.stretch, double{vertex.stretch}, limits.stretch, guide, stretched);
            add(condition.depth, -double{vertex.gap}, limits.depth, guide, inside);
            add(condition.speed, double{vertex.moved} / substep, limits.speed, guide, moving);
        }
    }
    return condition;
}

std::vector<gpu::VertexCondition> inspectVertices(
    const engine::Device& device, gpu::Address guides, const gpu::RigidFrame& frame,
    std::uint32_t count) {
    const engine::Buffer conditions(
        device, {.size = count * sizeof(gpu::VertexCondition), .name = "guide conditions"});
    const engine::ComputePipeline pipeline(
        device, {.shader = "simulation/condition.comp", .push_size = sizeof(gpu::ConditionPush)});
    runOnce(device, [&](engine::Commands& commands) {
        commands.barrier(engine::Access::anything, engine::Access::compute_write);
        commands.bind(
            pipeline, gpu::ConditionPush{
                          .guides = guides, .conditions = conditions.address(), .frame = frame});
        commands.uses({{conditions, engine::Access::compute_write}});
        commands.dispatchInvocations(count, gpu::kGuideGroupSize);
        commands.barrier(engine::Access::compute_write, engine::Access::transfer_read);
    });
    return engine::downloadAs<gpu::VertexCondition>(device, conditions);
}

}  // namespace hair::simulation
