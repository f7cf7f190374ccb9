#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include <glm/mat4x4.hpp>

#include "hair/groom/mesh/gltf_model.h"
#include "hair/groom/mesh/mesh.h"

namespace hair::groom {

// A primitive where it stands in the scene.
struct GltfPlace {
    const tinygltf::Primitive& primitive;
    const glm::dmat4& transform;  // to the scene, metres
    const std::string& name;      // of the node, or else of the mesh
    int node;
};

// Visits the primitives of the default scene's meshes. Errors, of `visit` as well, begin with the
// mesh and primitive where there is one. Throws engine::Error also where the scene's nodes are no
// tree.
void forEachPrimitive(
    const tinygltf::Model& model, const std::function<void(const GltfPlace& place)>& visit);

// glTF 2.0, .glb or .gltf, with the node transforms of the default scene applied. Reads triangle
// lists, strips and fans with POSITION, NORMAL, TEXCOORD_0, indices, and materials: see
// import_gltf.h. Parts are the nodes, named as they or else their meshes are. Vertex groups are
// the application's own attributes of float scalars from 0 to 1, `_SCALP` as "scalp". Skips other
// primitives; ignores skins and animation. Refuses sparse accessors and required extensions that
// change the geometry.
Mesh importGltf(const std::filesystem::path& path, Textures textures);

}  // namespace hair::groom
