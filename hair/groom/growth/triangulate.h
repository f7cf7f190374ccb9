#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include "hair/groom/growth/scalp.h"

// Triangles between points: of a polygon, of the plane, and of roots on a scalp.
namespace hair::groom {

// The constrained Delaunay triangulation of a polygon with points inside it. The first
// `boundary_count` points are the polygon's vertices in order, either way round; the others lie
// strictly inside. All points are used, and the triangles, counter-clockwise index triples, cover
// exactly the polygon: 2 N - 2 - h of them for N points, h of them on the boundary. Coordinates are
// rounded to 2^-29 of the extent, and on these all decisions are exact. Cocircular points are fine.
// Throws engine::Error for a coordinate that isn't finite, points that coincide, a boundary that
// meets itself, or a point that isn't inside.
std::vector<std::array<std::uint32_t, 3>>
triangulate(std::span<const glm::dvec2> points, std::uint32_t boundary_count);

// Returns the triangles between roots on a scalp of any shape. The scalp is cut at the roots, its
// own vertices are removed one by one, and edges are flipped until angles opposite an edge have a
// sum of at most 180 degrees, as in a Delaunay triangulation. Each triangle is counter-clockwise
// seen from outside. An edge has at most two triangles, which run along it in opposite directions.
// No triangle joins pieces of the scalp that have no edge in common. Along a boundary, roots are
// joined if the triangle is not much longer than high; no triangle reaches over a hole. A piece
// with one root has the triangle {a, a, a}. A piece with several roots but no triangle has {a, b,
// b} from each root to the next.
std::vector<std::array<std::uint32_t, 3>>
surfaceTriangles(const Scalp& scalp, std::span<const SurfacePoint> roots);

// Returns the scalp's triangles, cut so that roots are corners. Vertices are numbered: the roots,
// then the scalp's.
std::vector<std::array<std::uint32_t, 3>>
cutAtRoots(const Scalp& scalp, std::span<const SurfacePoint> roots);

// Points of the plane with integer coordinates, for which geometric predicates are exact.

// |coordinate| < 2^kGridBits: then the largest intermediate of inCircle() is below 2^(4 kGridBits +
// 6) < 2^127.
inline constexpr int kGridBits = 29;

struct GridPoint {
    std::int64_t x = 0;
    std::int64_t y = 0;

    friend bool operator==(const GridPoint&, const GridPoint&) = default;
};

// Twice the signed area of a triangle: positive if it is counter-clockwise, 0 if it is flat.
constexpr std::int64_t orientation(GridPoint a, GridPoint b, GridPoint c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Whether d lies strictly inside the circle through a, b and c, which are counter-clockwise. The
// usual determinant of the paraboloid lift; Guibas and Stolfi 1985, Primitives for the manipulation
// of general subdivisions and the computation of Voronoi diagrams, lemma 8.1.
constexpr bool inCircle(GridPoint a, GridPoint b, GridPoint c, GridPoint d) {
    __extension__ using Wide = __int128;
    const auto term = [&d](GridPoint p, GridPoint q, GridPoint r) {
        const std::int64_t px = p.x - d.x;
        const std::int64_t py = p.y - d.y;
        const std::int64_t minor = (q.x - d.x) * (r.y - d.y) - (q.y - d.y) * (r.x - d.x);
        return Wide{px * px + py * py} * Wide{minor};
    };
    return term(a, b, c) + term(b, c, a) + term(c, a, b) > 0;
}

// Cuts a polygon into its n - 2 triangles, counter-clockwise and never flat, whichever way the
// polygon runs. Vertices may lie on the line between their neighbours. O(n^2) as a rule.
// Meisters 1975, Polygons have ears.
// Throws engine::Error if the polygon has fewer than 3 vertices or touches or crosses itself.
std::vector<std::array<std::uint32_t, 3>> clipEars(std::span<const GridPoint> polygon);

}  // namespace hair::groom
