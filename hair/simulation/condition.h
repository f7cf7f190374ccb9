#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/device.h"
#include "hair/gpu_structs.h"

// Checks of guides: stretched, inside a body, still moving.
namespace hair::simulation {

// The worst value of one kind over all guides.
struct Worst {
    double value = 0.0;
    std::uint32_t guide = 0;  // that has the value
    std::uint32_t guides = 0;  // that have a vertex beyond the limit
};

struct GuideCondition {
    Worst stretch;  // of a segment, over its rest length
    Worst depth;  // of a vertex in a body, ignoring the margin, m; 0: none is inside
    Worst speed;  // of a vertex, m/s
};

struct ConditionLimits {
    double stretch = 1.05;
    double depth = 1e-4;  // m
    double speed = 0.01;  // m/s
};

// Returns the worst of [strand][vertex] vertices. NaN counts as worse than any number.
GuideCondition worstOf(
    std::span<const gpu::VertexCondition> vertices, std::uint32_t vertices_per_strand,
    double substep, const ConditionLimits& limits = {});

// Inspects the `count` vertices of gpu::GuideParameters, with the head at `frame`. Waits for the
// device.
std::vector<gpu::VertexCondition> inspectVertices(
    const engine::Device& device, gpu::Address guides, const gpu::RigidFrame& frame,
    std::uint32_t count);

}  // namespace hair::simulation
