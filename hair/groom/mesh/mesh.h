#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace hair {

struct Material {
    std::string name;
    glm::vec3 base_color{0.8f, 0.8f, 0.8f};  // display RGB
};

// Vertices that a modelling program gave a name to.
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
    std::vector<std::uint32_t> triangle_parts;  // [triangle], index into parts, or empty
    std::vector<std::string> parts;  // names of meshes, objects or groups
    std::vector<VertexGroup> vertex_groups;
};

}  // namespace hair
