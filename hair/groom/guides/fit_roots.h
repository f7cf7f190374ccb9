#pragma once

#include <span>

#include <glm/vec3.hpp>

#include "hair/groom/growth/flatten.h"

namespace hair {

// The simplest surface that roots lie on.
struct RootSurface {
    enum class Kind { line, plane, sphere };
    Kind kind = Kind::line;
    // Of a sphere, from its centre, with the middle of the largest gap between the roots opposite
    // the axis. Of a plane, along its normal, from a centre so far away that the map is as good as
    // parallel. Of a line, only the axis counts: its direction.
    Flattening flattening;
    bool all_round = false;  // a sphere with roots on all sides
};

// A line where the roots are within 1e-4 of their extent of one. A sphere where that fits ten roots
// or more better than a plane and its radius is at most 50 times their extent.
// At least one root.
RootSurface fitRoots(std::span<const glm::vec3> roots);

}  // namespace hair
