#include "hair/simulation/pulls.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include <glm/common.hpp>
#include <glm/vec4.hpp>

#include "engine/error.h"
#include "hair/simulation/stiffness.h"

namespace hair::simulation {
namespace {

using engine::Access;

glm::dvec3 positionAt(const std::vector<PullKey>& path, double time) {
    const auto after = std::ranges::upper_bound(
        path, time, {}, [](const PullKey& key) { return double{key.time}; });
    if (after == path.begin()) return path.front().position;
    if (after == path.end()) return path.back().position;
    const PullKey& a = *(after - 1);
    const double part = (time - double{a.time}) / (double{after->time} - double{a.time});
    return glm::mix(glm::dvec3(a.position), glm::dvec3(after->position), part);
}

void checkVertex(
    const std::string& pull, const char* member, std::uint32_t number, std::uint32_t count,
    const char* things) {
    if (number >= count)
        throw engine::Error(
            pull + "/" + member, std::to_string(number) + " is too large: the groom has " +
                                     std::to_string(count) + " " + things);
}

static_assert(sizeof(gpu::PullPush) == 68 && offsetof(gpu::PullPush, held_vertex) == 48);

engine::ComputePipeline pullPipeline(const engine::Device& device, const char* shader) {
    return {device, {.shader = shader, .push_size = sizeof(gpu::PullPush)}};
}

}  // namespace

// ---- Hands --------------------------------------------------------------------------------------

std::optional<Hand> handIn(const PullSettings& pull, double from, double to) {
    const double middle = 0.5 * (from + to);
    if (pull.path.empty() || middle < pull.path.front().time || middle > pull.path.back().time)
        return {};
    const glm::dvec3 end = positionAt(pull.path, to);
    return Hand{.position = end, .velocity = (end - positionAt(pull.path, from)) / (to - from)};
}

void checkPulls(
    std::span<const PullSettings> pulls, std::uint32_t guides, std::uint32_t vertices_per_guide) {
    for (std::size_t i = 0; i < pulls.size(); ++i) {
        const std::string name = "/simulation/pulls/" + std::to_string(i);
        checkVertex(name, "guide", pulls[i].guide, guides, "guides");
        checkVertex(name, "vertex", pulls[i].vertex, vertices_per_guide, "vertices per guide");
        const auto& path = pulls[i].path;
        const auto late =
            std::ranges::adjacent_find(path, std::ranges::greater_equal{}, &PullKey::time);
        if (late != path.end())
            throw engine::Error(
                name + "/path/" + std::to_string(late - path.begin() + 1) + "/time",
                "is not after the previous key");
    }
}

// ---- The pass -----------------------------------------------------------------------------------

PullPass::PullPass(
    const engine::Device& device, std::uint32_t strand_count, std::uint32_t vertices_per_strand,
    const gpu::Step& step, std::vector<PullSettings> pulls)
    : vertex_count_(strand_count * vertices_per_strand), vertices_per_strand_(vertices_per_strand),
      step_(step), pulls_(std::move(pulls)),
      held_(device, {.size = sizeof(glm::vec4), .name = "guide pull"}),
      hold_(pullPipeline(device, "simulation/pull_hold.comp")),
      spread_(pullPipeline(device, "simulation/pull.comp")) {}

void PullPass::record(engine::Commands& commands, const GuideAddresses& guides, double time) const {
    const double dt = step_.whole;
    for (const PullSettings& pull : pulls_) {
        const std::optional<Hand> hand = handIn(pull, time, time + dt);
        if (!hand) continue;
        const double stiffness = pull.stiffness;
        const double damping = 2.0 * std::sqrt(stiffness);
        const gpu::PullPush push{
            .guides = guides.parameters,
            .accelerations = guides.accelerations,
            .held = held_.address(),
            .hand = hand->position,
            .hand_velocity = hand->velocity,
            .held_vertex = pull.guide * vertices_per_strand_ + pull.vertex,
            .radius = pull.radius,
            .stiffness = static_cast<float>(stiffness),
            .damping = static_cast<float>(damping),
            .implicit = static_cast<float>(1.0 / (1.0 + damping * dt + stiffness * dt * dt))};
        commands.barrier(engine::Access::compute_write, engine::Access::compute_write);
        commands.bind(hold_, push);
        commands.uses(
            {{guides.positions, Access::compute_read},
             {guides.previous, Access::compute_read},
             {guides.accelerations, Access::compute_read},
             {held_, Access::compute_write}});
        commands.dispatch(1);
        commands.barrier(engine::Access::compute_write, engine::Access::compute_write);
        commands.bind(spread_, push);
        commands.uses(
            {{held_, Access::compute_read}, {guides.accelerations, Access::compute_write}});
        commands.dispatchInvocations(vertex_count_, gpu::kGuideGroupSize);
    }
}

}  // namespace hair::simulation
