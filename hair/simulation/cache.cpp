#include "hair/simulation/cache.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <span>

#include <glm/vec4.hpp>

#include "engine/transfer.h"

namespace hair::simulation {
namespace {

using engine::Access;

static_assert(sizeof(gpu::CachePlace) == 20);
static_assert(sizeof(gpu::CacheRestPush) == 48 && offsetof(gpu::CacheRestPush, vertex_count) == 44);
static_assert(
    sizeof(gpu::CacheFollowPush) == 96 && offsetof(gpu::CacheFollowPush, stiffness) == 92);

std::vector<glm::vec4> samplesOf(const groom::Groom& groom) {
    std::vector<glm::vec4> samples;
    samples.reserve(groom.cache.points.size());
    for (const glm::vec3& point : groom.cache.points) samples.emplace_back(point, 0.0f);
    return samples;
}

// Without goals there is one offset, because a buffer has a size.
std::vector<glm::vec4>
goalOffsets(const engine::Device& device, const groom::Groom& groom, const engine::Buffer* goals) {
    if (!goals) return {glm::vec4(0.0f)};
    auto offsets = engine::downloadAs<glm::vec4>(device, *goals);
    for (std::size_t i = 0; i < offsets.size(); ++i)
        offsets[i] = glm::vec4(glm::vec3(offsets[i]) - groom.points[i], offsets[i].w);
    return offsets;
}

}  // namespace

CacheInterval intervalAt(const std::vector<double>& times, double time) {
    const auto next = std::ranges::upper_bound(times, time);
    const auto after = static_cast<std::size_t>(next - times.begin());
    if (after == 0) return {};
    if (after == times.size()) return {after - 1, after - 1, 0.0};
    return {after - 1, after, (time - times[after - 1]) / (times[after] - times[after - 1])};
}

engine::MemoryRows CachePass::rows(const groom::GroomSize& size, bool has_goals) {
    return {
        "simulation",
        {{"guide cache", engine::bytesOf<glm::vec4>(size.cached_points)},
         {"guide goal offsets", engine::bytesOf<glm::vec4>(has_goals ? size.vertices() : 0)}}};
}

CachePass::CachePass(
    const engine::Device& device, const groom::Groom& groom, const engine::Buffer& rest_positions,
    const engine::Buffer* goals)
    : times_(groom.cache.times), vertex_count_(groom.strand_count * groom.vertices_per_strand),
      stiffness_(groom.cache.strength.value_or(0.0f)), rest_positions_(&rest_positions),
      goals_(goals), samples_(engine::makeBuffer(
                         device, samplesOf(groom), rows(sizeOf(groom), goals), "guide cache")),
      goal_offsets_(engine::makeBuffer(
          device, goalOffsets(device, groom, goals), rows(sizeOf(groom), goals),
          "guide goal offsets")),
      rest_(
          device,
          {.shader = "simulation/cache_rest.comp", .push_size = sizeof(gpu::CacheRestPush)}),
      follow_(
          device,
          {.shader = "simulation/cache_follow.comp", .push_size = sizeof(gpu::CacheFollowPush)}) {
    assert(groom.cache.points.size() == times_.size() * vertex_count_);
}

gpu::CachePlace CachePass::placeAt(double time) const {
    const CacheInterval interval = intervalAt(times_, time);
    const auto addressOf = [&](std::size_t sample) {
        return samples_.address() + sample * vertex_count_ * sizeof(glm::vec4);
    };
    return {
        .before = addressOf(interval.before),
        .after = addressOf(interval.after),
        .fraction = static_cast<float>(interval.fraction)};
}

void CachePass::recordRest(engine::Commands& commands, double time) const {
    commands.bind(
        rest_, gpu::CacheRestPush{
                   .rest_positions = commands.writes(*rest_positions_),
                   .goals = goals_ ? commands.writes(*goals_) : 0,
                   .goal_offsets = commands.reads(goal_offsets_),
                   .place = placeAt(time),
                   .vertex_count = vertex_count_});
    commands.uses({{samples_, Access::compute_read}});
    commands.dispatchInvocations(vertex_count_, gpu::kGuideGroupSize);
}

void CachePass::recordFollow(
    engine::Commands& commands, const GuideAddresses& guides, const RigidMotion& head_before,
    const RigidMotion& head_after, double to) const {
    commands.bind(
        follow_, gpu::CacheFollowPush{
                     .guides = guides.parameters,
                     .accelerations = commands.writes(guides.accelerations),
                     .place = placeAt(to),
                     .frame_before = toGpu(head_before),
                     .frame = toGpu(head_after),
                     .stiffness = static_cast<float>(stiffness_)});
    commands.uses(
        {{samples_, Access::compute_read},
         {*rest_positions_, Access::compute_read},
         {guides.positions, Access::compute_read},
         {guides.previous, Access::compute_read}});
    commands.dispatchInvocations(vertex_count_, gpu::kGuideGroupSize);
}

}  // namespace hair::simulation
