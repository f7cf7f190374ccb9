#include "hair/groom/guides/root_triangles.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "engine/process.h"
#include "hair/groom/growth/scalp.h"
#include "hair/groom/growth/triangulate.h"
#include "hair/groom/mesh/surface.h"
#include "hair/groom/style/displace.h"

namespace hair::groom {
namespace {

// ---- Long triangles -----------------------------------------------------------------------------

constexpr double kLongest = 3.0;  // spacings
constexpr double kLowest = 0.01;  // height / longest edge

using Triangle = std::array<std::uint32_t, 3>;

double lowerMedian(std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

// The roots at the other ends of each root's edges.
class Neighbours {
public:
    Neighbours(std::span<const Triangle> triangles, std::size_t roots) : starts_(roots + 1, 0) {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;  // from, to
        edges.reserve(6 * triangles.size());
        for (const auto& [a, b, c] : triangles)
            edges.insert(edges.end(), {{a, b}, {b, a}, {b, c}, {c, b}, {c, a}, {a, c}});
        std::ranges::sort(edges);
        edges.erase(std::ranges::unique(edges).begin(), edges.end());
        for (const auto& [from, to] : edges) {
            ++starts_[from + 1];
            ends_.push_back(to);
        }
        std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
    }

    std::span<const std::uint32_t> of(std::uint32_t root) const {
        return std::span(ends_).subspan(starts_[root], starts_[root + 1] - starts_[root]);
    }

private:
    std::vector<std::size_t> starts_;  // [root], and one more at the end
    std::vector<std::uint32_t> ends_;
};

// The spacing at each root; 0 at roots without an edge.
std::vector<double>
spacings(std::span<const Triangle> triangles, std::span<const glm::vec3> roots) {
    const Neighbours neighbours(triangles, roots.size());
    std::vector<double> own(roots.size(), 0.0);
    std::vector<double> values;
    for (std::uint32_t root = 0; root < roots.size(); ++root) {
        values.clear();
        for (const std::uint32_t other : neighbours.of(root))
            values.push_back(glm::distance(glm::dvec3(roots[root]), glm::dvec3(roots[other])));
        if (!values.empty()) own[root] = lowerMedian(values);
    }
    std::vector<double> round(roots.size(), 0.0);
    for (std::uint32_t root = 0; root < roots.size(); ++root) {
        values.assign(1, own[root]);
        for (const std::uint32_t other : neighbours.of(root)) values.push_back(own[other]);
        round[root] = lowerMedian(values);
    }
    return round;
}

// Leaves out the triangles that reach over places without roots: triangles with an edge of more
// than three times the spacing round their corners, and slivers that are lower than 1 % of their
// length, as in the hulls of rows of roots. The spacing at a root is the median of its edges, and
// then the median of those of its neighbours, the lower one of two. At the edge of a face or a
// parting, a root has no more edges across it than others, two of them along it (a polygon's
// corners have less than two diagonals each), and its neighbours inland have none. Evenly spread
// roots have no edges of more than 2 spacings between them. Random roots have about one triangle
// in a thousand with an edge of more than 3. If no triangle is left, all are kept.
std::vector<Triangle>
withoutLongTriangles(std::vector<Triangle> triangles, std::span<const glm::vec3> roots) {
    const std::vector<double> spacing = spacings(triangles, roots);
    const auto isLong = [&](const Triangle& triangle) {
        const glm::dvec3 a(roots[triangle[0]]);
        const glm::dvec3 b(roots[triangle[1]]);
        const glm::dvec3 c(roots[triangle[2]]);
        const double longest =
            std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
        const double twice_area = glm::length(glm::cross(b - a, c - a));
        // The widest spacing of the three, because where roots get denser, edges are as long as
        // those of the sparser side.
        const double limit =
            std::max({spacing[triangle[0]], spacing[triangle[1]], spacing[triangle[2]]});
        return longest > kLongest * limit || twice_area < kLowest * longest * longest;
    };
    std::vector<Triangle> kept;
    std::ranges::remove_copy_if(triangles, std::back_inserter(kept), isLong);
    return kept.empty() ? triangles : kept;
}

// ---- The surface that roots lie on --------------------------------------------------------------

// The simplest surface that roots lie on.
struct RootSurface {
    enum class Kind { line, plane, sphere };
    Kind kind = Kind::line;
    // A sphere is seen from its centre, with the middle of the largest gap between the roots
    // opposite the axis. A plane is seen along its normal, from a centre so far away that the map
    // is as good as parallel. For a line, only the axis counts: its direction.
    Flattening flattening;
    bool all_round = false;  // a sphere with roots on all sides
};

// Relative to the extent: a tenth of a hair's width on 10 cm.
constexpr double kLineThickness = 1e-4;
constexpr std::size_t kFewestOnSphere = 10;  // a sphere through four roots always exists
constexpr double kFlattestSphere = 50.0;  // radius / extent: a bulge of 1 / 400 of the extent
constexpr double kFarCentre = 1e4;  // for the map of a plane, in extents
constexpr int kDirections = 256;  // 14 degrees apart, to look for a gap
// Length of the mean of unit vectors to the roots, below which they are on all sides. The mean is
// (1 + cos a) / 2 for roots spread evenly up to an angle a from the axis, which is then 120
// degrees.
constexpr double kAllRound = 0.25;

struct Axes {
    glm::dvec3 sizes;  // ascending
    glm::dmat3 directions;  // [axis], unit length
};

// Returns eigenvalues and eigenvectors of a symmetric matrix. Golub and Van Loan 2013, Matrix
// computations, 8.5 (Jacobi's rotations).
Axes eigenvectors(glm::dmat3 matrix) {
    static constexpr int sweeps = 20;  // enough: about 5 are needed
    glm::dmat3 vectors(1.0);
    for (int i = 0; i < 3 * sweeps; ++i) {
        const int p = i % 3;
        const int q = (p + 1) % 3;
        if (matrix[p][q] == 0.0) continue;
        const double ratio = (matrix[q][q] - matrix[p][p]) / (2.0 * matrix[p][q]);
        const double tangent =
            std::copysign(1.0, ratio) / (std::abs(ratio) + std::hypot(1.0, ratio));
        const double cosine = 1.0 / std::hypot(1.0, tangent);
        glm::dmat3 rotation(1.0);
        rotation[p][p] = rotation[q][q] = cosine;
        rotation[q][p] = tangent * cosine;
        rotation[p][q] = -tangent * cosine;
        matrix = glm::transpose(rotation) * matrix * rotation;
        matrix[p][q] = matrix[q][p] = 0.0;
        vectors = vectors * rotation;
    }
    std::array<int, 3> order{0, 1, 2};
    std::ranges::sort(order, {}, [&](int k) { return std::pair(matrix[k][k], k); });
    Axes axes;
    for (int k = 0; k < 3; ++k) {
        const int from = order[static_cast<std::size_t>(k)];
        axes.sizes[k] = std::max(matrix[from][from], 0.0);
        axes.directions[k] = glm::normalize(vectors[from]);
    }
    return axes;
}

// Roots relative to their mean.
struct Cloud {
    glm::dvec3 mean{0.0};
    std::vector<glm::dvec3> points;
    double extent = 0.0;  // twice the distance of the farthest
    Axes axes;  // of the mean product of coordinates
};

Cloud cloudOf(std::span<const glm::vec3> roots) {
    Cloud cloud;
    const auto count = static_cast<double>(roots.size());
    for (const glm::vec3& root : roots) cloud.mean += glm::dvec3(root) / count;
    glm::dmat3 products(0.0);
    for (const glm::vec3& root : roots) {
        const glm::dvec3 p = glm::dvec3(root) - cloud.mean;
        cloud.points.push_back(p);
        cloud.extent = std::max(cloud.extent, 2.0 * glm::length(p));
        products += glm::outerProduct(p, p) / count;
    }
    cloud.axes = eigenvectors(products);
    return cloud;
}

// Fits the sphere |p - c|^2 = r^2 with the least sum of squares of |p|^2 - 2 c . p - (r^2 -
// |c|^2). Relative to the mean, the equations of the centre separate from the rest, and along
// the axes the equations of the centre's coordinates separate from each other. Coope 1993, Circle
// fitting by linear and nonlinear least squares. Returns the centre, relative to the mean, if the
// fit is good.
std::optional<glm::dvec3> fitSphere(const Cloud& cloud) {
    const Axes& axes = cloud.axes;
    if (cloud.points.size() < kFewestOnSphere || axes.sizes[0] <= 0.0) return {};
    const auto count = static_cast<double>(cloud.points.size());
    double mean_square = 0.0;
    glm::dvec3 moment(0.0);
    for (const glm::dvec3& p : cloud.points) {
        mean_square += glm::dot(p, p) / count;
        moment += glm::dot(p, p) / count * p;
    }
    glm::dvec3 centre(0.0);
    for (int k = 0; k < 3; ++k)
        centre += glm::dot(moment, axes.directions[k]) / (2.0 * axes.sizes[k]) * axes.directions[k];
    const double radius = std::sqrt(mean_square + glm::dot(centre, centre));
    if (!(radius <= kFlattestSphere * cloud.extent)) return {};
    double off_sphere = 0.0;
    for (const glm::dvec3& p : cloud.points) {
        const double off = glm::distance(p, centre) - radius;
        off_sphere += off * off / count;
    }
    if (off_sphere >= axes.sizes[0]) return {};  // the plane fits at least as well
    return centre;
}

Flattening flattening(const glm::dvec3& centre, const glm::dvec3& axis) {
    const glm::dvec3 right = across(axis);
    return {.centre = centre, .axis = axis, .right = right, .up = glm::cross(axis, right)};
}

// Returns one of the directions spread evenly by the golden angle.
glm::dvec3 direction(int index) {
    const double height = 1.0 - (2.0 * index + 1.0) / kDirections;
    const double turn = index * std::numbers::pi * (3.0 - std::sqrt(5.0));
    const double radius = std::sqrt(1.0 - height * height);
    return {radius * std::cos(turn), height, radius * std::sin(turn)};
}

RootSurface onSphere(std::span<const glm::vec3> roots, const glm::dvec3& centre) {
    std::vector<glm::dvec3> seen;
    glm::dvec3 mean(0.0);
    for (const glm::vec3& root : roots) {
        const glm::dvec3 from_centre = glm::dvec3(root) - centre;
        const double distance = glm::length(from_centre);
        if (distance <= 0.0) continue;
        seen.push_back(from_centre / distance);
        mean += seen.back() / static_cast<double>(roots.size());
    }
    const auto nearest = [&](const glm::dvec3& gap) {  // as a cosine
        double most = -1.0;
        for (const glm::dvec3& root : seen) most = std::max(most, glm::dot(root, gap));
        return most;
    };
    const double size = glm::length(mean);
    glm::dvec3 widest = size > 0.0 ? -mean / size : direction(0);
    double least = nearest(widest);
    for (int i = 0; i < kDirections; ++i) {
        const double near = nearest(direction(i));
        if (near >= least) continue;
        least = near;
        widest = direction(i);
    }
    return {
        .kind = RootSurface::Kind::sphere,
        .flattening = flattening(centre, -widest),
        .all_round = size < kAllRound};
}

// Fits a surface to at least one root. It is a line if the roots are within 1e-4 of their extent of
// one. It is a sphere if that fits at least ten roots better than a plane, with a radius of at most
// 50 times their extent. Otherwise it is a plane.
RootSurface fitRoots(std::span<const glm::vec3> roots) {
    const Cloud cloud = cloudOf(roots);
    const Axes& axes = cloud.axes;
    if (axes.sizes[1] <= kLineThickness * kLineThickness * axes.sizes[2])
        return {.kind = RootSurface::Kind::line, .flattening = {.axis = axes.directions[2]}};
    if (const auto centre = fitSphere(cloud)) return onSphere(roots, cloud.mean + *centre);
    const glm::dvec3& normal = axes.directions[0];
    return {
        .kind = RootSurface::Kind::plane,
        .flattening = flattening(cloud.mean - kFarCentre * cloud.extent * normal, normal)};
}

// ---- Triangles ----------------------------------------------------------------------------------

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

// Returns triangles of roots on a line, which have no area: pairs of neighbours, from the first
// root's end to the other.
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

// The distinct places of roots in the plane, with a root for each.
struct Places {
    std::vector<std::uint32_t> roots;  // [place]
    std::vector<GridPoint> points;  // [place], ascending by x, then y
};

// Returns the places of roots on the grid that triangulate() rounds to. The extent fills the grid,
// so triangulate() takes the points as they are, and the convex hull is as exact here as there.
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

// Returns the places on the convex hull, counter-clockwise, including those on its edges. If all
// are on a line, the places between its ends come twice. Andrew 1979, Another efficient algorithm
// for convex hulls in two dimensions.
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
    hull.pop_back();  // the first place again
    return hull;
}

// Returns triangles of the places' roots.
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

// Closes the gap that the map can't show, outside the convex hull, for roots all round a sphere.
// Seen from the other side, the hull goes round the gap.
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

// Whether the outer side faces the centre. Without normals, hair leaves a plane on its outer side,
// and a sphere's outer side is outward.
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
    engine::Step step("finds the surface under roots", guides.strand_count);
    for (std::uint32_t i = 0; i < guides.strand_count; ++i) {
        step.advance();
        const MeshPoint at = surface(glm::dvec3(guides.strand(i)[0]));
        const auto& corners = mesh.triangles[at.triangle];
        glm::dvec3 sum(0.0);
        std::size_t heaviest = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double weight = at.weights[static_cast<int>(k)];
            sum += weight * glm::dvec3(mesh.normals[corners[k]]);
            if (weight > at.weights[static_cast<int>(heaviest)]) heaviest = k;
        }
        // Corners can face opposite ways if a modelled hair card is folded.
        const double length = glm::length(sum);
        normals.push_back(
            length > 1e-6 ? glm::vec3(sum / length) : mesh.normals[corners[heaviest]]);
    }
    return normals;
}

}  // namespace hair::groom
