#include "hair/groom/guides/root_triangles.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include <glm/geometric.hpp>

#include "hair/groom/growth/grid_point.h"
#include "hair/groom/growth/triangulate.h"
#include "hair/groom/guides/drop_triangles.h"
#include "hair/groom/guides/fit_roots.h"
#include "hair/groom/mesh/nearest_surface.h"

namespace hair {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

// Along a line there is no triangle that has an area: pairs of neighbours, from the first root's
// end to the other.
Triangles joinAlong(std::span<const glm::vec3> roots, glm::dvec3 axis) {
    if (roots.size() == 1) return {{0, 0, 0}};
    const auto along = [&](std::uint32_t i) { return glm::dot(glm::dvec3(roots[i]), axis); };
    if (along(0) > along(static_cast<std::uint32_t>(roots.size()) - 1)) axis = -axis;
    std::vector<std::uint32_t> order(roots.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::sort(order, {}, [&](std::uint32_t i) { return std::pair(along(i), i); });
    Triangles triangles;
    for (std::size_t i = 1; i < order.size(); ++i)
        triangles.push_back({order[i - 1], order[i], order[i]});
    return triangles;
}

// A root for each place in the plane.
struct Places {
    std::vector<std::uint32_t> roots;  // [place]
    std::vector<GridPoint> points;     // [place], ascending by x, then y
};

// On the grid that triangulate() rounds to: where the extent is the whole grid, it takes the points
// as they are, and which are on the convex hull is as exact here as there.
Places placesOf(std::span<const glm::vec3> roots, const Flattening& flattening) {
    std::vector<glm::dvec2> flat;
    for (const glm::vec3& root : roots) flat.push_back(flattening(root));
    glm::dvec2 low = flat.front();
    glm::dvec2 high = low;
    for (const glm::dvec2& point : flat) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    const double extent = std::max(high.x - low.x, high.y - low.y);
    const double scale = ((1 << kGridBits) - 1) / extent;
    struct Entry {
        std::int64_t x, y;
        std::uint32_t root;
        auto operator<=>(const Entry&) const = default;
    };
    std::vector<Entry> entries;
    for (std::uint32_t i = 0; i < flat.size(); ++i) {
        const glm::dvec2 point = (flat[i] - low) * scale;
        entries.push_back({std::llround(point.x), std::llround(point.y), i});
    }
    std::ranges::sort(entries);
    Places places;
    for (const Entry& entry : entries) {
        const GridPoint point{entry.x, entry.y};
        if (!places.points.empty() && places.points.back() == point) continue;
        places.points.push_back(point);
        places.roots.push_back(entry.root);
    }
    return places;
}

// The places on the convex hull, counter-clockwise, those on its edges too; if all are on a line,
// those between its ends twice. Andrew 1979, Another efficient algorithm for convex hulls in two
// dimensions.
std::vector<std::uint32_t> convexHull(const Places& places) {
    std::vector<std::uint32_t> hull;
    const auto add = [&](std::uint32_t place, std::size_t start) {
        const auto turnsRight = [&] {
            const std::size_t n = hull.size();
            return orientation(
                       places.points[hull[n - 2]], places.points[hull[n - 1]],
                       places.points[place]) < 0;
        };
        while (hull.size() >= start + 2 && turnsRight()) hull.pop_back();
        hull.push_back(place);
    };
    const auto count = static_cast<std::uint32_t>(places.points.size());
    for (std::uint32_t i = 0; i < count; ++i) add(i, 0);
    const std::size_t start = hull.size() - 1;
    for (std::uint32_t i = count - 1; i-- > 0;) add(i, start);
    hull.pop_back();  // the first again
    return hull;
}

// Triangles of the places' roots.
Triangles triangulatePlaces(const Places& places, const std::vector<std::uint32_t>& hull) {
    std::vector<std::uint32_t> order = hull;
    std::vector<bool> on_hull(places.points.size());
    for (const std::uint32_t place : hull) on_hull[place] = true;
    for (std::uint32_t i = 0; i < on_hull.size(); ++i)
        if (!on_hull[i]) order.push_back(i);
    std::vector<glm::dvec2> points;
    for (const std::uint32_t place : order)
        points.emplace_back(places.points[place].x, places.points[place].y);
    Triangles triangles = triangulate(points, static_cast<std::uint32_t>(hull.size()));
    for (auto& triangle : triangles)
        for (std::uint32_t& corner : triangle) corner = places.roots[order[corner]];
    return triangles;
}

// Roots all round a sphere leave a gap that the map can't show, outside the convex hull. Seen from
// the other side the hull goes round it.
void closeGap(
    std::span<const glm::vec3> roots, std::span<const std::uint32_t> hull,
    const Flattening& flattening, Triangles& triangles) {
    const Flattening behind{
        .centre = flattening.centre,
        .axis = -flattening.axis,
        .right = flattening.right,
        .up = -flattening.up};
    std::vector<glm::dvec2> polygon;
    for (std::size_t i = hull.size(); i-- > 0;) polygon.push_back(behind(roots[hull[i]]));
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec2& a = polygon[i];
        const glm::dvec2& b = polygon[(i + 1) % polygon.size()];
        if (a.x * b.y - a.y * b.x <= 0.0) return;  // the hull doesn't go round the axis
    }
    for (auto triangle : triangulate(polygon, static_cast<std::uint32_t>(polygon.size()))) {
        for (std::uint32_t& corner : triangle) corner = hull[hull.size() - 1 - corner];
        triangles.push_back(triangle);
    }
}

// Whether the outer side is that of the centre. Without normals, hair leaves a plane on its outer
// side, and a sphere's is outward.
bool facesInward(const Groom& guides, const Mesh* mesh, const RootSurface& surface) {
    std::vector<glm::vec3> normals = guides.root_normals;
    if (normals.empty() && mesh) normals = rootNormals(guides, *mesh);
    if (normals.empty() && surface.kind == RootSurface::Kind::sphere) return false;
    double outward = 0.0;
    for (std::uint32_t i = 0; i < guides.strand_count; ++i) {
        const auto strand = guides.strand(i);
        const glm::dvec3 normal(normals.empty() ? strand[1] - strand[0] : normals[i]);
        const glm::dvec3 from_centre = glm::dvec3(strand[0]) - surface.flattening.centre;
        const double size = glm::length(normal) * glm::length(from_centre);
        if (size > 0.0) outward += glm::dot(normal, from_centre) / size;
    }
    return outward < 0.0;
}

}  // namespace

