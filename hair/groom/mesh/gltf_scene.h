#pragma once

#include <functional>
#include <string>

#include <glm/mat4x4.hpp>

#include "hair/groom/mesh/gltf_model.h"

namespace hair {

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

}  // namespace hair
