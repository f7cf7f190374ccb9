#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "engine/commands.h"
#include "engine/pipeline.h"
#include "engine/sampler.h"
#include "engine/texture.h"
#include "hair/rendering/mesh_geometry.h"
#include "hair/rendering/mesh_materials.h"
#include "hair/rendering/render_assets.h"
#include "hair/settings.h"

namespace hair {

// The meshes of a picture on the device: the head, which moves, and others, which don't. Drawn
// material by material.
class SceneMeshes {
public:
    SceneMeshes(const engine::Device& device, const Settings& settings, const RenderAssets& assets);

    bool empty() const { return meshes_.empty(); }

    // Lit, into the target that is being rendered to. `shadows` are ShadowPass::images().
    void draw(
        engine::Commands& commands, std::uint64_t picture,
        std::span<const engine::SampledImage> shadows) const;

    // Depth alone, of kDepthFormat and one sample: what a light or the eye sees of both sides of
    // the meshes, which may be open. `picture` is the address of the gpu::PictureParameters with
    // its view.
    void drawDepth(engine::Commands& commands, std::uint64_t picture) const;

private:
    enum class Motion { still, with_head };

    struct SceneMesh {
        MeshGeometry geometry;
        MeshMaterials materials;
        Motion motion;
    };

    void
    add(const engine::Device& device, const Settings& settings, const Mesh& mesh, Motion motion);

    void bind(
        engine::Commands& commands, const engine::GraphicsPipeline& pipeline, std::uint64_t picture,
        const SceneMesh& mesh, const MeshMaterial& material) const;

    engine::Texture blank_;
    engine::Sampler blank_sampler_;
    std::vector<SceneMesh> meshes_;
    std::map<MeshLook, engine::GraphicsPipeline> pipelines_;
    std::map<MeshLook, engine::GraphicsPipeline> depth_pipelines_;
};

}  // namespace hair
