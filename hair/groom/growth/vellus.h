#pragma once

#include <cstdint>

#include "hair/groom/groom.h"
#include "hair/groom/mesh/mesh.h"
#include "hair/groom_settings.h"

// The fine hairs between the scalp and bare skin.
namespace hair::groom {

// Grows vellus hairs, in metres: settings.vellus.share for each of settings.strands, on the mesh on
// either side of the scalp's edge. At the distance d from the edge, their probability is 1 -
// smoothstep(0, band, d). They lie along the surface, in the directions of DirectionField turned by
// up to 25 degrees to either side. They are up to vellus.length long, on the scalp times 1 + d /
// band; the shortest have a third of that. The same arguments give the same hairs. Throws
// engine::Error if the mesh has no such scalp or the scalp has no edge.
StrandSet growVellus(const Mesh& mesh, const GrowSettings& settings, std::uint32_t seed);

}  // namespace hair::groom
