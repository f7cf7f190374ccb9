#pragma once

#include <cstdint>

// Points of the plane with whole coordinates, on which geometric questions have exact answers.
namespace hair {

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

}  // namespace hair
