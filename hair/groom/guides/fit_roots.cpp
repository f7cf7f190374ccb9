#include "hair/groom/guides/fit_roots.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "hair/groom/style/strand_frames.h"

namespace hair {
namespace {

constexpr double kLineThickness = 1e-4;  // of the extent: a tenth of a hair's width on 10 cm
constexpr std::size_t kFewestOnSphere = 10;  // through four roots a sphere goes by chance
constexpr double kFlattestSphere = 50.0;     // radius / extent: a bulge of 1 / 400 of the extent
constexpr double kFarCentre = 1e4;           // of a plane's map, in extents
constexpr int kDirections = 256;             // 14 degrees apart, in which a gap is looked for
// Of the mean of unit vectors to the roots. It is (1 + cos a) / 2 for roots spread evenly up to an
// angle a from the axis, which is then 120 degrees.
constexpr double kAllRound = 0.25;

struct Axes {
    glm::dvec3 sizes;       // ascending
    glm::dmat3 directions;  // [axis], unit length
};

// Eigenvalues and vectors of a symmetric matrix. Golub and Van Loan 2013, Matrix computations, 8.5
// (Jacobi's rotations).
Axes eigenvectors(glm::dmat3 matrix) {
    static constexpr int sweeps = 20;  // it takes about 5
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

// Roots as seen from their mean.
struct Cloud {
    glm::dvec3 mean{0.0};
    std::vector<glm::dvec3> points;
    double extent = 0.0;  // twice the distance of the farthest
    Axes axes;            // of the mean product of coordinates
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

// The sphere |p - c|^2 = r^2 of least sum of squares of |p|^2 - 2 c . p - (r^2 - |c|^2). Seen from
// the mean the centre and the rest come apart, and along the axes the centre's coordinates do.
// Coope 1993, Circle fitting by linear and nonlinear least squares. Its centre, from the mean, if
// it is a good one.
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
    if (off_sphere >= axes.sizes[0]) return {};  // what the plane's is
    return centre;
}

Flattening flattening(const glm::dvec3& centre, const glm::dvec3& axis) {
    const glm::dvec3 right = across(axis);
    return {.centre = centre, .axis = axis, .right = right, .up = glm::cross(axis, right)};
}

// Directions spread evenly, by the golden angle.
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

}  // namespace

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

}  // namespace hair
