#pragma once

#include <cstdint>
#include <filesystem>

#include <glm/vec3.hpp>

#include "hair/groom/groom.h"
#include "hair/groom/growth/parting.h"
#include "hair/groom/growth/scalp.h"
#include "hair/groom/mesh/mesh.h"
#include "hair/groom/mesh/surface.h"
#include "hair/groom_settings.h"
#include "hair/settings.h"

// Guides grown on the scalp of a mesh, and the fine hairs between the scalp and bare skin.
namespace hair::groom {

// The direction in which hair leaves the scalp:
//     normalize(normal + comb + whorl + parting),     the normal alone if they cancel it.
// whorl    along the surface, round the point c of the scalp that is nearest to its position, at
//          the distance r from it: strength (r / radius) exp((1 - (r / radius)^2) / 2), which is
//          `strength` at the radius and less everywhere else.
// parting  along the surface, away from the line at the distance d: strength exp(-d / reach);
//          beyond an end, times the cosine between the way from there and the way across the line.
// With a whorl or a parting, directions are at least asin 0.05 off the surface.
class DirectionField {
public:
    // Borrows its arguments; `parting` may be null.
    DirectionField(
        const GrowSettings& settings, const NearestSurface& surface, const PartingLine* parting);

    glm::dvec3 operator()(const SurfacePoint& root) const;

private:
    const GrowSettings& settings_;
    const PartingLine* parting_;
    glm::dvec3 whorl_centre_{0.0};
};

// Grows `guides` >= 1 guides on the part of the mesh that settings.scalp names, where placeRoots()
// puts roots and in the directions of DirectionField. Along the arc length s the direction d turns
// toward g = (0, -1, 0):
//     d(d)/ds = droop (g - (g . d) d),
// that is, its angle t to g obeys dt/ds = -droop sin t, so tan(t / 2) = tan(t0 / 2) exp(-droop s).
// Segment k of length l runs along d at its middle, s = (k + 1/2) l; all segments of a guide have
// the same length, together settings.length times the length map times 1 - length_variation times a
// random number of the guide in [0, 1), and at least 1 mm.
// root_normals are the scalp's, without the comb. Pictures are files relative to `directory`. The
// same arguments give the same groom. Throws engine::Error if the mesh has no such scalp, if a
// picture can't be read, needs texture coordinates that are not there, or leaves no room for roots.
Groom grow(
    const Mesh& mesh, const GrowSettings& settings, const std::filesystem::path& directory,
    std::uint32_t guides, std::uint32_t seed);

// Grows vellus hairs, in metres: settings.vellus.share for each of settings.strands, on the mesh on
// either side of the scalp's edge. At the distance d from the edge, their probability is 1 -
// smoothstep(0, band, d). They lie along the surface, in the directions of DirectionField turned by
// up to 25 degrees to either side. They are up to vellus.length long, on the scalp times 1 + d /
// band; the shortest have a third of that. The same arguments give the same hairs. Throws
// engine::Error if the mesh has no such scalp or the scalp has no edge.
StrandSet growVellus(const Mesh& mesh, const GrowSettings& settings, std::uint32_t seed);

}  // namespace hair::groom
