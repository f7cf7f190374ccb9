#pragma once

#include <cstdint>
#include <filesystem>

#include "hair/groom/groom.h"
#include "hair/groom/mesh/mesh.h"
#include "hair/settings.h"

namespace hair {

// Grows `guides` >= 1 guides on the part of the mesh that settings.scalp names; roots.h says where,
// direction_field.h in which direction. Along the arc length s the direction d turns toward
// g = (0, -1, 0):
//     d(d)/ds = droop (g - (g . d) d),
// that is, its angle t to g obeys dt/ds = -droop sin t, so tan(t / 2) = tan(t0 / 2) exp(-droop s).
// Segment k of length l runs along d at its middle, s = (k + 1/2) l; all segments of a guide have
// the same length, together settings.length times the length map times 1 - length_variation times a
// random number of the guide in [0, 1), and at least 1 mm.
// root_normals are the scalp's, the comb left out. Pictures are files relative to `directory`. The
// same arguments give the same groom. Throws engine::Error if the mesh has no such scalp, a picture
// can't be read or has no texture coordinates to lie on, or leaves no room for roots.
Groom grow(
    const Mesh& mesh, const GrowSettings& settings, const std::filesystem::path& directory,
    std::uint32_t guides, std::uint32_t seed);

}  // namespace hair
