#pragma once

#include <vector>

#include "engine/transfer.h"
#include "hair/groom/mesh/mesh.h"
#include "hair/settings.h"

namespace hair {

// The mesh where the settings place it.
Mesh placed(Mesh mesh, const MeshSettings& settings);

// A mesh's triangles on the device, sorted by material.
struct MeshGeometry {
    // The triangles of one material.
    struct Part {
        std::uint32_t material;
        std::uint32_t first_index;
        std::uint32_t index_count;  // above 0
    };

    MeshGeometry(const engine::Device& device, const Mesh& mesh);

    engine::Buffer positions;  // vec3
    engine::Buffer normals;  // vec3
    engine::Buffer texture_coordinates;  // vec2; of the mesh, which may have none
    engine::Buffer indices;
    std::vector<Part> parts;
};

}  // namespace hair
