#include "hair/groom/import_gltf.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>

#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>

// The only unit that sees tinygltf: assimp's libdraco exports a tinygltf of its own, so this one is
// compiled in here, with hidden visibility.
#include <nlohmann/json.hpp>
#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_INCLUDE_JSON
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#include <tiny_gltf.h>

#include "engine/error.h"

namespace hair {
namespace {

std::string describe(const char* kind, int index) { return kind + (" " + std::to_string(index)); }

template <class Element>
const Element& at(const std::vector<Element>& elements, int index, const char* kind) {
    if (index < 0 || static_cast<std::size_t>(index) >= elements.size()) {
        throw engine::Error(
            "the file names " + describe(kind, index) + ", it has " +
            std::to_string(elements.size()));
    }
    return elements[static_cast<std::size_t>(index)];
}

// An accessor's elements where they lie in the file, every one of them inside its buffer.
struct Elements {
    const unsigned char* first = nullptr;
    std::size_t stride = 0;  // bytes
    std::size_t count = 0;

    template <class Value>
    Value read(std::size_t index) const {
        Value value;
        std::memcpy(&value, first + index * stride, sizeof value);
        return value;
    }
};

Elements elements(const tinygltf::Model& model, int index) {
    const std::string name = describe("accessor", index);
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
    return {buffer.data.data() + view.byteOffset + accessor.byteOffset, step, accessor.count};
}

std::vector<glm::vec3> readVectors(const tinygltf::Model& model, int index) {
    const tinygltf::Accessor& accessor = at(model.accessors, index, "accessor");
    if (accessor.type != TINYGLTF_TYPE_VEC3 ||
        accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT) {
        throw engine::Error(describe("accessor", index), "is not VEC3 of float");
    }
    const Elements source = elements(model, index);
    std::vector<glm::vec3> vectors(source.count);
    for (std::size_t i = 0; i < source.count; ++i) vectors[i] = source.read<glm::vec3>(i);
    return vectors;
}

std::vector<std::uint32_t> readIndices(const tinygltf::Model& model, int index) {
    const tinygltf::Accessor& accessor = at(model.accessors, index, "accessor");
    const Elements source = elements(model, index);
    std::vector<std::uint32_t> indices(source.count);
    const auto readAs = [&]<class Value>(Value) {
        for (std::size_t i = 0; i < source.count; ++i) indices[i] = source.read<Value>(i);
    };
    if (accessor.type != TINYGLTF_TYPE_SCALAR) {
        throw engine::Error(describe("accessor", index), "indices are not SCALAR");
    }
    switch (accessor.componentType) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        readAs(std::uint8_t{});
        break;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        readAs(std::uint16_t{});
        break;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        readAs(std::uint32_t{});
        break;
    default:
        throw engine::Error(describe("accessor", index), "indices are not unsigned integers");
    }
    return indices;
}

void appendPrimitive(
    Mesh& mesh, const tinygltf::Model& model, const tinygltf::Primitive& primitive,
    const glm::dmat4& transform) {
    if (primitive.mode != TINYGLTF_MODE_TRIANGLES) {
        throw engine::Error(
            "mode " + std::to_string(primitive.mode) + " is not supported, only triangles (4)");
    }
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) throw engine::Error("no POSITION");
    const std::vector<glm::vec3> positions = readVectors(model, position->second);
    std::vector<glm::vec3> normals(positions.size(), glm::vec3(0.0f));
    if (const auto normal = primitive.attributes.find("NORMAL");
        normal != primitive.attributes.end()) {
        normals = readVectors(model, normal->second);
        if (normals.size() != positions.size())
            throw engine::Error("NORMAL and POSITION differ in count");
    }
    std::vector<std::uint32_t> indices;
    if (primitive.indices >= 0) {
        indices = readIndices(model, primitive.indices);
    } else {
        for (std::uint32_t i = 0; i < positions.size(); ++i) indices.push_back(i);
    }
    if (indices.size() % 3 != 0) {
        throw engine::Error(std::to_string(indices.size()) + " indices are not whole triangles");
    }

