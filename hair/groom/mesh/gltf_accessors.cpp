#include "hair/groom/mesh/gltf_accessors.h"

#include <cstring>
#include <limits>
#include <numeric>

namespace hair {
namespace {

// An accessor's elements where they lie in the file, every one of them inside its buffer.
struct Elements {
    const tinygltf::Accessor& accessor;
    std::string name;  // for messages
    const unsigned char* first = nullptr;
    std::size_t stride = 0;  // bytes

    template <class Value>
    Value read(std::size_t index) const {
        Value value;
        std::memcpy(&value, first + index * stride, sizeof value);
        return value;
    }

    [[noreturn]] void refuse(const std::string& expected) const {
        throw engine::Error(name, "is not " + expected);
    }
};

Elements elementsOf(const tinygltf::Model& model, int index) {
    const std::string name = numbered("accessor", index);
    const tinygltf::Accessor& accessor = at(model.accessors, index, "accessor");
    if (accessor.sparse.isSparse) throw engine::Error(name, "sparse accessors are not supported");
    const tinygltf::BufferView& view = at(model.bufferViews, accessor.bufferView, "buffer view");
    const tinygltf::Buffer& buffer = at(model.buffers, view.buffer, "buffer");
    const int stride = accessor.ByteStride(view);
    const int size =
        tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor.componentType)) *
        tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
    if (stride <= 0 || size <= 0) throw engine::Error(name, "unknown type");
    const auto step = static_cast<std::size_t>(stride);
    const auto width = static_cast<std::size_t>(size);
    const std::size_t available = buffer.data.size();
    const bool view_fits =
        view.byteOffset <= available && view.byteLength <= available - view.byteOffset;
    if (!view_fits || accessor.byteOffset > view.byteLength) {
        throw engine::Error(name, "lies outside its buffer");
    }
    const std::size_t room = view.byteLength - accessor.byteOffset;
    if (accessor.count > 0 && (room < width || (room - width) / step < accessor.count - 1)) {
        throw engine::Error(name, "lies outside its buffer");
    }
    return {accessor, name, buffer.data.data() + view.byteOffset + accessor.byteOffset, step};
}

// Each element as it lies there.
template <class Value>
std::vector<Value> copy(const Elements& elements) {
    std::vector<Value> values(elements.accessor.count);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = elements.read<Value>(i);
    return values;
}

// Vectors of integers that stand for 0 to 1.
template <class Vector, class Stored>
std::vector<Vector> copyNormalized(const Elements& elements) {
    using Integer = typename Stored::value_type;
    constexpr auto kOne = static_cast<float>(std::numeric_limits<Integer>::max());
    std::vector<Vector> vectors(elements.accessor.count);
    for (std::size_t i = 0; i < vectors.size(); ++i)
        vectors[i] = Vector(elements.read<Stored>(i)) / kOne;
    return vectors;
}

// `type` is tinygltf's for Vector.
template <glm::length_t size>
std::vector<glm::vec<size, float>> readShares(const Elements& elements, int type) {
    using Vector = glm::vec<size, float>;
    const tinygltf::Accessor& accessor = elements.accessor;
    const std::string expected =
        "VEC" + std::to_string(size) + " of float, or of normalized unsigned bytes or shorts";
    if (accessor.type != type) elements.refuse(expected);
    if (accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT) return copy<Vector>(elements);
    if (!accessor.normalized) elements.refuse(expected);
    switch (accessor.componentType) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return copyNormalized<Vector, glm::vec<size, std::uint8_t>>(elements);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return copyNormalized<Vector, glm::vec<size, std::uint16_t>>(elements);
    default:
        elements.refuse(expected);
    }
}

template <class Integer>
std::vector<std::uint32_t> widen(const Elements& elements) {
    std::vector<std::uint32_t> indices(elements.accessor.count);
    for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = elements.read<Integer>(i);
    return indices;
}

std::vector<std::uint32_t> readUnsigned(const Elements& elements) {
    if (elements.accessor.type != TINYGLTF_TYPE_SCALAR) elements.refuse("SCALAR, for indices");
    switch (elements.accessor.componentType) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return widen<std::uint8_t>(elements);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return widen<std::uint16_t>(elements);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return widen<std::uint32_t>(elements);
    default:
        elements.refuse("of unsigned integers, for indices");
    }
}

void requireFloat(const Elements& elements, int type, const char* expected) {
    if (elements.accessor.type == type &&
        elements.accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT)
        return;
    elements.refuse(expected);
}

}  // namespace

std::optional<int> findAttribute(const tinygltf::Primitive& primitive, const std::string& name) {
    const auto attribute = primitive.attributes.find(name);
    if (attribute == primitive.attributes.end()) return {};
    return attribute->second;
}

std::vector<float> readScalars(const tinygltf::Model& model, int accessor) {
    const Elements elements = elementsOf(model, accessor);
    requireFloat(elements, TINYGLTF_TYPE_SCALAR, "SCALAR of float");
    return copy<float>(elements);
}

std::vector<glm::vec3> readVectors(const tinygltf::Model& model, int accessor) {
    const Elements elements = elementsOf(model, accessor);
    requireFloat(elements, TINYGLTF_TYPE_VEC3, "VEC3 of float");
    return copy<glm::vec3>(elements);
}

std::vector<glm::vec2> readTextureCoordinates(const tinygltf::Model& model, int accessor) {
    return readShares<2>(elementsOf(model, accessor), TINYGLTF_TYPE_VEC2);
}

GltfColors readColors(const tinygltf::Model& model, int accessor) {
    const Elements elements = elementsOf(model, accessor);
    if (elements.accessor.type != TINYGLTF_TYPE_VEC4) {
        return {readShares<3>(elements, TINYGLTF_TYPE_VEC3), {}};
    }
    GltfColors read;
    for (const glm::vec4& color : readShares<4>(elements, TINYGLTF_TYPE_VEC4)) {
        read.colors.emplace_back(color);
        read.opacities.push_back(color.a);
    }
    return read;
}

std::vector<std::uint32_t> readIndices(
    const tinygltf::Model& model, const tinygltf::Primitive& primitive, std::size_t vertex_count) {
    if (primitive.indices < 0) {
        std::vector<std::uint32_t> all(vertex_count);
        std::iota(all.begin(), all.end(), 0u);
        return all;
    }
    std::vector<std::uint32_t> indices = readUnsigned(elementsOf(model, primitive.indices));
    for (std::size_t i = 0; i < indices.size(); ++i) {
        if (indices[i] < vertex_count) continue;
        throw engine::Error(
            "index " + std::to_string(i) + " names vertex " + std::to_string(indices[i]) +
            ", there are " + std::to_string(vertex_count));
    }
    return indices;
}

}  // namespace hair
