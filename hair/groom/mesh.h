#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace hair {

struct Material {
    std::string name;
    glm::vec3 base_color{0.8f, 0.8f, 0.8f};  // display RGB
};

// A triangle mesh in metres, +y up, counter-clockwise seen from outside.
struct Mesh {
    std::vector<glm::vec3> positions;                       // [vertex]
    std::vector<glm::vec3> normals;                         // [vertex], unit length
    std::vector<std::array<std::uint32_t, 3>> triangles;    // [triangle]
    std::vector<std::uint32_t> triangle_materials;          // [triangle], index into materials
    std::vector<Material> materials;
};

}  // namespace hair
