#include "hair/groom/import_mesh.h"

#include <cmath>

#include <glm/geometric.hpp>

#include "engine/error.h"
#include "hair/groom/file_extension.h"
#include "hair/groom/import_assimp.h"
#include "hair/groom/import_gltf.h"

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

void check(const Mesh& mesh) {
    if (mesh.triangles.empty()) throw engine::Error("the mesh has no triangles");
    for (const std::uint32_t material : mesh.triangle_materials) {
        if (material >= mesh.materials.size()) {
            throw engine::Error("no material " + std::to_string(material));
        }
    }
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec3& p = mesh.positions[i];
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
            throw engine::Error("the position of vertex " + std::to_string(i) + " is not finite");
        }
    }
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

Mesh importMesh(const std::filesystem::path& path) {
    try {
        const MeshImporter& importer = importerFor(lowerCaseExtension(path));
        std::error_code error;
        if (!std::filesystem::exists(path, error)) throw engine::Error("no such file");
        if (!std::filesystem::is_regular_file(path, error)) throw engine::Error("not a file");
        Mesh mesh = importer.import(path);
        check(mesh);
        completeNormals(mesh);
        return mesh;
    } catch (const engine::Error& error) {
        throw engine::Error(path.string(), error.what());
    }
}

}  // namespace hair
