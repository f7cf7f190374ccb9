// The program that reads meshes by assimp for import_mesh.cpp, which limits its time, its memory
// and the files that it may open, because malformed files make assimp write out of bounds, loop, or
// take gigabytes.
#include <algorithm>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <assimp/DefaultIOSystem.h>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include "engine/error.h"
#include "engine/system/process.h"
#include "hair/groom/mesh/mesh_stream.h"

namespace hair::groom {
namespace {

// ---- The scene of assimp ------------------------------------------------------------------------

// Node transforms are applied, polygons triangulated, points and lines left out. Parts are the
// nodes that hold triangles, by their names or those of their meshes: objects and groups in most
// formats. Vertex groups are the bones. Texture coordinates are the first set, 0 for parts without.
// Materials have the diffuse colour, and its texture if that is a file.
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

// The file of the diffuse texture, relative to the mesh's folder; empty if there is none.
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
        ", but there are " + std::to_string(part.mNumVertices));
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

// ---- Files that assimp opens --------------------------------------------------------------------

// Opens only regular files, because a pipe would wait for its writer. With links resolved, they
// must be in the folders; without folders they may be anywhere.
class FileSandbox : public Assimp::DefaultIOSystem {
public:
    explicit FileSandbox(std::vector<std::filesystem::path> folders)
        : folders_(std::move(folders)) {}

    Assimp::IOStream* Open(const char* file, const char* mode = "rb") override {
        if (mode[0] != 'r' || !allows(file)) return nullptr;
        return DefaultIOSystem::Open(file, mode);
    }

    // The default opens the file.
    bool Exists(const char* file) const override { return allows(file); }

    const std::string& refused() const { return refused_; }  // the first; empty: none

private:
    bool allows(const std::filesystem::path& file) const {
        std::error_code error;
        const std::filesystem::path place = std::filesystem::canonical(file, error);
        if (error) return false;
        const auto holds = [&](const std::filesystem::path& folder) {
            return std::mismatch(folder.begin(), folder.end(), place.begin(), place.end()).first ==
                   folder.end();
        };
        const char* reason = nullptr;
        if (!std::filesystem::is_regular_file(place, error)) reason = ": is not a file";
        if (!folders_.empty() && std::ranges::none_of(folders_, holds))
            reason = ": is outside the scene's folder; --allow-outside permits it";
        if (reason && refused_.empty()) refused_ = file.string() + reason;
        return !reason;
    }

    std::vector<std::filesystem::path> folders_;
    mutable std::string refused_;
};

// ---- Size of the result -------------------------------------------------------------------------

// Refuses files that mean far more than their size: the time to triangulate a face grows with the
// square of its corners, and nodes may share meshes.
void checkSizes(const aiScene& scene, std::uintmax_t file_size) {
    constexpr std::uint64_t kMostSteps = 100'000'000;
    std::uint64_t steps = 0;
    for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
        const aiMesh& mesh = *scene.mMeshes[i];
        for (unsigned k = 0; k < mesh.mNumFaces; ++k) {
            const std::uint64_t corners = mesh.mFaces[k].mNumIndices;
            if (corners > 4) steps += corners * corners;
            if (steps > kMostSteps)
                throw engine::Error(
                    "face " + std::to_string(k) + " has " + std::to_string(corners) +
                    " corners: faces with so many would take minutes to cut into triangles");
        }
    }
    const std::uint64_t most = (std::uint64_t{32} << 20) + 16 * file_size;
    constexpr std::uint64_t kVertex = 32, kFace = 16;  // bytes
    std::uint64_t bytes = 0;
    std::vector<const aiNode*> nodes{scene.mRootNode};
    std::size_t count = 0;
    while (!nodes.empty()) {
        const aiNode& node = *nodes.back();
        nodes.pop_back();
        ++count;
        for (unsigned i = 0; i < node.mNumMeshes; ++i) {
            const aiMesh& mesh = *scene.mMeshes[node.mMeshes[i]];
            bytes += kVertex * mesh.mNumVertices + kFace * mesh.mNumFaces;
        }
        if (bytes > most)
            throw engine::Error(
                std::to_string(scene.mNumMeshes) + " meshes at " + std::to_string(count) +
                " nodes expand to more than " + std::to_string(most >> 20) +
                " MiB, the limit of 16 times the file's size plus 32 MiB");
        nodes.insert(nodes.end(), node.mChildren, node.mChildren + node.mNumChildren);
    }
}

// ---- The program --------------------------------------------------------------------------------

// Assimp turns exceptions into their texts.
[[noreturn]] void fail(const Assimp::Importer& importer) {
    const std::string reason = importer.GetErrorString();
    if (reason.find("bad_alloc") != std::string::npos) throw std::bad_alloc();
    throw engine::Error("assimp can't read it: " + reason);
}

ReadMesh
read(const std::filesystem::path& path, const std::vector<std::filesystem::path>& folders) {
    Assimp::Importer importer;
    auto* const sandbox = new FileSandbox(folders);
    importer.SetIOHandler(sandbox);  // takes ownership
    importer.SetPropertyInteger(
        AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, static_cast<int>(kIgnored));
    const aiScene* scene = importer.ReadFile(path.string(), 0);
    if (!sandbox->refused().empty()) throw engine::Error(sandbox->refused());
    if (!scene) fail(importer);
    checkSizes(*scene, std::filesystem::file_size(path));
    scene = importer.ApplyPostProcessing(kSteps);
    if (!scene) fail(importer);
    ReadMesh read;
    for (unsigned i = 0; i < scene->mNumMaterials; ++i) {
        const aiMaterial& material = *scene->mMaterials[i];
        read.mesh.materials.push_back(toMaterial(material));
        read.textures.push_back(textureOf(material));
    }
    appendScene(read.mesh, *scene);
    return read;
}

}  // namespace
}  // namespace hair::groom

// The arguments are the file and the canonical folders in which it and the files that it names may
// be; without folders they may be anywhere. The mesh goes to standard output in the format of
// mesh_stream.h, and an error goes to standard error in one line.
int main(int argc, char** argv) {
    engine::system::prepareStreams();
    try {
        if (argc < 2) throw engine::Error("arguments: a file of a mesh, and folders");
        const std::vector<std::filesystem::path> folders(argv + 2, argv + argc);
        hair::groom::writeMeshStream(std::cout, hair::groom::read(argv[1], folders));
        std::cout.flush();
        return std::cout ? 0 : 1;
    } catch (const std::bad_alloc&) {
        std::cerr << "needs more memory than a file of its size may use\n";
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
    }
    return 1;
}
