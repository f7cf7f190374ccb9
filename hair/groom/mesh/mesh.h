#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/pictures.h"

namespace hair::groom {

// The wrap mode beyond a picture's edges.
enum class Wrap { repeat, mirror, clamp };

// A picture on a surface.
struct MaterialTexture {
    std::uint32_t picture = 0;  // index into Mesh::pictures
    Wrap horizontal = Wrap::repeat;
    Wrap vertical = Wrap::repeat;
    bool is_smooth = true;  // interpolates between pixels
};

// A material in glTF 2.0's terms (section 3.9), except for colours.
struct Material {
    std::string name;
    glm::vec3 base_color{0.8f, 0.8f, 0.8f};  // display RGB
    float opacity = 1.0f;
    float metallic = 0.0f;
    float roughness = 1.0f;
    float normal_scale = 1.0f;
    std::optional<float> cutoff;  // parts that are less opaque are not drawn; absent: all are
    bool double_sided = false;
    std::optional<MaterialTexture> base_color_texture;  // factors of display RGB and opacity
    std::optional<MaterialTexture> metallic_roughness_texture;  // factors in blue and green
    std::optional<MaterialTexture> normal_texture;  // right, up, out; -1 to 1 as 0 to 255
};

// A group of vertices that a modelling program named.
struct VertexGroup {
    std::string name;
    std::vector<float> weights;  // [vertex], 0 to 1
};

// A triangle mesh in metres, +y up, counter-clockwise seen from outside.
struct Mesh {
    std::vector<glm::vec3> positions;                       // [vertex]
    std::vector<glm::vec3> normals;                         // [vertex], unit length
    std::vector<glm::vec2> texture_coordinates;  // [vertex], v down as in glTF, or empty
    std::vector<std::array<std::uint32_t, 3>> triangles;  // [triangle]
    std::vector<std::uint32_t> triangle_materials;  // [triangle], index into materials
    std::vector<Material> materials;
    std::vector<engine::Pixels> pictures;  // of the materials' textures
    std::vector<std::uint32_t> triangle_parts;  // [triangle], index into parts, or empty
    std::vector<std::string> parts;  // names of meshes, objects or groups
    std::vector<VertexGroup> vertex_groups;
    bool is_placed = false;  // the file states its unit and upward axis
    std::vector<std::string> warnings;  // parts of the file that are left out
};

// Adds "2 hidden meshes are left out", if there are any.
inline void warnOfHidden(std::size_t meshes, Mesh& mesh) {
    if (meshes == 0) return;
    mesh.warnings.push_back(
        std::to_string(meshes) +
        (meshes == 1 ? " hidden mesh is left out" : " hidden meshes are left out"));
}

// Whether the textures of a mesh's materials are read.
enum class Textures { skipped, decoded };

}  // namespace hair::groom
