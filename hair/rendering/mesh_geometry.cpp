#include "hair/rendering/mesh_geometry.h"

#include <algorithm>

#include <glm/ext/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

namespace hair {

namespace {

// Corner indices of the triangles, those of the first material first.
std::vector<std::uint32_t> sortedIndices(const Mesh& mesh) {
    std::vector<std::uint32_t> order(mesh.triangles.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::ranges::stable_sort(
        order, {}, [&](std::uint32_t triangle) { return mesh.triangle_materials[triangle]; });
    std::vector<std::uint32_t> indices;
    indices.reserve(3 * order.size());
    for (const std::uint32_t triangle : order)
        indices.insert(
            indices.end(), mesh.triangles[triangle].begin(), mesh.triangles[triangle].end());
    return indices;
}

}  // namespace

Mesh placed(Mesh mesh, const MeshSettings& settings) {
    glm::mat4 turn(1.0f);
    for (int axis = 2; axis >= 0; --axis) {
        glm::vec3 direction(0.0f);
        direction[axis] = 1.0f;
        turn = glm::rotate(turn, glm::radians(settings.rotation[axis]), direction);
    }
    const glm::mat3 rotation(turn);
    for (glm::vec3& position : mesh.positions)
        position = settings.translation + rotation * (settings.scale * position);
    for (glm::vec3& normal : mesh.normals) normal = rotation * normal;
    return mesh;
}

MeshGeometry::MeshGeometry(const engine::Device& device, const Mesh& mesh)
    : positions(engine::makeBuffer(device, std::span(mesh.positions), "mesh positions")),
      normals(engine::makeBuffer(device, std::span(mesh.normals), "mesh normals")),
      texture_coordinates(engine::makeBuffer(
          device, std::span(mesh.texture_coordinates), "mesh texture coordinates")),
      indices(engine::makeBuffer(
          device, std::span<const std::uint32_t>(sortedIndices(mesh)), "mesh indices")) {
    std::uint32_t first = 0;
    for (std::uint32_t material = 0; material < mesh.materials.size(); ++material) {
        const auto triangles =
            static_cast<std::uint32_t>(std::ranges::count(mesh.triangle_materials, material));
        if (triangles > 0) parts.push_back({material, first, 3 * triangles});
        first += 3 * triangles;
    }
}

}  // namespace hair
