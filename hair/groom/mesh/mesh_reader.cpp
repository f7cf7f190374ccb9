// The program that reads meshes by assimp for import_mesh.cpp: a child process with limits on time
// and memory, because malformed files make assimp write out of bounds, loop, or take gigabytes.
#include <algorithm>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <string>
#include <vector>

#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <sys/resource.h>

#include "engine/error.h"
#include "hair/groom/mesh/mesh_stream.h"

namespace hair::groom {
namespace {

// ---- The scene of assimp ------------------------------------------------------------------------

// Node transforms are applied, polygons triangulated, points and lines left out. Parts are the
// nodes that hold triangles, by their names or those of their meshes: objects and groups in most
// formats. Vertex groups are the bones. Texture coordinates are the first set, 0 for parts without.
// Materials have the diffuse colour, and its texture where that is a file.
constexpr unsigned kSteps = aiProcess_Triangulate | aiProcess_JoinIdenticalVertices |
                            aiProcess_GenSmoothNormals | aiProcess_SortByPType |
                            aiProcess_GlobalScale | aiProcess_RemoveComponent;

// Components that are not read below. Without them, vertices that differ in nothing else are
// joined.
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

// The file of the diffuse texture, relative to the mesh's folder; empty where there is none.
std::string textureOf(const aiMaterial& source) {
    aiString name;
    unsigned coordinates = 0;
    if (source.GetTexture(aiTextureType_DIFFUSE, 0, &name, nullptr, &coordinates) !=
            aiReturn_SUCCESS ||
        name.length == 0 || name.C_Str()[0] == '*' || coordinates != 0)
        return {};
    std::string file = name.C_Str();
    std::ranges::replace(file, '\\', '/');
    return file;
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
    mesh.texture_coordinates.resize(first, glm::vec2(0.0f));  // for earlier parts without any
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

// Adds a vertex group for each bone, with the bone's weights.
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

// Makes a part of a node, with the name of the node or else of its first mesh.
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

// ---- The program --------------------------------------------------------------------------------

ReadMesh read(const std::filesystem::path& path) {
    Assimp::Importer importer;
    importer.SetPropertyInteger(
        AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, static_cast<int>(kIgnored));
    const aiScene* scene = importer.ReadFile(path.string(), kSteps);
    if (!scene) throw engine::Error(importer.GetErrorString());
    ReadMesh read;
    for (unsigned i = 0; i < scene->mNumMaterials; ++i) {
        const aiMaterial& material = *scene->mMaterials[i];
        read.mesh.materials.push_back(toMaterial(material));
        read.textures.push_back(textureOf(material));
    }
    appendScene(read.mesh, *scene);
    return read;
}

// Limits this process to the time and memory that a file of this size can need. Assimp's trees of
// text files are about 40 times as large as the files.
void limitSelf(std::uintmax_t file_size) {
    const rlim_t seconds = 8 + file_size / 2'000'000;
    const rlimit time{.rlim_cur = seconds, .rlim_max = seconds + 1};
    setrlimit(RLIMIT_CPU, &time);
    const rlimit none{.rlim_cur = 0, .rlim_max = 0};
    setrlimit(RLIMIT_CORE, &none);
    setrlimit(RLIMIT_FSIZE, &none);
#ifndef HAIRBENCH_SANITIZE  // sanitizers reserve terabytes of addresses
    const rlim_t bytes = (rlim_t{512} << 20) + 64 * file_size;
    const rlimit memory{.rlim_cur = bytes, .rlim_max = bytes};
    setrlimit(RLIMIT_AS, &memory);
#endif
}

}  // namespace
}  // namespace hair::groom

// The argument is the file. The mesh goes to standard output in the format of mesh_stream.h, and an
// error goes to standard error in one line.
int main(int argc, char** argv) {
    try {
        if (argc != 2) throw engine::Error("one argument: a file of a mesh");
        const std::filesystem::path path = argv[1];
        hair::groom::limitSelf(std::filesystem::file_size(path));
        hair::groom::writeMeshStream(std::cout, hair::groom::read(path));
        std::cout.flush();
        return std::cout ? 0 : 1;
    } catch (const std::bad_alloc&) {
        std::cerr << "needs more memory than a file of its size is given\n";
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
    }
    return 1;
}
