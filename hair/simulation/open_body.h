#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/device.h"
#include "hair/gpu_structs.h"
#include "hair/groom/mesh/body_mesh.h"

// The body that an open mesh bounds, on a distance field's grid.
namespace hair::simulation {

// The inside is the region with winding number 1/2 or more, within the mesh's bounding box. The
// mesh is only part of its surface. Where the winding number goes smoothly through 1/2 there is a
// cap, which is flat across a flat opening. Distances to the mesh alone would change sign there
// with a jump as large as the opening, and would push hair that comes through the opening all the
// way to the rim. With the cap's triangles added, distances go through 0 as at any other surface.
struct OpenBody {
    std::vector<float> sides;  // [z][y][x] of the grid: -1 inside, 1 outside
    std::vector<glm::vec3> positions;  // [vertex], m
    // Triangles of the mesh, except those with the inside on both sides, then of the caps. Their
    // orientation has no meaning.
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

// Computes winding numbers on the device, and waits for it, and caps on the host. Throws
// engine::Error if no grid point is inside.
OpenBody makeOpenBody(
    const engine::Device& device, const groom::OpenMesh& mesh, const gpu::DistanceField& grid);

}  // namespace hair::simulation
