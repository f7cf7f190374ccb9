#include "hair/groom/inspect/inspect_on_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/error.h"
#include "hair/groom/inspect/spread_of.h"
#include "hair/groom/mesh/closed_mesh.h"
#include "hair/groom/mesh/nearest_surface.h"

namespace hair {
namespace {

// What counts as on the surface, m. Triangles stray from the round head that they stand for: by
// e^2 / 8 r with edges of e = 2 cm on a head of r = 10 cm, a coarse one, by 0.5 mm. Hair is as wide
// as 0.1 mm, and off by more than a millimetre shows.
constexpr double kTolerance = 1e-3;

// Which direction is outward at a point of a closed mesh.
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

// How deep points are inside a closed mesh. Most of a groom is well outside: cells of a grid that
// have no part of the mesh in them, once found to be outside, answer for all points in them.
class Depths {
public:
    explicit Depths(const ClosedMesh& mesh)
        : mesh_(mesh), surface_(mesh.positions, mesh.triangles),
          outside_(std::size_t{kCells} * kCells * kCells, Answer::unknown) {
        low_ = glm::dvec3(std::numeric_limits<double>::max());
        high_ = -low_;
        for (const glm::vec3& position : mesh.positions) {
            low_ = glm::min(low_, glm::dvec3(position));
            high_ = glm::max(high_, glm::dvec3(position));
        }
        cell_ = (high_ - low_) / double{kCells};
    }

    // 0 outside.
    double operator()(const glm::dvec3& point) {
        if (glm::any(glm::lessThan(point, low_)) || glm::any(glm::greaterThan(point, high_)))
            return 0.0;
        const glm::ivec3 cell =
            glm::min(glm::ivec3((point - low_) / cell_), glm::ivec3(kCells - 1));
        if (isOutside(cell)) return 0.0;
        return std::max(-signedDistance(point), 0.0);
    }

private:
    enum class Answer : std::uint8_t { unknown, outside, neither };
    static constexpr int kCells = 64;  // along each side of the mesh's box

    double signedDistance(const glm::dvec3& point) const {
        const MeshPoint at = surface_(point);
        const bool is_inside = glm::dot(point - at.position, pseudonormal(mesh_, at)) < 0.0;
        return is_inside ? -at.distance : at.distance;
    }

    bool isOutside(const glm::ivec3& cell) {
        Answer& answer =
            outside_[static_cast<std::size_t>((cell.z * kCells + cell.y) * kCells + cell.x)];
        if (answer == Answer::unknown) {
            const glm::dvec3 centre = low_ + (glm::dvec3(cell) + 0.5) * cell_;
            // A hair's breadth more than half the diagonal, for points on the cell's corners.
            const double reach = 0.5001 * glm::length(cell_);
            answer = signedDistance(centre) > reach ? Answer::outside : Answer::neither;
        }
        return answer == Answer::outside;
    }

    const ClosedMesh& mesh_;
    NearestSurface surface_;
    glm::dvec3 low_;
    glm::dvec3 high_;
    glm::dvec3 cell_;
    std::vector<Answer> outside_;  // [z][y][x]
};

void inspectInside(
    const StrandSet& strands, const ClosedMesh& mesh, double scale, MeshFindings& findings) {
    Depths depthOf(mesh);
    std::uint32_t strands_inside = 0;
    std::size_t points_inside = 0;
    double deepest = 0.0;
    for (std::uint32_t i = 0; i < strands.strandCount(); ++i) {
        std::size_t inside = 0;
        for (const glm::vec3& point : strands.strand(i)) {
            const double depth = depthOf(glm::dvec3(point) * scale);
            deepest = std::max(deepest, depth);
            if (depth > kTolerance) ++inside;
        }
        points_inside += inside;
        if (inside > 0) ++strands_inside;
    }
    findings.strands_inside = strands_inside;
    findings.points_inside = points_inside;
    findings.deepest = deepest;
}

}  // namespace

MeshFindings inspectOnMesh(const StrandSet& strands, const Mesh& mesh, double metres_per_unit) {
    MeshFindings findings{.tolerance = kTolerance};
    const NearestSurface surface(mesh.positions, mesh.triangles);
    std::vector<float> distances;
    distances.reserve(strands.strandCount());
    for (std::uint32_t i = 0; i < strands.strandCount(); ++i) {
        const glm::dvec3 root = glm::dvec3(strands.strand(i)[0]) * metres_per_unit;
        const double distance = surface(root).distance;
        if (distance > kTolerance) ++findings.roots_off_surface;
        distances.push_back(static_cast<float>(distance));
    }
    findings.root_distances = spreadOf(distances);
    try {
        inspectInside(strands, closeMesh(mesh), metres_per_unit, findings);
    } catch (const engine::Error& error) {
        findings.not_closed = error.what();
    }
    return findings;
}

}  // namespace hair
