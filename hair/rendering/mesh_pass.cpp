#include "hair/rendering/mesh_pass.h"

#include "engine/target.h"
#include "hair/gpu_structs.h"

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

MeshPass::MeshPass(const engine::Device& device, const Mesh& mesh, std::uint32_t samples)
    : positions_(engine::makeBuffer(device, std::span(mesh.positions), "mesh positions")),
      normals_(engine::makeBuffer(device, std::span(mesh.normals), "mesh normals")),
      indices_(engine::makeBuffer(
          device, std::span<const std::uint32_t>(sortedIndices(mesh)), "mesh indices")),
      pipeline_(
          device, {.shaders = {"scene/mesh.vert", "scene/mesh.frag"},
                   .push_size = sizeof(gpu::MeshPush),
                   .color_format = engine::Target::kColorFormat,
                   .depth_format = engine::Target::kDepthFormat,
                   .samples = samples,
                   .cull = VK_CULL_MODE_BACK_BIT}) {
    std::uint32_t first = 0;
    for (std::uint32_t material = 0; material < mesh.materials.size(); ++material) {
        const auto triangles =
            static_cast<std::uint32_t>(std::ranges::count(mesh.triangle_materials, material));
        parts_.push_back({mesh.materials[material].base_color, first, 3 * triangles});
        first += 3 * triangles;
    }
}

void MeshPass::draw(engine::Commands& commands, std::uint64_t picture) const {
    for (const Part& part : parts_) {
        if (part.index_count == 0) continue;
        commands.bind(
            pipeline_, gpu::MeshPush{
                           .picture = picture,
                           .positions = positions_.address(),
                           .normals = normals_.address(),
                           .base_color = part.base_color});
        commands.drawIndexed(indices_, part.first_index, part.index_count);
    }
}

}  // namespace hair
