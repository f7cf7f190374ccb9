#include "hair/rendering/scene_meshes.h"

#include <algorithm>

#include "engine/target.h"
#include "hair/gpu_structs.h"
#include "hair/rendering/target_description.h"

namespace hair {

namespace {

// Corner indices of the triangles, those of the first material first.
std::vector<std::uint32_t> sortedIndices(const Mesh& mesh) {
    std::vector<std::uint32_t> indices;
    indices.reserve(3 * mesh.triangles.size());
    for (std::uint32_t material = 0; material < mesh.materials.size(); ++material) {
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
            if (mesh.triangle_materials[i] != material) continue;
            indices.insert(indices.end(), mesh.triangles[i].begin(), mesh.triangles[i].end());
        }
    }
    return indices;
}

}  // namespace

SceneMeshes::SceneMeshes(
    const engine::Device& device, const Settings& settings, const RenderAssets& assets)
    : pipeline_(
          device, {.shaders = {"scene/mesh.vert", "scene/mesh.frag"},
                   .push_size = sizeof(gpu::MeshPush),
                   .colors = {{colorFormat(settings.render)}},
                   .depth_format = engine::Target::kDepthFormat,
                   .samples = settings.render.msaa,
                   .cull = VK_CULL_MODE_BACK_BIT}) {
    if (!assets.head || !settings.render.head) return;
    const Mesh& mesh = *assets.head;
    MeshBuffers buffers{
        engine::makeBuffer(device, std::span(mesh.positions), "mesh positions"),
        engine::makeBuffer(device, std::span(mesh.normals), "mesh normals"),
        engine::makeBuffer(
            device, std::span<const std::uint32_t>(sortedIndices(mesh)), "mesh indices"),
        {}};
    std::uint32_t first = 0;
    for (std::uint32_t material = 0; material < mesh.materials.size(); ++material) {
        const auto triangles =
            static_cast<std::uint32_t>(std::ranges::count(mesh.triangle_materials, material));
        buffers.parts.push_back({mesh.materials[material].base_color, first, 3 * triangles});
        first += 3 * triangles;
    }
    meshes_.push_back(std::move(buffers));
}

void SceneMeshes::draw(
    engine::Commands& commands, std::uint64_t picture,
    std::span<const engine::SampledImage>) const {
    for (const MeshBuffers& mesh : meshes_) {
        for (const Part& part : mesh.parts) {
            if (part.index_count == 0) continue;
            commands.bind(
                pipeline_, gpu::MeshPush{
                               .picture = picture,
                               .positions = mesh.positions.address(),
                               .normals = mesh.normals.address(),
                               .base_color = part.base_color});
            commands.drawIndexed(mesh.indices, part.first_index, part.index_count);
        }
    }
}

void SceneMeshes::drawDepth(engine::Commands&, std::uint64_t) const {}

}  // namespace hair
