#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "hair/groom/mesh/mesh.h"

namespace hair {

// The part of a mesh on which hair grows.
struct Scalp {
    std::vector<glm::vec3> positions;                     // [vertex], m, no two alike
    std::vector<glm::vec3> normals;                       // [vertex], unit length
    std::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise seen from outside
    // [triangle][corner], as in Mesh; empty if the mesh has none.
    std::vector<std::array<glm::vec2, 3>> texture_coordinates;
    std::vector<double> cumulative_areas;  // [triangle], m^2, its own area included

    double area() const { return cumulative_areas.back(); }
};

struct SurfacePoint {
    glm::vec3 position;      // m
    glm::vec3 normal;        // unit length
    std::uint32_t triangle;  // of the scalp
    glm::vec3 weights;       // of the triangle's corners, sum 1
};

// Takes the triangles of what has the name: see scalp_triangles.h. Vertices at the same position
// become one, with the mean of their normals; triangles that vanish by that are left out. Throws
// engine::Error if nothing has the name or the triangles have no area.
Scalp extractScalp(const Mesh& mesh, const std::string& name = "scalp");

// The point of a triangle with these weights of its corners, sum 1.
SurfacePoint surfacePoint(const Scalp& scalp, std::uint32_t triangle, const glm::dvec3& weights);

// The point that three numbers in [0, 1) pick; uniform numbers give points uniform in area.
SurfacePoint sampleSurface(const Scalp& scalp, const std::array<float, 3>& random);

// Only of a scalp that has texture coordinates.
glm::dvec2 textureCoordinate(const Scalp& scalp, const SurfacePoint& point);

}  // namespace hair
