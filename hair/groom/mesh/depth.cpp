#include "hair/groom/mesh/depth.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <variant>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

namespace hair::groom {
namespace {

constexpr int kDepthCells = 64;  // along each side of the mesh's box

// The outward direction at a point of a closed mesh.
const glm::dvec3& pseudonormal(const ClosedMesh& mesh, const MeshPoint& at) {
    const Pseudonormals& normals = mesh.normals[at.triangle];
    for (std::size_t k = 0; k < 3; ++k) {
        const auto corner = static_cast<int>(k);
        if (at.weights[corner] == 1.0) return normals.corners[k];
        if (at.weights[corner] == 0.0 && at.weights[(corner + 1) % 3] > 0.0 &&
            at.weights[(corner + 2) % 3] > 0.0)
            return normals.edges[(k + 1) % 3];
    }
    return normals.face;
}

NearestSurface surfaceOf(const BodyMesh& mesh) {
    if (const auto* closed = std::get_if<ClosedMesh>(&mesh))
        return {closed->positions, closed->triangles};
    const auto& open = std::get<OpenMesh>(mesh);
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::size_t i = 0; i < open.triangles.size(); ++i)
        if (!open.inner[i]) triangles.push_back(open.triangles[i]);
    return {open.positions, triangles};
}

std::span<const glm::vec3> positionsOf(const BodyMesh& mesh) {
    return std::visit(
        [](const auto& any) { return std::span<const glm::vec3>(any.positions); }, mesh);
}

}  // namespace

DepthInside::DepthInside(BodyMesh mesh)
    : mesh_(std::move(mesh)), surface_(surfaceOf(mesh_)), low_(std::numeric_limits<double>::max()),
      high_(-low_),
      outside_(std::size_t{kDepthCells} * kDepthCells * kDepthCells, Answer::unknown) {
    if (const auto* open = std::get_if<OpenMesh>(&mesh_))
        winding_.emplace(open->positions, open->triangles);
    for (const glm::vec3& position : positionsOf(mesh_)) {
        low_ = glm::min(low_, glm::dvec3(position));
        high_ = glm::max(high_, glm::dvec3(position));
    }
    cell_ = (high_ - low_) / double{kDepthCells};
}

double DepthInside::operator()(const glm::dvec3& point) {
    if (glm::any(glm::lessThan(point, low_)) || glm::any(glm::greaterThan(point, high_)))
        return 0.0;
    if (winding_) return (*winding_)(point) < 0.5 ? 0.0 : surface_(point).distance;
    const glm::ivec3 cell =
        glm::min(glm::ivec3((point - low_) / cell_), glm::ivec3(kDepthCells - 1));
    if (isOutside(cell)) return 0.0;
    return std::max(-signedDistance(point), 0.0);
}

double DepthInside::signedDistance(const glm::dvec3& point) const {
    const MeshPoint at = surface_(point);
    const glm::dvec3& normal = pseudonormal(std::get<ClosedMesh>(mesh_), at);
    const bool is_inside = glm::dot(point - at.position, normal) < 0.0;
    return is_inside ? -at.distance : at.distance;
}

bool DepthInside::isOutside(const glm::ivec3& cell) {
    Answer& answer =
        outside_[static_cast<std::size_t>((cell.z * kDepthCells + cell.y) * kDepthCells + cell.x)];
    if (answer == Answer::unknown) {
        const glm::dvec3 centre = low_ + (glm::dvec3(cell) + 0.5) * cell_;
        // Slightly more than half the diagonal, for points on the cell's corners.
        const double reach = 0.5001 * glm::length(cell_);
        answer = signedDistance(centre) > reach ? Answer::outside : Answer::neither;
    }
    return answer == Answer::outside;
}

}  // namespace hair::groom
