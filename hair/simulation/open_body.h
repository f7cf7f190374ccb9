#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/device.h"
#include "hair/gpu_structs.h"
#include "hair/groom/mesh/body_mesh.h"

// The body that an open mesh bounds, on the grid of a distance field.
namespace hair::simulation {

// Inside is where the winding number is 1/2 or more and no farther out than the box round the mesh.
// The mesh is not all of its surface: where the winding number goes through 1/2 smoothly there is a
// cap, flat across a flat opening. Distances to the mesh alone would jump there from one sign to
// the other by as much as the opening is wide, and take hair that comes through the opening all the
// way to the rim; with the cap among the triangles they go through 0 as at any other surface.
struct OpenBody {
    std::vector<float> sides;  // [z][y][x] of the grid: -1 inside, 1 outside
    std::vector<glm::vec3> positions;  // [vertex], m
    // The mesh's but for those with the inside on both sides, then the caps'; no way round is out.
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

// Winding numbers are made on the device, which is waited for, caps on the host. Throws
// engine::Error where no point of the grid is inside.
OpenBody makeOpenBody(
    const engine::Device& device, const groom::OpenMesh& mesh, const gpu::DistanceField& grid);

}  // namespace hair::simulation
