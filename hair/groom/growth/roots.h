#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/groom/growth/parting.h"
#include "hair/groom/growth/root_density.h"
#include "hair/groom/growth/scalp.h"
#include "hair/groom/mesh/surface.h"
#include "hair/groom_settings.h"
#include "hair/random.h"

// The roots of a scalp's guides, and the triangles between them.
namespace hair::groom {

struct RootOptions {
    std::uint32_t guides = 0;
    std::uint32_t seed = 0;
    RootPlacement placement = RootPlacement::poisson_disc;
    const Texture* mask = nullptr;           // null: the same everywhere
    const PartingLine* parting = nullptr;    // null: none
    bool dense = false;  // many roots, without rows or triangles
};

struct Roots {
    std::vector<SurfacePoint> points;  // the hairline's first, in its order
    std::uint32_t boundary_count = 0;
    // Counter-clockwise seen from outside. One root has {0, 0, 0}, two have {0, 1, 1}.
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

// Puts `guides` >= 1 roots on the scalp. On a disc without a mask that can be flattened, some of
// the poisson_disc roots lie evenly along its hairline, and the triangles are Delaunay on the
// sphere of directions. On every other scalp, roots lie in proportion to the mask, with the
// triangles of surfaceTriangles(). With a parting, two rows of roots run along it, and no triangle
// reaches over it; this needs three more guides than both rows have. Throws engine::Error if the
// mask leaves no place for the roots.
Roots placeRoots(const Scalp& scalp, const NearestSurface& surface, const RootOptions& options);

// Number of `guides` roots that lie on the hairline. The thesis's 86 guides with 136 root
// triangles have 34 there (Euler: 2 * 86 - 2 - 34 = 136). The number is proportional to the square
// root of `guides`, as an edge's length is to the square root of an area.
std::uint32_t boundaryRootCount(std::uint32_t guides);

// Returns lengths along a hairline of `total` m at which `count` roots are evenly spaced, the first
// at 0. With up to two cuts, they go from `gap` after a cut to `gap` before the next, with a root
// at either end.
std::vector<double>
hairlineLengths(double total, std::uint32_t count, std::vector<double> cuts, double gap);

}  // namespace hair::groom
