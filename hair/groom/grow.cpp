#include "hair/groom/grow.h"

#include <cassert>
#include <cmath>

#include <glm/geometric.hpp>

#include "hair/groom/roots.h"

namespace hair {
namespace {

constexpr glm::dvec3 kGravity{0.0, -1.0, 0.0};

glm::dvec3 rootDirection(const SurfacePoint& root, const glm::vec3& comb) {
    const glm::dvec3 direction = glm::dvec3(root.normal) + glm::dvec3(comb);
    const double length = glm::length(direction);
    return length > 1e-6 ? direction / length : glm::normalize(glm::dvec3(root.normal));
}

// The direction after a length s at which droop * s = turn.
glm::dvec3 drooped(const glm::dvec3& direction, double turn) {
    const double cosine = glm::dot(direction, kGravity);
    const glm::dvec3 across = direction - cosine * kGravity;
    const double sine = glm::length(across);
    if (turn == 0.0 || sine < 1e-9) return direction;  // straight up or down it stays
    const double tangent = (1.0 - cosine) / sine * std::exp(-turn);  // of half the angle
    const double scale = 1.0 / (1.0 + tangent * tangent);
    return 2.0 * tangent * scale * (across / sine) + (1.0 - tangent * tangent) * scale * kGravity;
}

}  // namespace

Groom grow(
    const Mesh& mesh, const GrowSettings& settings, std::uint32_t guides, std::uint32_t seed) {
    assert(settings.vertices >= 2);
    Roots roots = placeRoots(extractScalp(mesh), guides, seed);
    Groom groom;
    groom.strand_count = guides;
    groom.vertices_per_strand = settings.vertices;
    groom.root_triangles = std::move(roots.triangles);
    groom.points.reserve(std::size_t{guides} * settings.vertices);
    groom.root_normals.reserve(guides);
    const double segment_length = double{settings.length} / groom.segmentsPerStrand();
    for (const SurfacePoint& root : roots.points) {
        const glm::dvec3 direction = rootDirection(root, settings.comb);
        glm::dvec3 position(root.position);
        groom.points.push_back(root.position);
        groom.root_normals.push_back(root.normal);
        for (std::uint32_t segment = 0; segment < groom.segmentsPerStrand(); ++segment) {
            const double middle = (segment + 0.5) * segment_length;
            position += segment_length * drooped(direction, settings.droop * middle);
            groom.points.emplace_back(position);
        }
    }
    return groom;
}

}  // namespace hair
