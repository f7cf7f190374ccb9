#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "engine/pipeline.h"
#include "engine/transfer.h"
#include "hair/simulation/bodies.h"
#include "hair/simulation/stiffness.h"
#include "tests/probe_shaders.h"

namespace hair::simulation {

struct Contact {
    float margin = 0.0f;
    float friction = 0.0f;
};

// Returns the field as the simulation's shaders read it at the probes' positions.
inline std::vector<gpu::DistanceProbe> probe(
    const engine::Device& device, const DistanceField& field,
    std::span<const gpu::DistanceProbe> probes, const Contact& contact = {}) {
    static_assert(sizeof(gpu::DistanceProbe) == 52 && offsetof(gpu::DistanceProbe, pushed) == 40);
    static_assert(offsetof(gpu::ProbeDistancePush, friction) == 56);
    const engine::Buffer buffer = engine::makeBuffer(device, probes, "distance probes", "tests");
    probe_shaders::addTo(device);
    const engine::ComputePipeline pipeline(
        device, {.shader = "probe_distance.comp", .push_size = sizeof(gpu::ProbeDistancePush)});
    const gpu::ProbeDistancePush push{
        .field = field.parameters(),
        .probes = buffer.address(),
        .count = static_cast<std::uint32_t>(probes.size()),
        .margin = contact.margin,
        .friction = contact.friction};
    runOnce(device, [&](engine::Commands& commands) {
        commands.bind(pipeline, push);
        commands.dispatchInvocations(push.count, 64);
    });
    return engine::downloadAs<gpu::DistanceProbe>(device, buffer);
}

inline gpu::DistanceProbe probe(
    const engine::Device& device, const DistanceField& field, const glm::vec3& position,
    const glm::vec3& before = {}, const Contact& contact = {}) {
    const gpu::DistanceProbe asked{
        .position = position, .before = before, .distance = 0, .gradient = {}, .pushed = {}};
    return probe(device, field, std::span(&asked, 1), contact).front();
}

}  // namespace hair::simulation
