#pragma once

#include "hair/groom/growth/roots.h"

namespace hair {

// Puts roots on a scalp of any shape and spans them as surface_triangles.h says. How many there are
// in an area is in proportion to the mask there. `random` roots are independent of each other;
// `poisson_disc` ones are spread over what isn't black, then each is kept with the probability that
// the mask gives. No triangle reaches over what is black. Throws engine::Error if the scalp has no
// room for them or the mask can't be used.
Roots surfaceRoots(
    const Scalp& scalp, const NearestSurface& surface, const RootOptions& options,
    const PartingRows* rows);

}  // namespace hair
