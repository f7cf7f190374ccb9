#include "hair/groom/mesh/import_mesh.h"

#include <cassert>
#include <cmath>

#include <glm/geometric.hpp>

#include "engine/error.h"
#include "hair/groom/file_extension.h"
#include "hair/groom/mesh/import_assimp.h"
#include "hair/groom/mesh/import_gltf.h"

namespace hair {
namespace {

constexpr std::array<std::string_view, 2> gltf_extensions{".glb", ".gltf"};
constexpr std::array<std::string_view, 6> assimp_extensions{".obj", ".ply", ".stl",
                                                            ".off", ".fbx", ".dae"};
constexpr std::array mesh_importers{
    MeshImporter{gltf_extensions, importGltf},
    MeshImporter{assimp_extensions, importAssimp},
};

const MeshImporter& importerFor(const std::string& extension) {
    std::string known;
    for (const MeshImporter& importer : mesh_importers) {
        for (const std::string_view name : importer.extensions) {
            if (name == extension) return importer;
            known.append(known.empty() ? "" : ", ").append(name);
        }
    }
    throw engine::Error("unknown mesh format '" + extension + "'; known are " + known);
}

bool isFinite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void checkVertices(const Mesh& mesh) {
    const std::size_t count = mesh.positions.size();
    for (std::size_t i = 0; i < count; ++i) {
        if (isFinite(mesh.positions[i])) continue;
        throw engine::Error("the position of vertex " + std::to_string(i) + " is not finite");
    }
    assert(mesh.texture_coordinates.empty() || mesh.texture_coordinates.size() == count);
    for (std::size_t i = 0; i < mesh.texture_coordinates.size(); ++i) {
        if (isFinite({mesh.texture_coordinates[i], 0.0f})) continue;
        throw engine::Error(
            "the texture coordinate of vertex " + std::to_string(i) + " is not finite");
    }
    for (const VertexGroup& group : mesh.vertex_groups) {
        assert(group.weights.size() == count);
        for (std::size_t i = 0; i < count; ++i) {
            if (group.weights[i] >= 0.0f && group.weights[i] <= 1.0f) continue;
            throw engine::Error(
                "the weight of vertex " + std::to_string(i) + " in group '" + group.name +
                "' is outside [0, 1]");
        }
    }
}

void check(const Mesh& mesh) {
    if (mesh.triangles.empty()) throw engine::Error("the mesh has no triangles");
    for (const std::uint32_t material : mesh.triangle_materials) {
        if (material >= mesh.materials.size()) {
            throw engine::Error("no material " + std::to_string(material));
        }
    }
    assert(mesh.triangle_parts.empty() || mesh.triangle_parts.size() == mesh.triangles.size());
    for (const std::uint32_t part : mesh.triangle_parts) {
        if (part >= mesh.parts.size()) throw engine::Error("no part " + std::to_string(part));
    }
    checkVertices(mesh);
}

// Keeps the normals that the file has; the others become the sum of the vertex's triangle normals
// weighted by area.
void completeNormals(Mesh& mesh) {
    std::vector<glm::vec3> sums(mesh.positions.size(), glm::vec3(0.0f));
    for (const auto& [a, b, c] : mesh.triangles) {
        const glm::vec3 edge = mesh.positions[b] - mesh.positions[a];
        const glm::vec3 normal = glm::cross(edge, mesh.positions[c] - mesh.positions[a]);
        for (const std::uint32_t vertex : {a, b, c}) sums[vertex] += normal;
    }
    mesh.normals.resize(mesh.positions.size(), glm::vec3(0.0f));
    for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
        for (const glm::vec3 candidate : {mesh.normals[i], sums[i], glm::vec3(0.0f, 1.0f, 0.0f)}) {
            const float length = glm::length(candidate);
            if (!(length > 0.0f) || !std::isfinite(length)) continue;
            mesh.normals[i] = candidate / length;
            break;
        }
    }
}

}  // namespace

std::span<const MeshImporter> meshImporters() { return mesh_importers; }

Mesh importMesh(const std::filesystem::path& path, Textures textures) {
    try {
        const MeshImporter& importer = importerFor(lowerCaseExtension(path));
        std::error_code error;
        if (!std::filesystem::exists(path, error)) throw engine::Error("no such file");
        if (!std::filesystem::is_regular_file(path, error)) throw engine::Error("not a file");
        Mesh mesh = importer.import(path, textures);
        check(mesh);
        completeNormals(mesh);
        return mesh;
    } catch (const engine::Error& error) {
        throw engine::Error(path.string(), error.what());
    }
}

}  // namespace hair
