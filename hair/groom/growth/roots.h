#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hair/groom/growth/parting.h"
#include "hair/groom/growth/scalp.h"
#include "hair/groom/growth/texture.h"
#include "hair/groom/mesh/nearest_surface.h"
#include "hair/groom_settings.h"

namespace hair {

struct RootOptions {
    std::uint32_t guides = 0;
    std::uint32_t seed = 0;
    RootPlacement placement = RootPlacement::poisson_disc;
    const Texture* mask = nullptr;           // null: everywhere alike
    const PartingLine* parting = nullptr;    // null: none
};

struct Roots {
    std::vector<SurfacePoint> points;  // the hairline's first, in its order
    std::uint32_t boundary_count = 0;
    // Counter-clockwise seen from outside. One root has {0, 0, 0}, two have {0, 1, 1}.
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

// Puts `guides` >= 1 roots on the scalp. A disc without a mask gets poisson_disc roots as
// disc_roots.h says, if it can be flattened; everything else as surface_roots.h says. With a
// parting two rows of the roots run along it, and no triangle reaches over it; fewer guides than
// both rows and three more have none. Throws engine::Error if the mask leaves no place for them.
Roots placeRoots(const Scalp& scalp, const NearestSurface& surface, const RootOptions& options);

}  // namespace hair
