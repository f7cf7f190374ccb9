#include "hair/groom/mesh/winding_number.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace hair::groom {
namespace {

// The leaves are small, because the solid angle of a triangle costs more than that of a multipole.
constexpr std::size_t kMostInWindingLeaf = 4;
constexpr std::size_t kWindingStackSize =
    64;  // enough: every split halves, and counts have 32 bits

using TriangleCorners = std::array<glm::dvec3, 3>;

TriangleCorners inDouble(const std::array<glm::vec3, 3>& corners) {
    return {glm::dvec3(corners[0]), glm::dvec3(corners[1]), glm::dvec3(corners[2])};
}

// The solid angle of a triangle over 4 pi, positive behind it: van Oosterom and Strackee 1983, The
// solid angle of a plane triangle, eq. 8. In the plane of the triangle it has no sign and is 0.
double windingOf(const TriangleCorners& corners, const glm::dvec3& point) {
    const glm::dvec3 a = corners[0] - point, b = corners[1] - point, c = corners[2] - point;
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    const double volume = glm::dot(a, glm::cross(b, c));
    if (volume == 0.0) return 0.0;
    const double across =
        la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
    return std::atan2(volume, across) / (2.0 * std::numbers::pi);
}

// The symmetric, traceless part of a sum of n_i x_j, in the order of Multipole.
std::array<double, 5> quadrupoleOf(const glm::dmat3& sum) {
    const double third = (sum[0][0] + sum[1][1] + sum[2][2]) / 3.0;
    const auto even = [&](int i, int j) { return (sum[i][j] + sum[j][i]) / 2.0; };
    return {sum[0][0] - third, sum[1][1] - third, even(0, 1), even(0, 2), even(1, 2)};
}

// Returns the same part of a sum of n_i x_j x_k, [i].
std::array<double, 10> octupoleOf(const std::array<glm::dmat3, 3>& sum) {
    const auto even = [&](int i, int j, int k) {
        const auto at = [&](int n, int x, int y) { return sum[static_cast<std::size_t>(n)][x][y]; };
        return (at(i, j, k) + at(j, k, i) + at(k, i, j)) / 3.0;  // symmetric in the last two
    };
    glm::dvec3 fifth;
    for (int i = 0; i < 3; ++i) fifth[i] = (even(0, 0, i) + even(1, 1, i) + even(2, 2, i)) / 5.0;
    const auto alone = [&](int i) { return even(i, i, i) - 3.0 * fifth[i]; };
    const auto twice = [&](int i, int j) { return even(i, i, j) - fifth[j]; };
    return {alone(0),    alone(1),    alone(2),    twice(0, 1), twice(0, 2),
            twice(1, 0), twice(1, 2), twice(2, 0), twice(2, 1), even(0, 1, 2)};
}

Multipole multipoleOf(std::span<const std::array<glm::vec3, 3>> triangles) {
    Multipole result{};
    double area = 0.0;
    for (const auto& triangle : triangles) {
        const auto [a, b, c] = inDouble(triangle);
        const double size = glm::length(glm::cross(b - a, c - a)) / 2.0;
        result.centre += size * (a + b + c) / 3.0;
        area += size;
    }
    result.centre /= area;
    glm::dmat3 second(0.0);
    std::array<glm::dmat3, 3> third{glm::dmat3(0.0), glm::dmat3(0.0), glm::dmat3(0.0)};
    for (const auto& triangle : triangles) {
        auto [a, b, c] = inDouble(triangle);
        a -= result.centre, b -= result.centre, c -= result.centre;
        const glm::dvec3 normal = glm::cross(b - a, c - a) / 2.0;  // times the area
        const glm::dvec3 sum = a + b + c;
        // The mean of x x over a triangle.
        const glm::dmat3 square = (glm::outerProduct(a, a) + glm::outerProduct(b, b) +
                                   glm::outerProduct(c, c) + glm::outerProduct(sum, sum)) /
                                  12.0;
        result.dipole += normal;
        second += glm::outerProduct(sum / 3.0, normal);
        for (int i = 0; i < 3; ++i) third[static_cast<std::size_t>(i)] += normal[i] * square;
        for (const glm::dvec3& corner : {a, b, c})
            result.radius = std::max(result.radius, glm::length(corner));
    }
    result.quadrupole = quadrupoleOf(second);
    result.octupole = octupoleOf(third);
    return result;
}

// The solid angle of triangles at the offset `away`, as far as their moments tell: from x / |x|^3
// and its first and second derivatives.
double solidAngle(const Multipole& moments, const glm::dvec3& away) {
    const double square = glm::dot(away, away);
    const double x = away.x, y = away.y, z = away.z;
    const double xx = x * x, yy = y * y, zz = z * z;
    const auto& q = moments.quadrupole;
    const auto& o = moments.octupole;
    const double second =
        q[0] * (xx - zz) + q[1] * (yy - zz) + 2.0 * (q[2] * x * y + q[3] * x * z + q[4] * y * z);
    const double third = x * (o[0] * xx + 3.0 * (o[5] * yy + o[7] * zz)) +
                         y * (o[1] * yy + 3.0 * (o[3] * xx + o[8] * zz)) +
                         z * (o[2] * zz + 3.0 * (o[4] * xx + o[6] * yy)) + 6.0 * o[9] * x * y * z;
    return (glm::dot(moments.dipole, away) + (-3.0 * second + 7.5 * third / square) / square) /
           (square * std::sqrt(square));
}

}  // namespace

WindingNumber::WindingNumber(
    std::span<const glm::vec3> positions, std::span<const std::array<std::uint32_t, 3>> triangles)
    : tree_(buildTriangleBvh(positions, triangles, kMostInWindingLeaf)),
      multipoles_(tree_.nodes.size()) {
    corners_.reserve(triangles.size());
    for (const std::uint32_t triangle : tree_.order) {
        const auto& [a, b, c] = triangles[triangle];
        corners_.push_back({positions[a], positions[b], positions[c]});
    }
    // Children come after their parents, and their triangles are adjacent.
    struct Range {
        std::size_t first, count;
    };
    std::vector<Range> ranges(tree_.nodes.size());
    for (std::size_t i = tree_.nodes.size(); i-- > 0;) {
        const TriangleBvh::Node& node = tree_.nodes[i];
        ranges[i] = node.count > 0 ? Range{node.first, node.count}
                                   : Range{
                                         ranges[node.first].first,
                                         ranges[node.first].count + ranges[node.first + 1].count};
        multipoles_[i] = multipoleOf(std::span(corners_).subspan(ranges[i].first, ranges[i].count));
    }
}

double WindingNumber::operator()(const glm::dvec3& point, double reach) const {
    std::array<std::uint32_t, kWindingStackSize> stack;
    std::size_t count = 0;
    stack[count++] = 0;
    double sum = 0.0;
    while (count > 0) {
        const std::uint32_t index = stack[--count];
        const TriangleBvh::Node& node = tree_.nodes[index];
        const Multipole& moments = multipoles_[index];
        const glm::dvec3 away = moments.centre - point;
        if (glm::length(away) > reach * moments.radius) {
            sum += solidAngle(moments, away) / (4.0 * std::numbers::pi);
        } else if (node.count > 0) {
            for (std::size_t i = node.first; i < node.first + node.count; ++i)
                sum += windingOf(inDouble(corners_[i]), point);
        } else {
            assert(count + 2 <= kWindingStackSize);
            stack[count++] = node.first + 1;
            stack[count++] = node.first;
        }
    }
    return sum;
}

}  // namespace hair::groom
