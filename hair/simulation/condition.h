#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/device.h"
#include "hair/gpu_structs.h"
#include "hair/settings.h"

// Checks of guides: stretched, inside a body, still moving.
namespace hair::simulation {

// The worst value of one kind over all guides.
struct Worst {
    double value = 0.0;
    std::uint32_t guide = 0;  // guide with this value
    std::uint32_t guides = 0;  // guides with a vertex beyond the limit
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

// A vertex at a place that no valid simulation of hair reaches.
struct BrokenVertex {
    std::uint32_t guide = 0;
    std::uint32_t vertex = 0;
    double stretch = 0.0;  // of the guide up to this vertex, over its length at rest; NaN: no
                           // position
};

// Returns the first guide's vertex that has no finite position or that is farther along the guide
// than `most_stretch` times its distance along the guide at rest. Both spans are [strand][vertex],
// m.
std::optional<BrokenVertex> findBroken(
    std::span<const glm::vec3> positions, std::span<const glm::vec3> rest,
    std::uint32_t vertices_per_strand, double most_stretch);

// Returns the stretch of whole guides beyond which a simulation with these settings has failed.
double mostStretch(const SimulationSettings& settings);

// Inspects the `count` vertices of gpu::GuideParameters, with the head at `frame`. Waits for the
// device.
std::vector<gpu::VertexCondition> inspectVertices(
    const engine::Device& device, gpu::Address guides, const gpu::RigidFrame& frame,
    std::uint32_t count);

}  // namespace hair::simulation
