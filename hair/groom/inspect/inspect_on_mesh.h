#pragma once

#include "hair/groom/inspect.h"

namespace hair {

// The mesh, in metres, has a triangle at least.
MeshFindings inspectOnMesh(const StrandSet& strands, const Mesh& mesh, double metres_per_unit);

}  // namespace hair
