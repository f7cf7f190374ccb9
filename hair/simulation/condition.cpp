#include "hair/simulation/condition.h"

#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>

#include <glm/geometric.hpp>

#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "engine/pipeline.h"
#include "engine/transfer.h"

namespace hair::simulation {
namespace {

static_assert(sizeof(gpu::VertexCondition) == 12);
static_assert(offsetof(gpu::ConditionPush, frame) == 16);

double segmentLength(const glm::vec3& a, const glm::vec3& b) {
    return glm::distance(glm::dvec3(a), glm::dvec3(b));
}

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

std::optional<BrokenVertex> findBroken(
    std::span<const glm::vec3> positions, std::span<const glm::vec3> rest,
    std::uint32_t vertices_per_strand, double most_stretch) {
    assert(positions.size() == rest.size());
    double length = 0.0, rest_length = 0.0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const bool is_root = i % vertices_per_strand == 0;
        length = is_root ? 0.0 : length + segmentLength(positions[i - 1], positions[i]);
        rest_length = is_root ? 0.0 : rest_length + segmentLength(rest[i - 1], rest[i]);
        const glm::dvec3 at(positions[i]);
        const bool is_finite = std::isfinite(at.x + at.y + at.z);
        if (is_finite && length <= most_stretch * rest_length) continue;
        return BrokenVertex{
            .guide = static_cast<std::uint32_t>(i / vertices_per_strand),
            .vertex = static_cast<std::uint32_t>(i % vertices_per_strand),
            .stretch = is_finite ? length / rest_length : std::numeric_limits<double>::quiet_NaN()};
    }
    return std::nullopt;
}

double mostStretch(const SimulationSettings&) { return 2.0; }

std::vector<gpu::VertexCondition> inspectVertices(
    const engine::Device& device, gpu::Address guides, const gpu::RigidFrame& frame,
    std::uint32_t count) {
    const engine::Buffer conditions(
        device, {.size = count * sizeof(gpu::VertexCondition),
                 .name = "guide conditions",
                 .purpose = "simulation"});
    const engine::ComputePipeline pipeline(
        device, {.shader = "simulation/condition.comp", .push_size = sizeof(gpu::ConditionPush)});
    runOnce(device, [&](engine::Commands& commands) {
        commands.bind(
            pipeline,
            gpu::ConditionPush{
                .guides = guides, .conditions = commands.writes(conditions), .frame = frame});
        commands.dispatchInvocations(count, gpu::kGuideGroupSize);
    });
    return engine::downloadAs<gpu::VertexCondition>(device, conditions);
}

}  // namespace hair::simulation
