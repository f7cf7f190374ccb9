#include "hair/groom/roots.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "engine/error.h"
#include "hair/groom/flatten.h"
#include "hair/groom/spread.h"
#include "hair/groom/triangulate.h"
#include "hair/random.h"

namespace hair {
namespace {

constexpr std::uint32_t kCandidatesPerRoot = 10;

// Distance that a root keeps from a hairline edge, as a fraction of the edge: enough that rounding
// puts none on it. Keeping more is spread()'s part.
constexpr double kMargin = 0.001;

bool isNearEdge(const glm::dvec2& point, const glm::dvec2& a, const glm::dvec2& b) {
    const glm::dvec2 edge = b - a;
    const glm::dvec2 from_a = point - a;
    const double length2 = glm::dot(edge, edge);
    const double limit2 = kMargin * kMargin * length2;
    const double across = edge.x * from_a.y - edge.y * from_a.x;
    if (across * across > limit2 * length2) return false;  // far from the whole line
    const double t = std::clamp(glm::dot(from_a, edge) / length2, 0.0, 1.0);
    const glm::dvec2 gap = from_a - t * edge;
    return glm::dot(gap, gap) < limit2;
}

// Inside by crossing parity, and not too close to an edge.
bool isWellInside(const std::vector<glm::dvec2>& polygon, const glm::dvec2& point) {
    bool inside = false;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec2& a = polygon[i];
        const glm::dvec2& b = polygon[i + 1 < polygon.size() ? i + 1 : 0];
        if (isNearEdge(point, a, b)) return false;
        if ((a.y > point.y) == (b.y > point.y)) continue;
        if (point.x < a.x + (b.x - a.x) * (point.y - a.y) / (b.y - a.y)) inside = !inside;
    }
    return inside;
}

// Between neighbouring roots the hairline is a straight line of the flattened scalp: candidates
// beyond it don't count.
std::vector<SurfacePoint> insideCandidates(
    const Scalp& scalp, const Flattening& flattening, const std::vector<glm::dvec2>& polygon,
    std::uint32_t count, std::uint32_t seed) {
    std::vector<SurfacePoint> candidates;
    const std::uint64_t attempts = std::uint64_t{count} * 10;
    for (std::uint32_t i = 0; i < attempts && candidates.size() < count; ++i) {
        const SurfacePoint candidate = sampleSurface(
            scalp, {random01(seed, i, purpose::root_triangle), random01(seed, i, purpose::root_u),
                    random01(seed, i, purpose::root_v)});
        if (isWellInside(polygon, flattening(candidate.position))) candidates.push_back(candidate);
    }
    if (candidates.size() == count) return candidates;
    throw engine::Error("too little of the scalp lies inside its hairline");
}

std::vector<glm::vec3> positions(const std::vector<SurfacePoint>& points) {
    std::vector<glm::vec3> positions;
    for (const SurfacePoint& point : points) positions.push_back(point.position);
    return positions;
}

}  // namespace

std::uint32_t boundaryRootCount(std::uint32_t guides) {
    const double count = std::round(34.0 * std::sqrt(guides / 86.0));
    return std::min(guides, std::max(3u, static_cast<std::uint32_t>(count)));
}

Roots placeRoots(const Scalp& scalp, std::uint32_t guides, std::uint32_t seed) {
    if (guides < 3) throw engine::Error("at least 3 guides are needed");
    const Flattening flattening = flatten(scalp);
    Roots roots;
    roots.boundary_count = boundaryRootCount(guides);
    roots.points = sampleBoundary(scalp, roots.boundary_count);
    std::vector<glm::dvec2> flat;
    for (const SurfacePoint& point : roots.points) flat.push_back(flattening(point.position));

    if (const std::uint32_t inside = guides - roots.boundary_count; inside > 0) {
        const std::vector<SurfacePoint> candidates =
            insideCandidates(scalp, flattening, flat, inside * kCandidatesPerRoot, seed);
        const std::vector<glm::vec3> fixed = positions(roots.points);
        for (const std::uint32_t i : spread(positions(candidates), fixed, inside, scalp.area())) {
            roots.points.push_back(candidates[i]);
            flat.push_back(flattening(candidates[i].position));
        }
    }
    try {
        roots.triangles = triangulate(flat, roots.boundary_count);
    } catch (const engine::Error& error) {
        throw engine::Error("the roots can't be triangulated", error.what());
    }
    return roots;
}

}  // namespace hair
