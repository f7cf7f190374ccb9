#pragma once

#include <memory>
#include <span>
#include <vector>

#include "engine/pipeline.h"
#include "engine/target.h"
#include "engine/transfer.h"
#include "hair/rendering/render_assets.h"
#include "hair/settings.h"

namespace hair {

// The meshes of a picture on the device: the head, which moves, and others. Drawn material by
// material.
class SceneMeshes {
public:
    SceneMeshes(
        const engine::Device& device, const Settings& settings, const RenderAssets& assets);

    bool empty() const { return meshes_.empty(); }

    // Lit, into the target that is being rendered to. `shadows` are ShadowPass::images().
    void draw(
        engine::Commands& commands, std::uint64_t picture,
        std::span<const engine::SampledImage> shadows) const;

    // Depth alone, of kDepthFormat: what a light or the eye sees. `picture` is the address of the
    // gpu::PictureParameters with its view.
    void drawDepth(engine::Commands& commands, std::uint64_t picture) const;

private:
    struct Part {
        glm::vec3 base_color;
        std::uint32_t first_index;
        std::uint32_t index_count;
    };
    struct MeshBuffers {
        engine::Buffer positions;
        engine::Buffer normals;
        engine::Buffer indices;
        std::vector<Part> parts;
    };

    std::vector<MeshBuffers> meshes_;
    engine::GraphicsPipeline pipeline_;
};

}  // namespace hair
