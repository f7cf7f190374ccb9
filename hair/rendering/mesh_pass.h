#pragma once

#include <vector>

#include "engine/pipeline.h"
#include "engine/transfer.h"
#include "hair/groom/mesh/mesh.h"

namespace hair {

// A mesh on the device that moves with the head, drawn material by material.
class MeshPass {
public:
    MeshPass(const engine::Device& device, const Mesh& mesh, std::uint32_t samples);

    // Draws into the target that is being rendered to.
    void draw(engine::Commands& commands, std::uint64_t picture) const;

private:
    struct Part {
        glm::vec3 base_color;
        std::uint32_t first_index;
        std::uint32_t index_count;
    };

    engine::Buffer positions_;
    engine::Buffer normals_;
    engine::Buffer indices_;
    std::vector<Part> parts_;
    engine::GraphicsPipeline pipeline_;
};

}  // namespace hair
