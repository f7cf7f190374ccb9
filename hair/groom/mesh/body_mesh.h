#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/groom/mesh/mesh.h"
#include "hair/groom/mesh/surface.h"

// What of a mesh is a body: any triangles that face outward bound one. Where they close it inside
// is as plain as it is for a closed surface; elsewhere inside is where the winding number
// (winding_number.h) is 1/2 or more.
namespace hair::groom {

// A surface that is open, branches, cuts itself or has parts in one another.
struct OpenMesh {
    std::vector<glm::vec3> positions;  // [vertex], m, each position once
    std::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise seen from outside
    std::vector<bool> inner;  // [triangle]: what it lies in is inside on both sides
    std::string reason;  // why it is not a closed surface: what and how many of it
};

// Throws engine::Error that says what is wrong, where, and what to do, for triangles that face
// opposite ways or inward, and for those that have next to nothing behind them, such as a plane.
OpenMesh openMesh(const Mesh& mesh);

// A closed surface where it is one that doesn't cut itself and whose parts are apart or cavities.
// Throws as openMesh().
using BodyMesh = std::variant<ClosedMesh, OpenMesh>;
BodyMesh bodyMesh(const Mesh& mesh);

// What a user has to know of a body that is not closed; empty for one that is.
std::string bodyWarning(const BodyMesh& mesh);

}  // namespace hair::groom
