#include "hair/rendering/scene_meshes.h"

#include "engine/target.h"
#include "hair/gpu_structs.h"
#include "hair/rendering/target_description.h"

namespace hair {

namespace {

engine::GraphicsDescription pipeline(const MeshLook& look, const Settings& settings) {
    return {
        .shaders = {"scene/mesh.vert", "scene/mesh.frag"},
        .constants = meshConstants(look, settings),
        .push_size = sizeof(gpu::MeshPush),
        .colors = {{colorFormat(settings.render)}},
        .depth_format = engine::Target::kDepthFormat,
        .samples = settings.render.msaa,
        .cull = look.double_sided ? VK_CULL_MODE_NONE : VK_CULL_MODE_BACK_BIT,
        .sampled_images = kMeshImages};
}

// What depth depends on.
MeshLook depthLook(const MeshLook& look) {
    return {.base_color_texture = look.mask && look.base_color_texture, .mask = look.mask};
}

engine::GraphicsDescription depthPipeline(const MeshLook& look, const Settings& settings) {
    engine::GraphicsDescription description{
        .shaders = {"scene/mesh.vert"},
        .constants = meshConstants(look, settings),
        .push_size = sizeof(gpu::MeshPush),
        .depth_format = engine::Target::kDepthFormat};
    if (look.mask) {
        description.shaders.push_back("scene/mesh_depth.frag");
        description.sampled_images = kMaterialImages;
    }
    return description;
}

}  // namespace

SceneMeshes::SceneMeshes(
    const engine::Device& device, const Settings& settings, const RenderAssets& assets)
    : blank_(
          device, {1, 1, {255, 255, 255, 255}}, engine::Texels::data, engine::Decoding::none,
          "no texture"),
      blank_sampler_(device, {}) {
    if (assets.head && settings.render.head) add(device, settings, *assets.head, Motion::with_head);
    for (std::size_t i = 0; i < assets.meshes.size(); ++i)
        add(device, settings, placed(assets.meshes[i], settings.render.meshes.at(i)),
            Motion::still);
}

void SceneMeshes::add(
    const engine::Device& device, const Settings& settings, const Mesh& mesh, Motion motion) {
    const SceneMesh& added = meshes_.emplace_back(SceneMesh{
        {device, mesh},
        {device, settings.render, mesh, {&blank_.image(), &blank_sampler_}},
        motion});
    for (const MeshGeometry::Part& part : added.geometry.parts) {
        const MeshLook look = added.materials.materials()[part.material].look;
        if (!pipelines_.contains(look))
            pipelines_.try_emplace(look, device, pipeline(look, settings));
        const MeshLook depth_look = depthLook(look);
        if (!depth_pipelines_.contains(depth_look))
            depth_pipelines_.try_emplace(depth_look, device, depthPipeline(depth_look, settings));
    }
}

void SceneMeshes::bind(
    engine::Commands& commands, const engine::GraphicsPipeline& pipeline, std::uint64_t picture,
    const SceneMesh& mesh, const MeshMaterial& material) const {
    commands.bind(
        pipeline, gpu::MeshPush{
                      .picture = picture,
                      .positions = mesh.geometry.positions.address(),
                      .normals = mesh.geometry.normals.address(),
                      .texture_coordinates = mesh.geometry.texture_coordinates.address(),
                      .base_color = material.base_color,
                      .opacity = material.opacity,
                      .metallic = material.metallic,
                      .roughness = material.roughness,
                      .normal_scale = material.normal_scale,
                      .cutoff = material.cutoff,
                      .is_moving = mesh.motion == Motion::with_head ? 1u : 0u});
}

void SceneMeshes::draw(
    engine::Commands& commands, std::uint64_t picture,
    std::span<const engine::SampledImage> shadows) const {
    for (const SceneMesh& mesh : meshes_) {
        for (const MeshGeometry::Part& part : mesh.geometry.parts) {
            const MeshMaterial& material = mesh.materials.materials()[part.material];
            const engine::GraphicsPipeline& pipeline = pipelines_.at(material.look);
            bind(commands, pipeline, picture, mesh, material);
            std::vector<engine::SampledImage> images(
                material.images.begin(), material.images.end());
            images.insert(images.end(), shadows.begin(), shadows.end());
            commands.images(pipeline, images);
            commands.drawIndexed(mesh.geometry.indices, part.first_index, part.index_count);
        }
    }
}

void SceneMeshes::drawDepth(engine::Commands& commands, std::uint64_t picture) const {
    for (const SceneMesh& mesh : meshes_) {
        for (const MeshGeometry::Part& part : mesh.geometry.parts) {
            const MeshMaterial& material = mesh.materials.materials()[part.material];
            const engine::GraphicsPipeline& pipeline =
                depth_pipelines_.at(depthLook(material.look));
            bind(commands, pipeline, picture, mesh, material);
            if (material.look.mask) commands.images(pipeline, material.images);
            commands.drawIndexed(mesh.geometry.indices, part.first_index, part.index_count);
        }
    }
}

}  // namespace hair
