#pragma once

#include <vector>

#include "hair/gpu_structs.h"
#include "hair/groom/groom.h"
#include "hair/settings.h"

namespace hair {

// Rods at rest as the `rod` solver wants them. A segment shorter than 1e-9 m has the direction of
// the one before it, the first one +y; it bends with its neighbours and is not massless.
struct RodRest {
    std::vector<gpu::RodSegment> segments;  // [vertex][strand]
    std::vector<float> units;               // [strand], m
};

RodRest restOfRods(const Groom& groom, const MaterialSettings& material, const gpu::Step& step);

}  // namespace hair
