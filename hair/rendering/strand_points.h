#pragma once

#include <cstdint>
#include <vector>

#include "engine/device.h"
#include "hair/gpu_structs.h"
#include "hair/rendering/strand_plan.h"
#include "hair/rendering/strand_view.h"
#include "hair/settings.h"

namespace hair::rendering {

// The strands of a picture as points in memory, for export, measurement and tests. Every guide
// segment has both of its ends: the last point of a segment is the first of the next.
struct StrandPoints {
    StrandPlan plan;
    // [triangle][strand][guide segment][0 .. tessellation], root first. In LodMode::distance the
    // counts are those of level 0, and the points that are not drawn have a negative width.
    std::vector<gpu::StrandPointRecord> records;

    // `point` is in [0, tessellation].
    const gpu::StrandPointRecord&
    at(std::uint32_t triangle, std::uint32_t strand, std::uint32_t segment,
       std::uint32_t point) const;
};

// Most points that are evaluated at once: 32 MiB of them. Every device has larger buffers.
inline constexpr std::uint32_t kMostPointsAtOnce = 1u << 20;

// Evaluates all strands on the device and waits. Throws engine::Unsupported for more than 2^32 - 1
// points.
StrandPoints evaluateStrandPoints(
    const engine::Device& device, const Settings& settings, const StrandView& view,
    std::uint32_t most_at_once = kMostPointsAtOnce);

}  // namespace hair::rendering
