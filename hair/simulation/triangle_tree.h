#pragma once

#include <cstdint>
#include <vector>

#include "hair/gpu_structs.h"
#include "hair/groom/mesh/closed_mesh.h"

namespace hair {

// A hierarchy of boxes round triangles, for nearest neighbours. Every node is split in two halves
// with as many triangles, so no path from the root has more than gpu::kTreeDepth nodes.
struct TriangleTree {
    std::vector<gpu::TreeNode> nodes;
    std::vector<std::uint32_t> order;  // the mesh's triangles as the leaves number them
};

// The mesh has at least one triangle.
TriangleTree buildTriangleTree(const ClosedMesh& mesh);

}  // namespace hair
