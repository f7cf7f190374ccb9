#include "hair/groom/mesh/import_mesh.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <filesystem>

#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <glm/geometric.hpp>

#include "engine/error.h"
#include "engine/files.h"
#include "hair/groom/files.h"
#include "hair/groom/mesh/import_gltf.h"
#include "hair/groom/mesh/mesh.h"

namespace hair::groom {
namespace {

// ---- Import assimp ------------------------------------------------------------------------------

constexpr unsigned kSteps = aiProcess_Triangulate | aiProcess_JoinIdenticalVertices |
                            aiProcess_GenSmoothNormals | aiProcess_SortByPType |
                            aiProcess_GlobalScale | aiProcess_RemoveComponent;

// What isn't read below: with it gone, vertices that differ in nothing else are joined.
constexpr unsigned kIgnored =
    aiComponent_TANGENTS_AND_BITANGENTS | aiComponent_COLORS | aiComponent_TEXCOORDSn(1) |
    aiComponent_TEXCOORDSn(2) | aiComponent_TEXCOORDSn(3) | aiComponent_TEXCOORDSn(4) |
    aiComponent_TEXCOORDSn(5) | aiComponent_TEXCOORDSn(6) | aiComponent_ANIMATIONS |
    aiComponent_TEXTURES | aiComponent_LIGHTS | aiComponent_CAMERAS;

Material toMaterial(const aiMaterial& source) {
    Material material{.name = source.GetName().C_Str()};
    aiColor3D color;
    if (source.Get(AI_MATKEY_COLOR_DIFFUSE, color) == aiReturn_SUCCESS) {
        material.base_color = {color.r, color.g, color.b};
    }
    return material;
}

// Reads the diffuse texture, where it is a file beside the mesh's.
void readTexture(const aiMaterial& source, const std::filesystem::path& folder, Mesh& mesh) {
    aiString name;
    unsigned coordinates = 0;
    if (source.GetTexture(aiTextureType_DIFFUSE, 0, &name, nullptr, &coordinates) !=
            aiReturn_SUCCESS ||
        name.length == 0 || name.C_Str()[0] == '*' || coordinates != 0)
        return;
    std::string file = name.C_Str();
    std::ranges::replace(file, '\\', '/');
    mesh.materials.back().base_color_texture = {
        .picture = static_cast<std::uint32_t>(mesh.pictures.size())};
    mesh.pictures.push_back(engine::readImage(folder / file));
}

void checkVertex(unsigned vertex, const aiMesh& part, const std::string& what) {
    if (vertex < part.mNumVertices) return;
    throw engine::Error(
        what + " of mesh '" + part.mName.C_Str() + "' names vertex " + std::to_string(vertex) +
        ", there are " + std::to_string(part.mNumVertices));
}

// Positions, normals and texture coordinates.
void appendVertices(Mesh& mesh, const aiMesh& part, const aiMatrix4x4& transform) {
    aiMatrix3x3 normal_transform(transform);
    normal_transform.Inverse().Transpose();
    const std::size_t first = mesh.positions.size();
    for (unsigned i = 0; i < part.mNumVertices; ++i) {
        const aiVector3D position = transform * part.mVertices[i];
        const aiVector3D normal = part.HasNormals() ? part.mNormals[i] : aiVector3D(0.0f);
        const aiVector3D turned = normal_transform * normal;
        mesh.positions.emplace_back(position.x, position.y, position.z);
        mesh.normals.emplace_back(turned.x, turned.y, turned.z);
    }
    if (!part.HasTextureCoords(0)) return;
    mesh.texture_coordinates.resize(first, glm::vec2(0.0f));  // of the parts without
    for (unsigned i = 0; i < part.mNumVertices; ++i) {
        const aiVector3D& coordinate = part.mTextureCoords[0][i];
        mesh.texture_coordinates.emplace_back(coordinate.x, 1.0f - coordinate.y);  // v was up
    }
}

void appendTriangles(
    Mesh& mesh, const aiMesh& part, std::uint32_t first, const aiMatrix4x4& transform) {
    const bool mirrored = transform.Determinant() < 0.0f;
    for (unsigned i = 0; i < part.mNumFaces; ++i) {
        const aiFace& face = part.mFaces[i];
        if (face.mNumIndices != 3) continue;
        for (unsigned corner = 0; corner < 3; ++corner)
            checkVertex(face.mIndices[corner], part, "triangle " + std::to_string(i));
        mesh.triangles.push_back(
            {first + face.mIndices[0], first + face.mIndices[mirrored ? 2 : 1],
             first + face.mIndices[mirrored ? 1 : 2]});
        mesh.triangle_materials.push_back(part.mMaterialIndex);
    }
}

// Bones: what moves with one is what was painted with its weight.
void appendGroups(Mesh& mesh, const aiMesh& part, std::uint32_t first) {
    for (unsigned i = 0; i < part.mNumBones; ++i) {
        const aiBone& bone = *part.mBones[i];
        auto group = std::ranges::find(mesh.vertex_groups, bone.mName.C_Str(), &VertexGroup::name);
        if (group == mesh.vertex_groups.end())
            group = mesh.vertex_groups.insert(group, {.name = bone.mName.C_Str()});
        group->weights.resize(mesh.positions.size(), 0.0f);
        for (unsigned k = 0; k < bone.mNumWeights; ++k) {
            const aiVertexWeight& weight = bone.mWeights[k];
            checkVertex(weight.mVertexId, part, std::string("bone '") + bone.mName.C_Str() + "'");
            group->weights[first + weight.mVertexId] = weight.mWeight;
        }
    }
}

// A node is a part, by its own name or that of what it holds.
void appendNode(
    Mesh& mesh, const aiScene& scene, const aiNode& node, const aiMatrix4x4& transform) {
    if (node.mNumMeshes == 0) return;
    const aiMesh& first_mesh = *scene.mMeshes[node.mMeshes[0]];
    const auto part_index = static_cast<std::uint32_t>(mesh.parts.size());
    mesh.parts.emplace_back(node.mName.length > 0 ? node.mName.C_Str() : first_mesh.mName.C_Str());
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
        const aiMesh& part = *scene.mMeshes[node.mMeshes[i]];
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        appendVertices(mesh, part, transform);
        appendTriangles(mesh, part, first, transform);
        appendGroups(mesh, part, first);
    }
    mesh.triangle_parts.resize(mesh.triangles.size(), part_index);
}

void appendScene(Mesh& mesh, const aiScene& scene) {
    struct Visit {
        const aiNode* node;
        aiMatrix4x4 parent;
    };
    std::vector<Visit> visits{{scene.mRootNode, aiMatrix4x4()}};
    while (!visits.empty()) {
        const Visit visit = visits.back();
        visits.pop_back();
        const aiMatrix4x4 transform = visit.parent * visit.node->mTransformation;
        appendNode(mesh, scene, *visit.node, transform);
        for (unsigned i = visit.node->mNumChildren; i > 0; --i)
            visits.push_back({visit.node->mChildren[i - 1], transform});
    }
    if (!mesh.texture_coordinates.empty())
        mesh.texture_coordinates.resize(mesh.positions.size(), glm::vec2(0.0f));
    for (VertexGroup& group : mesh.vertex_groups) group.weights.resize(mesh.positions.size(), 0.0f);
}

// Whatever assimp reads, with node transforms applied, polygons triangulated, points and lines left
// out. Parts are the nodes that hold triangles, by their names or those of their meshes: objects
// and groups in most formats. Vertex groups are the bones. Texture coordinates are the first set, 0
// for parts without. Of materials, the diffuse colour and its texture where that is a file.
Mesh importAssimp(const std::filesystem::path& path, Textures textures) {
    Assimp::Importer importer;
    importer.SetPropertyInteger(
        AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, static_cast<int>(kIgnored));
    const aiScene* scene = importer.ReadFile(path.string(), kSteps);
    if (!scene) throw engine::Error(importer.GetErrorString());
    Mesh mesh;
    for (unsigned i = 0; i < scene->mNumMaterials; ++i) {
        const aiMaterial& material = *scene->mMaterials[i];
        mesh.materials.push_back(toMaterial(material));
        if (textures == Textures::decoded) readTexture(material, path.parent_path(), mesh);
    }
    appendScene(mesh, *scene);
    return mesh;
}

// ---- Import mesh --------------------------------------------------------------------------------

constexpr std::array<std::string_view, 2> gltf_extensions{".glb", ".gltf"};
constexpr std::array<std::string_view, 6> assimp_extensions{".obj", ".ply", ".stl",
                                                            ".off", ".fbx", ".dae"};
constexpr std::array mesh_importers{
    MeshImporter{gltf_extensions, importGltf},
    MeshImporter{assimp_extensions, importAssimp},
};

const MeshImporter& importerFor(const std::filesystem::path& path) {
    const std::string extension = lowerCaseExtension(path);
    std::string known;
    for (const MeshImporter& importer : mesh_importers) {
        for (const std::string_view name : importer.extensions) {
            if (name == extension) return importer;
            known.append(known.empty() ? "" : ", ").append(name);
        }
    }
    throw engine::Error(
        path.string(), "unknown mesh format '" + extension + "'; known are " + known);
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
    const MeshImporter& importer = importerFor(path);
    engine::OpenFile{path};  // what can't be opened is refused in the same words for every format
    try {
        Mesh mesh = importer.import(path, textures);
        check(mesh);
        completeNormals(mesh);
        return mesh;
    } catch (const engine::Error& error) {
        throw engine::Error(path.string(), error.what());
    }
}

}  // namespace hair::groom
