#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "engine/error.h"
#include "hair/groom/mesh/gltf_model.h"

// What a glTF file's numbers lead to, with every index and range looked at. Errors begin with what
// is wrong: "accessor 2: ...".
namespace hair {

inline std::string numbered(const char* kind, int index) {
    return kind + (" " + std::to_string(index));
}

template <class Element>
const Element& at(const std::vector<Element>& elements, int index, const char* kind) {
    if (index < 0 || static_cast<std::size_t>(index) >= elements.size()) {
        throw engine::Error(
            "the file names " + numbered(kind, index) + ", it has " +
            std::to_string(elements.size()));
    }
    return elements[static_cast<std::size_t>(index)];
}

// The accessor of a primitive's attribute.
std::optional<int> findAttribute(const tinygltf::Primitive& primitive, const std::string& name);

// Accessors of float.
std::vector<float> readScalars(const tinygltf::Model& model, int accessor);
std::vector<glm::vec3> readVectors(const tinygltf::Model& model, int accessor);

// Accessors of float, or of normalized unsigned bytes or shorts.
std::vector<glm::vec2> readTextureCoordinates(const tinygltf::Model& model, int accessor);

struct GltfColors {
    std::vector<glm::vec3> colors;
    std::vector<float> opacities;  // empty where the accessor is a VEC3
};
GltfColors readColors(const tinygltf::Model& model, int accessor);

// The vertices that a primitive names, all of them below `vertex_count`; 0, 1, 2 ... where it has
// no indices.
std::vector<std::uint32_t> readIndices(
    const tinygltf::Model& model, const tinygltf::Primitive& primitive, std::size_t vertex_count);

}  // namespace hair
