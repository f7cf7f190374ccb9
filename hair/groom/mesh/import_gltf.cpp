#include "hair/groom/mesh/import_gltf.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <utility>

#include <glm/mat3x3.hpp>

#include "engine/error.h"
#include "hair/groom/mesh/gltf_accessors.h"
#include "hair/groom/mesh/gltf_materials.h"
#include "hair/groom/mesh/gltf_scene.h"

namespace hair {
namespace {

using Corners = std::array<std::size_t, 3>;  // numbers of indices

// Triangle `i` as glTF 2.0, section 3.7.2.1, numbers its corners.
Corners cornersOf(int mode, std::size_t i) {
    switch (mode) {
    case TINYGLTF_MODE_TRIANGLE_STRIP:
        return {i, i + 1 + i % 2, i + 2 - i % 2};
    case TINYGLTF_MODE_TRIANGLE_FAN:
        return {i + 1, i + 2, 0};
    default:
        return {3 * i, 3 * i + 1, 3 * i + 2};
    }
}

bool hasTriangles(const tinygltf::Primitive& primitive) {
    return primitive.mode == TINYGLTF_MODE_TRIANGLES ||
           primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
           primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN;
}

std::size_t triangleCount(int mode, std::size_t index_count) {
    if (mode != TINYGLTF_MODE_TRIANGLES) return index_count < 3 ? 0 : index_count - 2;
    if (index_count % 3 != 0) {
        throw engine::Error(std::to_string(index_count) + " indices are not whole triangles");
    }
    return index_count / 3;
}

// The group's weights, 0 for all vertices so far where it is new.
std::vector<float>& weightsOf(Mesh& mesh, const std::string& name) {
    const auto group = std::ranges::find(mesh.vertex_groups, name, &VertexGroup::name);
    if (group != mesh.vertex_groups.end()) return group->weights;
    return mesh.vertex_groups.emplace_back(VertexGroup{name, {}}).weights;
}

std::string groupName(std::string_view attribute) {
    std::string name(attribute.substr(1));
    for (char& c : name)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return name;
}

bool isWeight(float number) { return number >= 0.0f && number <= 1.0f; }

class MeshReader {
public:
    explicit MeshReader(const tinygltf::Model& model) : model_(model) {}

    void add(const GltfPlace& place) {
        const tinygltf::Primitive& primitive = place.primitive;
        if (!hasTriangles(primitive)) return;
        const std::size_t first = mesh_.positions.size();
        const std::size_t count = addVertices(primitive, place.transform);
        addGroups(primitive, first, count);
        const bool mirrored = glm::determinant(glm::dmat3(place.transform)) < 0.0;
        addTriangles(primitive, static_cast<std::uint32_t>(first), count, mirrored);
        addPart(place);
    }

    Mesh take() {
        const std::size_t vertices = mesh_.positions.size();
        if (has_texture_coordinates_) mesh_.texture_coordinates.resize(vertices, glm::vec2(0.0f));
        for (VertexGroup& group : mesh_.vertex_groups) group.weights.resize(vertices, 0.0f);
        std::erase_if(mesh_.vertex_groups, [](const VertexGroup& group) {
            return !std::ranges::all_of(group.weights, isWeight);
        });
        return std::move(mesh_);
    }

private:
    // What an attribute has to be as long as.
    template <class Value>
    static std::vector<Value>
    checked(std::vector<Value> values, std::size_t count, const char* name) {
        if (values.size() == count) return values;
        throw engine::Error(std::string(name) + " and POSITION differ in count");
    }

