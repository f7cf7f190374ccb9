#pragma once

#include <cstdint>

#include <glm/mat4x4.hpp>

namespace hair {

// What rendering knows of the hair: where the guides are now, and the triangles between them. The
// simulation fills it in; the renderer never includes the simulation.
struct StrandView {
    std::uint64_t guides = 0;          // device address, vec4 [guide][vertex], m, root first
    std::uint64_t root_triangles = 0;  // device address, uint [triangle][3], guide indices
    std::uint64_t root_normals = 0;    // device address, vec3 [guide], unit length; 0: not known
    glm::mat4 head{1.0f};  // rigid motion of the root normals and of the mesh under the hair
    std::uint32_t guide_count = 0;
    std::uint32_t vertices_per_guide = 0;
    std::uint32_t triangle_count = 0;
};

}  // namespace hair
