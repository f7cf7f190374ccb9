#pragma once

#include <span>
#include <vector>

#include "hair/gpu_structs.h"
#include "hair/groom/mesh/mesh.h"
#include "hair/settings.h"

namespace hair {

// The wire frame of a capsule: a ring at each end of its axis, four lines between them and two
// great half-circles over each end; of a sphere, where a == b, three great circles.
std::vector<gpu::BodyLine> capsuleLines(const Collider& capsule);

// The edges of a mesh, each once.
std::vector<gpu::BodyLine> meshLines(const Mesh& mesh, Follows follows);

// Wire frames of all that hair collides with; `meshes` are those of settings.distance_fields.
std::vector<gpu::BodyLine>
bodyLines(const SimulationSettings& settings, std::span<const Mesh> meshes);

}  // namespace hair
