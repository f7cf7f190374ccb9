#include "hair/groom/import_assimp.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include "engine/error.h"

namespace hair {
namespace {

constexpr unsigned kSteps = aiProcess_Triangulate | aiProcess_JoinIdenticalVertices |
                            aiProcess_GenSmoothNormals | aiProcess_SortByPType |
                            aiProcess_GlobalScale | aiProcess_PreTransformVertices;

// What isn't read below: with it gone, vertices that differ in nothing else are joined.
constexpr int kIgnored = aiComponent_TANGENTS_AND_BITANGENTS | aiComponent_COLORS |
                         aiComponent_TEXCOORDS | aiComponent_BONEWEIGHTS | aiComponent_ANIMATIONS |
                         aiComponent_TEXTURES | aiComponent_LIGHTS | aiComponent_CAMERAS;

glm::vec3 toVec3(const aiVector3D& v) { return {v.x, v.y, v.z}; }

Material toMaterial(const aiMaterial& source) {
    Material material{.name = source.GetName().C_Str()};
    aiColor3D color;
    if (source.Get(AI_MATKEY_COLOR_DIFFUSE, color) == aiReturn_SUCCESS) {
        material.base_color = {color.r, color.g, color.b};
    }
    return material;
}

void append(Mesh& mesh, const aiMesh& part) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (unsigned i = 0; i < part.mNumVertices; ++i) {
        mesh.positions.push_back(toVec3(part.mVertices[i]));
        mesh.normals.push_back(part.HasNormals() ? toVec3(part.mNormals[i]) : glm::vec3(0.0f));
    }
    for (unsigned i = 0; i < part.mNumFaces; ++i) {
        const aiFace& face = part.mFaces[i];
        if (face.mNumIndices != 3) continue;
        for (unsigned corner = 0; corner < 3; ++corner) {
            if (face.mIndices[corner] >= part.mNumVertices) {
                throw engine::Error(
                    "triangle " + std::to_string(i) + " of mesh '" + part.mName.C_Str() +
                    "' names vertex " + std::to_string(face.mIndices[corner]) + ", there are " +
                    std::to_string(part.mNumVertices));
            }
        }
        mesh.triangles.push_back(
            {first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]});
        mesh.triangle_materials.push_back(part.mMaterialIndex);
    }
}

}  // namespace

Mesh importAssimp(const std::filesystem::path& path) {
    Assimp::Importer importer;
    importer.SetPropertyInteger(
        AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, kIgnored);
    const aiScene* scene = importer.ReadFile(path.string(), kSteps | aiProcess_RemoveComponent);
    if (!scene) throw engine::Error(importer.GetErrorString());
    Mesh mesh;
    for (unsigned i = 0; i < scene->mNumMaterials; ++i) {
        mesh.materials.push_back(toMaterial(*scene->mMaterials[i]));
    }
    for (unsigned i = 0; i < scene->mNumMeshes; ++i) append(mesh, *scene->mMeshes[i]);
    return mesh;
}

}  // namespace hair
