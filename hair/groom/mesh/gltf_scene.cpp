#include "hair/groom/mesh/gltf_scene.h"

#include <algorithm>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "engine/error.h"
#include "hair/groom/mesh/gltf_accessors.h"

namespace hair {
namespace {

using Visit = std::function<void(const GltfPlace& place)>;

glm::dmat4 localTransform(const tinygltf::Node& node) {
    if (node.matrix.size() == 16) return glm::make_mat4(node.matrix.data());  // both column-major
    glm::dmat4 transform(1.0);
    if (node.translation.size() == 3) {
        transform[3] = glm::dvec4(glm::make_vec3(node.translation.data()), 1.0);
    }
    if (node.rotation.size() == 4) {
        const std::vector<double>& r = node.rotation;  // x, y, z, w
        transform *= glm::mat4_cast(glm::normalize(glm::dquat(r[3], r[0], r[1], r[2])));
    }
    if (node.scale.size() == 3) {
        for (int axis = 0; axis < 3; ++axis)
            transform[axis] *= node.scale[static_cast<std::size_t>(axis)];
    }
    return transform;
}

void visitMesh(
    const tinygltf::Model& model, int node_index, const glm::dmat4& transform, const Visit& visit) {
    const tinygltf::Node& node = at(model.nodes, node_index, "node");
    const tinygltf::Mesh& mesh = at(model.meshes, node.mesh, "mesh");
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
        try {
            visit(
                {mesh.primitives[i], transform, node.name.empty() ? mesh.name : node.name,
                 node_index});
        } catch (const engine::Error& error) {
            throw engine::Error(
                numbered("mesh", node.mesh) + ", primitive " + std::to_string(i), error.what());
        }
    }
}

}  // namespace

void forEachPrimitive(const tinygltf::Model& model, const Visit& visit) {
    struct Step {
        int node;
        glm::dmat4 parent;
    };
    if (model.scenes.empty()) throw engine::Error("the file has no scene");
    std::vector<Step> steps;
    for (const int root : at(model.scenes, std::max(model.defaultScene, 0), "scene").nodes) {
        steps.push_back({root, glm::dmat4(1.0)});
    }
    std::vector<bool> visited(model.nodes.size());
    for (std::size_t next = 0; next < steps.size(); ++next) {
        const auto [index, parent] = steps[next];
        const tinygltf::Node& node = at(model.nodes, index, "node");
        if (visited[static_cast<std::size_t>(index)]) {
            throw engine::Error(numbered("node", index), "is reached twice");
        }
        visited[static_cast<std::size_t>(index)] = true;
        const glm::dmat4 transform = parent * localTransform(node);
        if (node.mesh >= 0) visitMesh(model, index, transform, visit);
        for (const int child : node.children) steps.push_back({child, transform});
    }
}

}  // namespace hair
