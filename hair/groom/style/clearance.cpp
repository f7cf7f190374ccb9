#include "hair/groom/style/clearance.h"
#include "hair/groom/parallel.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace hair::groom {

NearGround groundUnder(const glm::dvec3& point, const MeshPoint& nearest, const Mesh& mesh) {
    glm::dvec3 normal(0.0);
    for (int corner = 0; corner < 3; ++corner)
        normal += nearest.weights[corner] *
                  glm::dvec3(mesh.normals[mesh.triangles[nearest.triangle][corner]]);
    const glm::dvec3 offset = point - nearest.position;
    const double side = glm::dot(offset, normal) < 0.0 ? -1.0 : 1.0;
    static constexpr double kOnSurface = 1e-7;  // m
    return {
        .position = nearest.position,
        .outward = nearest.distance < kOnSurface ? glm::normalize(normal)
                                                 : side / nearest.distance * offset,
        .gap = side * nearest.distance};
}

namespace {

// The unit vector next to `direction` along which a segment of this length ends at this height, or
// as near to it as it can.
glm::dvec3
turnedTo(double height, double length, const glm::dvec3& outward, const glm::dvec3& direction) {
    const double sine = std::clamp(height / length, -1.0, 1.0);
    const glm::dvec3 across = direction - glm::dot(direction, outward) * outward;
    if (glm::length(across) < 1e-6) return outward;
    return sine * outward + std::sqrt(1.0 - sine * sine) * glm::normalize(across);
}

constexpr double kEnough = 0.3;  // clearance relative to the arc length
constexpr double kClearEnough = 1e-6;  // m

// A strand that is kept clear of a mesh.
struct ClearStrand {
    const Mesh& mesh;
    const NearestSurface& surface;
    std::vector<glm::dvec3> points;
    std::vector<double> lengths;  // of the segment that ends in the vertex
    std::vector<double> wanted;  // clearance of the vertex
    // The last known gap of each vertex, or a lower bound of it, and the vertex's place then. A
    // gap changes by no more than its vertex moves.
    std::vector<double> gaps;
    std::vector<glm::dvec3> seen;

    ClearStrand(
        std::vector<glm::dvec3> strand, double clearance, const Mesh& on,
        const NearestSurface& its_surface)
        : mesh(on), surface(its_surface), points(std::move(strand)), lengths(points.size(), 0.0),
          wanted(points.size(), 0.0), gaps(points.size(), 0.0), seen(points) {
        double arc = 0.0;
        for (std::size_t i = 1; i < points.size(); ++i) {
            lengths[i] = glm::distance(points[i], points[i - 1]);
            arc += lengths[i];
            wanted[i] = std::min(clearance, kEnough * arc);
        }
    }

    // Turns one segment after the other, from the root on, until it ends clear of the mesh.
    // Returns whether any turned.
    bool turnSegments() {
        static constexpr int kTurns = 8;  // of a segment: surfaces are not flat
        const std::vector<glm::dvec3> old = points;
        bool moved = false;
        glm::dvec3 above(0.0);  // direction of the segment above
        double depth = 0.0;  // of the vertex above, if it is inside
        for (std::size_t i = 1; i < points.size(); ++i) {
            const glm::dvec3 edge = old[i] - old[i - 1];
            glm::dvec3 direction = lengths[i] > 0.0 ? edge / lengths[i] : edge;
            // A segment ends no deeper than its length below the vertex above.
            const double reach = 1.001 * std::max(wanted[i], lengths[i] + depth);
            depth = 0.0;
            for (int turn = 0; turn < kTurns && lengths[i] > 0.0; ++turn) {
                const glm::dvec3 end = points[i - 1] + lengths[i] * direction;
                const std::optional<MeshPoint> nearest = surface.within(end, reach);
                gaps[i] = reach;
                seen[i] = end;
                if (!nearest) break;
                const NearGround ground = groundUnder(end, *nearest, mesh);
                gaps[i] = ground.gap;
                depth = std::max(-ground.gap, 0.0);
                if (ground.gap >= wanted[i] - kClearEnough) break;
                const double height =
                    glm::dot(ground.outward, ground.position - points[i - 1]) + wanted[i];
                direction = turnedTo(height, lengths[i], ground.outward, direction + above);
                moved = true;
            }
            above = direction;
            if (moved) points[i] = points[i - 1] + lengths[i] * direction;
        }
        return moved;
    }

    // Clears vertices that no turn of a single segment can clear, such as those under a jaw or
    // behind an ear. Alternately pushes vertices to their clearance and restores lengths from the
    // root on.
    void pushVertices() {
        static constexpr int kMostPushes = 400;
        static constexpr double kNear = 1e-4;  // m
        for (int push = 0; push < kMostPushes; ++push) {
            bool clear = true;
            for (std::size_t i = 1; i < points.size(); ++i) {
                if (gaps[i] - glm::distance(points[i], seen[i]) >= wanted[i] - 0.5 * kNear)
                    continue;
                const NearGround ground = groundUnder(points[i], surface(points[i]), mesh);
                gaps[i] = ground.gap;
                seen[i] = points[i];
                if (ground.gap >= wanted[i] - kNear) continue;
                clear = false;
                points[i] = ground.position + wanted[i] * ground.outward;
            }
            for (std::size_t i = 1; i < points.size(); ++i) {
                const glm::dvec3 edge = points[i] - points[i - 1];
                const double length = glm::length(edge);
                if (length > 0.0) points[i] = points[i - 1] + lengths[i] / length * edge;
            }
            if (clear) return;
        }
    }
};

}  // namespace

bool keepClear(
    std::vector<glm::dvec3>& points, const Mesh& mesh, const NearestSurface& surface,
    double clearance) {
    ClearStrand strand(points, clearance, mesh, surface);
    if (!strand.turnSegments()) return false;
    strand.pushVertices();
    points = std::move(strand.points);
    return true;
}

Groom keepClear(Groom groom, const Mesh& mesh, double clearance) {
    const NearestSurface surface(mesh.positions, mesh.triangles);
    inParallel("keeps strands off the mesh", groom.strand_count, [&](std::uint32_t index) {
        const std::span<const glm::vec3> strand = groom.strand(index);
        std::vector<glm::dvec3> points(strand.begin(), strand.end());
        if (keepClear(points, mesh, surface, clearance))
            std::ranges::copy(
                points, groom.points.begin() + std::size_t{index} * groom.vertices_per_strand);
    });
    return groom;
}

glm::dvec3 outwardOf(const Mesh& mesh, const NearestSurface& surface, const glm::dvec3& point) {
    return groundUnder(point, surface(point), mesh).outward;
}

}  // namespace hair::groom
