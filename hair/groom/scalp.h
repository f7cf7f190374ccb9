#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/groom/mesh.h"

namespace hair {

// The part of a mesh on which hair grows: one piece of surface with one edge, the hairline.
struct Scalp {
    std::vector<glm::vec3> positions;                     // [vertex], m, no two alike
    std::vector<glm::vec3> normals;                       // [vertex], unit length
    std::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise seen from outside
    std::vector<double> cumulative_areas;  // [triangle], m^2, its own area included
    std::vector<std::uint32_t> boundary;  // the hairline's vertices, with the scalp on their left

    double area() const { return cumulative_areas.back(); }
};

struct SurfacePoint {
    glm::vec3 position;  // m
    glm::vec3 normal;  // unit length
};

// Takes the triangles whose material is named "scalp". Vertices at the same position become one,
// with the mean of their normals; triangles that vanish by that are left out. Throws engine::Error
// if no material has that name or the triangles don't form a disc.
Scalp extractScalp(const Mesh& mesh);

// The point that three numbers in [0, 1) pick; uniform numbers give points uniform in area.
SurfacePoint sampleSurface(const Scalp& scalp, const std::array<float, 3>& random);

// `count` points on the hairline, evenly spaced by arc length, in the order of `boundary`.
std::vector<SurfacePoint> sampleBoundary(const Scalp& scalp, std::uint32_t count);

}  // namespace hair