    const glm::dmat3 linear(transform);
    const bool mirrored = glm::determinant(linear) < 0.0;
    const glm::dmat3 normal_transform = glm::transpose(glm::inverse(linear));
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
        mesh.positions.emplace_back(transform * glm::dvec4(positions[i], 1.0));
        mesh.normals.emplace_back(normal_transform * glm::dvec3(normals[i]));
    }
    std::uint32_t material = 0;  // glTF's default material
    if (primitive.material >= 0) {
        at(model.materials, primitive.material, "material");
        material = static_cast<std::uint32_t>(primitive.material) + 1;
    }
    for (std::size_t i = 0; i < indices.size(); i += 3) {
        for (std::size_t corner = i; corner < i + 3; ++corner) {
            if (indices[corner] < positions.size()) continue;
            throw engine::Error(
                "index " + std::to_string(corner) + " names vertex " +
                std::to_string(indices[corner]) + ", there are " +
                std::to_string(positions.size()));
        }
        const std::uint32_t second = indices[i + (mirrored ? 2 : 1)];
        const std::uint32_t third = indices[i + (mirrored ? 1 : 2)];
        mesh.triangles.push_back({first + indices[i], first + second, first + third});
        mesh.triangle_materials.push_back(material);
    }
}

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

void appendMesh(Mesh& mesh, const tinygltf::Model& model, int index, const glm::dmat4& transform) {
    const auto& primitives = at(model.meshes, index, "mesh").primitives;
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        try {
            appendPrimitive(mesh, model, primitives[i], transform);
        } catch (const engine::Error& error) {
            throw engine::Error(
                describe("mesh", index) + ", primitive " + std::to_string(i), error.what());
        }
    }
}

void appendScene(Mesh& mesh, const tinygltf::Model& model) {
    struct Visit {
        int node;
        glm::dmat4 parent;
    };
    if (model.scenes.empty()) throw engine::Error("the file has no scene");
    std::vector<Visit> visits;
    for (const int root : at(model.scenes, std::max(model.defaultScene, 0), "scene").nodes) {
        visits.push_back({root, glm::dmat4(1.0)});
    }
    std::vector<bool> visited(model.nodes.size());
    for (std::size_t next = 0; next < visits.size(); ++next) {
        const auto [index, parent] = visits[next];
        const tinygltf::Node& node = at(model.nodes, index, "node");
        if (visited[static_cast<std::size_t>(index)]) {
            throw engine::Error(describe("node", index), "is reached twice");
        }
        visited[static_cast<std::size_t>(index)] = true;
        const glm::dmat4 transform = parent * localTransform(node);
        if (node.mesh >= 0) appendMesh(mesh, model, node.mesh, transform);
        for (const int child : node.children) visits.push_back({child, transform});
    }
}

// glTF's factors are linear, ours are display RGB; IEC 61966-2-1.
float encodeSrgb(double linear) {
    return static_cast<float>(
        linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055);
}

std::vector<Material> materials(const tinygltf::Model& model) {
    std::vector<Material> materials{{.name = "default"}};
    for (const tinygltf::Material& source : model.materials) {
        const std::vector<double>& color = source.pbrMetallicRoughness.baseColorFactor;
        Material material{.name = source.name};
        if (color.size() >= 3) {
            material.base_color = {
                encodeSrgb(color[0]), encodeSrgb(color[1]), encodeSrgb(color[2])};
        }
        materials.push_back(material);
    }
    return materials;
}

void checkExtensions(const tinygltf::Model& model) {
    for (const std::string& extension : model.extensionsRequired) {
        if (extension.starts_with("KHR_materials_") || extension == "KHR_texture_transform")
            continue;
        throw engine::Error("the file needs " + extension + ", which is not supported");
    }
}

bool isBinary(const std::filesystem::path& path) {
    std::array<char, 4> magic{};
    std::ifstream(path, std::ios::binary).read(magic.data(), magic.size());
    return std::string_view(magic.data(), magic.size()) == "glTF";
}

// tinygltf's messages are lines; the first one says what is wrong.
std::string firstLine(const std::string& text) {
    return text.empty() ? "not a glTF file" : text.substr(0, text.find('\n'));
}

}  // namespace

Mesh importGltf(const std::filesystem::path& path) {
    tinygltf::TinyGLTF loader;
    loader.SetImageLoader(
        [](tinygltf::Image*, int, std::string*, std::string*, int, int, const unsigned char*, int,
           void*) { return true; },
        nullptr);
    tinygltf::Model model;
    std::string error;
    std::string warning;
    const bool loaded = isBinary(path)
                            ? loader.LoadBinaryFromFile(&model, &error, &warning, path.string())
                            : loader.LoadASCIIFromFile(&model, &error, &warning, path.string());
    if (!loaded) throw engine::Error(firstLine(error));
    checkExtensions(model);
    Mesh mesh;
    mesh.materials = materials(model);
    appendScene(mesh, model);
    return mesh;
}

}  // namespace hair
