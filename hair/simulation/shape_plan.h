#pragma once

#include <cstdint>
#include <string>

#include "engine/physical_device.h"
#include "engine/pipeline.h"
#include "hair/settings.h"

namespace hair {

// How the `shape` solver's strands are dealt out to invocations.
struct ShapePlan {
    std::string shader;
    engine::Constants constants;  // but kShapeCollidesConstant
    bool collides = false;        // whether it looks for contact with bodies
    std::uint32_t strands_per_group = 0;
};

// Throws Unsupported for strands with more vertices than the device has invocations in a workgroup
// for, at 32 vertices each.
ShapePlan planShape(
    const engine::DeviceInfo& device, const SimulationSettings& settings,
    std::uint32_t strand_count, std::uint32_t vertices_per_strand);

}  // namespace hair
