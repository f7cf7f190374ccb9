#pragma once

#include <cstdint>

#include "hair/groom/groom.h"
#include "hair/groom/mesh/mesh.h"
#include "hair/groom_settings.h"

// The hairs between a scalp and what has none.
namespace hair::groom {

// Vellus hairs in metres, settings.vellus.share for each of settings.strands, on the mesh on either
// side of the scalp's edge: as likely at the distance d from it as 1 - smoothstep(0, band, d). They
// lie down along the surface, in the directions of DirectionField turned by up to 25 degrees to
// either side, and are up to vellus.length long, on the scalp times 1 + d / band, the shortest a
// third of that. The same arguments give the same hairs. Throws engine::Error if the mesh has no
// such scalp or that has no edge.
StrandSet growVellus(const Mesh& mesh, const GrowSettings& settings, std::uint32_t seed);

}  // namespace hair::groom
