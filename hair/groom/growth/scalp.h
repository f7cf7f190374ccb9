#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "hair/groom/mesh/mesh.h"

// The scalp: its triangles in a mesh, points on it, and its map to the plane.
namespace hair::groom {

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

// Takes the triangles that scalpTriangles() gives for the name. Vertices at the same position
// become one, with the mean of their normals. Triangles that collapse are left out. Throws
// engine::Error if nothing has the name or the triangles have no area.
Scalp extractScalp(const Mesh& mesh, const std::string& name = "scalp");

// Returns the point of a triangle with these weights of its corners, sum 1.
SurfacePoint surfacePoint(const Scalp& scalp, std::uint32_t triangle, const glm::dvec3& weights);

// Returns the point that three numbers in [0, 1) pick; uniform numbers give points uniform in
// area.
SurfacePoint sampleSurface(const Scalp& scalp, const std::array<float, 3>& random);

// Returns the texture coordinates at a point of a scalp that has them.
glm::dvec2 textureCoordinate(const Scalp& scalp, const SurfacePoint& point);

// A map from the scalp to the plane: the direction in which a point is seen from `centre`,
// projected stereographically from the direction opposite `axis`. Circles on the sphere of
// directions stay circles, so a Delaunay triangulation in the plane is one on the sphere.
// Orientation is that seen from outside. (Snyder 1987, Map projections, USGS professional paper
// 1395, section 21.)
struct Flattening {
    glm::dvec3 centre{0.0};
    glm::dvec3 axis{0.0, 0.0, 1.0};   // unit length; maps to the origin
    glm::dvec3 right{1.0, 0.0, 0.0};  // unit length, at right angles; maps to +x
    glm::dvec3 up{0.0, 1.0, 0.0};     // axis x right; maps to +y

    glm::dvec2 operator()(const glm::vec3& position) const;
};

// The axis is the scalp's mean normal. The centre is on the line along the axis through the
// scalp's centroid, where the scalp is seen most squarely: for a spherical cap, the centre of
// curvature. Throws engine::Error if no such centre sees the whole scalp from its inner side.
Flattening flatten(const Scalp& scalp);

// A polygon in the plane, to test many points against.
class Outline {
public:
    explicit Outline(std::vector<glm::dvec2> polygon);

    // Whether a point is inside by crossing parity, and farther from each edge than a thousandth
    // of the edge's length, so that rounding can't put it on the edge.
    bool contains(const glm::dvec2& point) const;

private:
    std::vector<glm::dvec2> polygon_;
    double low_ = 0.0;  // of the rows' y
    double per_row_ = 0.0;  // rows per unit of y
    std::vector<std::uint32_t> starts_;  // [row], first of its edges; one more at the end
    std::vector<std::uint32_t> edges_;  // those that meet each row, by their first vertex
};

// Returns the triangles of all materials of that name, or else of all parts, or else of all vertex
// groups. A vertex group has the triangles with at least half of the full weight at each corner.
// "*" takes every triangle. Throws engine::Error with a list of the mesh's names if nothing has
// the name or it has no triangles.
std::vector<std::uint32_t> scalpTriangles(const Mesh& mesh, const std::string& name);

}  // namespace hair::groom
