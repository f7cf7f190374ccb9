#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/groom/mesh/mesh.h"
#include "hair/groom/mesh/surface.h"

// Meshes as bodies: any triangles that face outward bound a body. In a closed surface the inside is
// unambiguous; otherwise the inside is where the winding number (winding_number.h) is 1/2 or more.
namespace hair::groom {

// A surface that is open, branches, cuts itself or has parts in one another.
struct OpenMesh {
    std::vector<glm::vec3> positions;  // [vertex], m, each position once
    std::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise seen from outside
    std::vector<bool> inner;  // [triangle]: the inside is on both of its sides
    std::string reason;  // why the surface is not closed: faults and their numbers
};

// Throws engine::Error with the fault, its place and advice, for triangles that face opposite ways
// or inward, and for surfaces with next to nothing behind them, such as a plane.
OpenMesh openMesh(const Mesh& mesh);

// A closed surface, if it doesn't cut itself and its parts are apart or cavities; otherwise an open
// mesh. bodyMesh() throws as openMesh().
using BodyMesh = std::variant<ClosedMesh, OpenMesh>;
BodyMesh bodyMesh(const Mesh& mesh);

// A warning to users about a body that is not closed; empty for one that is.
std::string bodyWarning(const BodyMesh& mesh);

}  // namespace hair::groom
