#pragma once

#include <optional>
#include <vector>

#include "engine/image_file.h"
#include "hair/groom/mesh/mesh.h"

namespace hair {

// What a picture shows beside the hair, as files gave it.
struct RenderAssets {
    const Mesh* head = nullptr;  // that the hair grows on; null: none
    std::vector<Mesh> meshes;  // of /render/meshes, in their order
    std::vector<Mesh> field_meshes;  // of /simulation/distance_fields, where bodies are drawn
    std::optional<engine::Pixels> strand_texture;  // of /strands/texture
    std::optional<engine::FloatPixels> environment;  // of /render/environment
};

}  // namespace hair
