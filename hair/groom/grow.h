#pragma once

#include <cstdint>

#include "hair/groom/groom.h"
#include "hair/groom/mesh.h"
#include "hair/settings.h"

namespace hair {

// Grows `guides` >= 3 guides on the triangles of the mesh whose material is named "scalp"; roots.h
// says where. The root lies on the surface, and the direction there is
//     normalize(normal + comb)        the normal alone where comb cancels it.
// Along the arc length s the direction d turns toward g = (0, -1, 0):
//     d(d)/ds = droop (g - (g . d) d),
// that is, its angle t to g obeys dt/ds = -droop sin t, so tan(t / 2) = tan(t0 / 2) exp(-droop s).
// Segment k of length l runs along d at its middle, s = (k + 1/2) l; all segments have the length
// settings.length / (settings.vertices - 1).
// root_normals are the scalp's, the comb left out. The same arguments give the same groom. Throws
// engine::Error if the mesh has no scalp that hair can grow on.
Groom grow(
    const Mesh& mesh, const GrowSettings& settings, std::uint32_t guides, std::uint32_t seed);

}  // namespace hair
