#include "hair/groom/mesh/closed_mesh.h"

#include <cmath>
#include <map>
#include <span>
#include <sstream>

#include <glm/geometric.hpp>

#include "engine/error.h"
#include "hair/groom/mesh/triangle_sides.h"

namespace hair {
namespace {

glm::dvec3 corner(const ClosedMesh& mesh, std::size_t triangle, std::size_t index) {
    return glm::dvec3(mesh.positions[mesh.triangles[triangle][index % 3]]);
}

ClosedMesh weld(const Mesh& mesh) {
    ClosedMesh welded;
    std::map<std::array<float, 3>, std::uint32_t> vertices;
    for (const auto& triangle : mesh.triangles) {
        std::array<std::uint32_t, 3>& joined = welded.triangles.emplace_back();
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::vec3& p = mesh.positions[triangle[i]];
            const auto [at, is_new] = vertices.try_emplace(
                {p.x, p.y, p.z}, static_cast<std::uint32_t>(welded.positions.size()));
            if (is_new) welded.positions.push_back(p);
            joined[i] = at->second;
        }
    }
    return welded;
}

void checkVolume(const ClosedMesh& mesh) {
    double volume = 0.0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        volume +=
            glm::dot(corner(mesh, i, 0), glm::cross(corner(mesh, i, 1), corner(mesh, i, 2)) / 6.0);
    if (volume > 0.0) return;
    std::ostringstream reason;
    reason << "it has " << mesh.triangles.size() << " triangles and a volume of " << volume
           << " m^3";
    throw engine::Error("the surface is inside out or encloses nothing", reason.str());
}

double angle(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

std::vector<Pseudonormals>
pseudonormals(const ClosedMesh& mesh, std::span<const std::array<Side, 2>> pairs) {
    std::vector<Pseudonormals> normals(mesh.triangles.size());
    std::vector<glm::dvec3> of_vertices(mesh.positions.size(), glm::dvec3(0.0));
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const glm::dvec3 a = corner(mesh, i, 0);
        normals[i].face =
            glm::normalize(glm::cross(corner(mesh, i, 1) - a, corner(mesh, i, 2) - a));
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3 here = corner(mesh, i, k);
            of_vertices[mesh.triangles[i][k]] +=
                angle(corner(mesh, i, k + 1) - here, corner(mesh, i, k + 2) - here) *
                normals[i].face;
        }
    }
    for (const auto& [one, other] : pairs) {
        const glm::dvec3 sum = normals[one.triangle].face + normals[other.triangle].face;
        normals[one.triangle].edges[one.corner] = sum;
        normals[other.triangle].edges[other.corner] = sum;
    }
    for (std::size_t i = 0; i < normals.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k)
            normals[i].corners[k] = of_vertices[mesh.triangles[i][k]];
    }
    return normals;
}

}  // namespace

ClosedMesh closeMesh(const Mesh& mesh) {
    ClosedMesh closed = weld(mesh);
    removeFlatTriangles(closed.triangles, closed.positions);
    const auto pairs = pairSides(closed.triangles, closed.positions);
    checkVolume(closed);
    closed.normals = pseudonormals(closed, pairs);
    return closed;
}

}  // namespace hair