    // Returns their number.
    std::size_t addVertices(const tinygltf::Primitive& primitive, const glm::dmat4& transform) {
        const auto position = findAttribute(primitive, "POSITION");
        if (!position) throw engine::Error("no POSITION");
        const std::vector<glm::vec3> positions = readVectors(model_, *position);
        const std::size_t count = positions.size();
        const std::size_t first = mesh_.positions.size();
        if (count > std::numeric_limits<std::uint32_t>::max() - first) {
            throw engine::Error("the meshes have 2^32 vertices, or more");
        }
        std::vector<glm::vec3> normals(count, glm::vec3(0.0f));
        if (const auto normal = findAttribute(primitive, "NORMAL")) {
            normals = checked(readVectors(model_, *normal), count, "NORMAL");
        }
        const glm::dmat3 normal_transform = glm::transpose(glm::inverse(glm::dmat3(transform)));
        for (std::size_t i = 0; i < count; ++i) {
            mesh_.positions.emplace_back(transform * glm::dvec4(positions[i], 1.0));
            mesh_.normals.emplace_back(normal_transform * glm::dvec3(normals[i]));
        }
        if (const auto accessor = findAttribute(primitive, "TEXCOORD_0")) {
            const auto coordinates =
                checked(readTextureCoordinates(model_, *accessor), count, "TEXCOORD_0");
            mesh_.texture_coordinates.resize(first, glm::vec2(0.0f));  // of those without
            mesh_.texture_coordinates.insert(
                mesh_.texture_coordinates.end(), coordinates.begin(), coordinates.end());
            has_texture_coordinates_ = true;
        }
        return count;
    }

    void addGroups(const tinygltf::Primitive& primitive, std::size_t first, std::size_t count) {
        for (const auto& [name, index] : primitive.attributes) {
            if (!name.starts_with('_')) continue;
            const tinygltf::Accessor& accessor = at(model_.accessors, index, "accessor");
            if (accessor.type != TINYGLTF_TYPE_SCALAR ||
                accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT)
                continue;
            const auto added = checked(readScalars(model_, index), count, name.c_str());
            std::vector<float>& weights = weightsOf(mesh_, groupName(name));
            weights.resize(first, 0.0f);
            weights.insert(weights.end(), added.begin(), added.end());
        }
    }

    void addTriangles(
        const tinygltf::Primitive& primitive, std::uint32_t first, std::size_t vertex_count,
        bool mirrored) {
        const std::vector<std::uint32_t> indices = readIndices(model_, primitive, vertex_count);
        std::uint32_t material = 0;  // glTF's default material
        if (primitive.material >= 0) {
            at(model_.materials, primitive.material, "material");
            material = static_cast<std::uint32_t>(primitive.material) + 1;
        }
        const std::size_t count = triangleCount(primitive.mode, indices.size());
        for (std::size_t i = 0; i < count; ++i) {
            const auto [one, two, three] = cornersOf(primitive.mode, i);
            std::array corners{first + indices[one], first + indices[two], first + indices[three]};
            if (mirrored) std::swap(corners[1], corners[2]);
            mesh_.triangles.push_back(corners);
            mesh_.triangle_materials.push_back(material);
        }
    }

    void addPart(const GltfPlace& place) {
        if (mesh_.parts.empty() || place.node != part_node_) mesh_.parts.push_back(place.name);
        part_node_ = place.node;
        mesh_.triangle_parts.resize(
            mesh_.triangles.size(), static_cast<std::uint32_t>(mesh_.parts.size() - 1));
    }

    const tinygltf::Model& model_;
    Mesh mesh_;
    bool has_texture_coordinates_ = false;
    int part_node_ = -1;
};

std::vector<std::byte> readFile(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::vector<std::byte> bytes(std::filesystem::file_size(path));
    file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!file) throw engine::Error("can't be read");
    return bytes;
}

}  // namespace

Mesh importGltf(const std::filesystem::path& path, Textures textures) {
    const tinygltf::Model model = loadGltf(
        readFile(path), path,
        textures == Textures::decoded ? GltfImages::named : GltfImages::skipped);
    MeshReader reader(model);
    forEachPrimitive(model, [&](const GltfPlace& place) { reader.add(place); });
    Mesh mesh = reader.take();
    GltfMaterials materials = readMaterials(model, textures, path.parent_path());
    mesh.materials = std::move(materials.materials);
    mesh.pictures = std::move(materials.pictures);
    return mesh;
}

}  // namespace hair