Triangles triangulateRoots(const Groom& guides, const Mesh* mesh) {
    std::vector<glm::vec3> roots;
    for (std::uint32_t i = 0; i < guides.strand_count; ++i) roots.push_back(guides.strand(i)[0]);
    if (roots.empty()) return {};
    const RootSurface surface = fitRoots(roots);
    const Flattening& flattening = surface.flattening;
    if (surface.kind == RootSurface::Kind::line) return joinAlong(roots, flattening.axis);

    const Places places = placesOf(roots, flattening);
    std::vector<std::uint32_t> hull = convexHull(places);
    if (hull.size() < 3 || hull.size() > places.points.size()) {
        const glm::vec3 ends = roots[places.roots.back()] - roots[places.roots.front()];
        return joinAlong(roots, glm::dvec3(ends));
    }
    Triangles triangles = triangulatePlaces(places, hull);
    if (surface.all_round) {
        for (std::uint32_t& place : hull) place = places.roots[place];
        closeGap(roots, hull, flattening, triangles);
    }
    triangles = withoutLongTriangles(std::move(triangles), roots);
    if (facesInward(guides, mesh, surface))
        for (auto& triangle : triangles) std::swap(triangle[1], triangle[2]);
    return triangles;
}

std::vector<glm::vec3> rootNormals(const Groom& guides, const Mesh& mesh) {
    const NearestSurface surface(mesh.positions, mesh.triangles);
    std::vector<glm::vec3> normals;
    normals.reserve(guides.strand_count);
    for (std::uint32_t i = 0; i < guides.strand_count; ++i) {
        const MeshPoint at = surface(glm::dvec3(guides.strand(i)[0]));
        const auto& corners = mesh.triangles[at.triangle];
        glm::dvec3 sum(0.0);
        std::size_t heaviest = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double weight = at.weights[static_cast<int>(k)];
            sum += weight * glm::dvec3(mesh.normals[corners[k]]);
            if (weight > at.weights[static_cast<int>(heaviest)]) heaviest = k;
        }
        // Corners can face opposite ways, where a modelled hair card is folded.
        const double length = glm::length(sum);
        normals.push_back(
            length > 1e-6 ? glm::vec3(sum / length) : mesh.normals[corners[heaviest]]);
    }
    return normals;
}

}  // namespace hair
