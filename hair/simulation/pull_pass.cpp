#include "hair/simulation/pull_pass.h"

#include <cmath>
#include <cstddef>
#include <optional>

#include <glm/vec4.hpp>

#include "hair/simulation/dispatch_groups.h"

namespace hair {

namespace {

using engine::Access;

static_assert(sizeof(gpu::PullPush) == 72 && offsetof(gpu::PullPush, held_vertex) == 48);

engine::ComputePipeline pipeline(const engine::Device& device, const char* shader) {
    return {device, {.shader = shader, .push_size = sizeof(gpu::PullPush)}};
}

}  // namespace

PullPass::PullPass(
    const engine::Device& device, std::uint32_t strand_count, std::uint32_t vertices_per_strand,
    const gpu::Step& step, std::vector<PullSettings> pulls)
    : vertex_count_(strand_count * vertices_per_strand), vertices_per_strand_(vertices_per_strand),
      step_(step), pulls_(std::move(pulls)),
      held_(device, {.size = sizeof(glm::vec4), .name = "guide pull"}),
      hold_(pipeline(device, "simulation/pull_hold.comp")),
      spread_(pipeline(device, "simulation/pull.comp")) {}

void PullPass::record(
    engine::Commands& commands, std::uint64_t guides, std::uint64_t accelerations,
    double time) const {
    const double dt = step_.whole;
    for (const PullSettings& pull : pulls_) {
        const std::optional<Hand> hand = handIn(pull, time, time + dt);
        if (!hand) continue;
        const double stiffness = pull.stiffness;
        const double damping = 2.0 * std::sqrt(stiffness);
        const gpu::PullPush push{
            .guides = guides,
            .accelerations = accelerations,
            .held = held_.address(),
            .hand = hand->position,
            .hand_velocity = hand->velocity,
            .held_vertex = pull.guide * vertices_per_strand_ + pull.vertex,
            .radius = pull.radius,
            .stiffness = static_cast<float>(stiffness),
            .damping = static_cast<float>(damping),
            .implicit = static_cast<float>(1.0 / (1.0 + damping * dt + stiffness * dt * dt))};
        commands.barrier(Access::compute_write, Access::compute_write);
        commands.bind(hold_, push);
        commands.dispatch(1);
        commands.barrier(Access::compute_write, Access::compute_write);
        commands.bind(spread_, push);
        dispatchInvocations(commands, vertex_count_, gpu::kGuideGroupSize);
    }
}

}  // namespace hair
