#include "hair/groom/growth/triangle_net.h"

#include <algorithm>
#include <tuple>

namespace hair {

TriangleNet::TriangleNet(std::span<const std::array<std::uint32_t, 3>> triangles) {
    struct Side {
        std::uint32_t low, high;  // the edge's vertices
        std::uint32_t corner;     // opposite
        bool upward;              // runs from low to high
    };
    std::vector<Side> sides;
    sides.reserve(3 * triangles.size());
    for (const auto& triangle : triangles) {
        for (const std::uint32_t vertex : triangle) vertices_.push_back(vertex);
    }
    for (std::uint32_t corner = 0; corner < vertices_.size(); ++corner) {
        const std::uint32_t from = vertices_[after(corner)];
        const std::uint32_t to = vertices_[before(corner)];
        sides.push_back({std::min(from, to), std::max(from, to), corner, from < to});
    }
    std::ranges::sort(
        sides, {}, [](const Side& side) { return std::tuple(side.low, side.high, side.corner); });

    twins_.resize(vertices_.size(), kNone);
    for (std::size_t i = 0; i < sides.size();) {
        std::size_t end = i + 1;
        while (end < sides.size() && sides[end].low == sides[i].low &&
               sides[end].high == sides[i].high)
            ++end;
        if (end - i == 2 && sides[i].upward != sides[i + 1].upward) {
            twins_[sides[i].corner] = sides[i + 1].corner;
            twins_[sides[i + 1].corner] = sides[i].corner;
        }
        i = end;
    }
}

std::vector<std::array<std::uint32_t, 3>> TriangleNet::triangles() const {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::uint32_t corner = 0; corner < cornerCount(); corner += 3) {
        if (exists(corner / 3))
            triangles.push_back({vertices_[corner], vertices_[corner + 1], vertices_[corner + 2]});
    }
    return triangles;
}

TriangleNet::Fan TriangleNet::fan(std::uint32_t corner) const {
    Fan fan;
    std::uint32_t first = corner;
    for (std::uint32_t across = twins_[before(first)]; across != kNone;
         across = twins_[before(first)]) {  // clockwise
        first = before(across);
        if (first == corner) break;
    }
    fan.closed = first == corner && twins_[before(first)] != kNone;
    fan.corners.push_back(first);
    for (std::uint32_t across = twins_[after(first)]; across != kNone && after(across) != first;
         across = twins_[after(fan.corners.back())])
        fan.corners.push_back(after(across));
    return fan;
}

void TriangleNet::setCell(
    std::uint32_t cell, const std::array<std::uint32_t, 3>& vertices,
    const std::array<std::uint32_t, 3>& twins) {
    for (std::uint32_t i = 0; i < 3; ++i) {
        const std::uint32_t corner = 3 * cell + i;
        vertices_[corner] = vertices[i];
        twins_[corner] = twins[i];
        if (twins[i] != kNone) twins_[twins[i]] = corner;
    }
}

std::array<std::uint32_t, 4> TriangleNet::flip(std::uint32_t corner) {
    const std::uint32_t other = twins_[corner];
    const std::uint32_t first = corner / 3;
    const std::uint32_t second = other / 3;
    const std::uint32_t a = vertices_[corner];
    const std::uint32_t b = vertices_[after(corner)];
    const std::uint32_t c = vertices_[before(corner)];
    const std::uint32_t d = vertices_[other];
    const std::uint32_t beyond_ca = twins_[after(corner)];
    const std::uint32_t beyond_ab = twins_[before(corner)];
    const std::uint32_t beyond_bd = twins_[after(other)];
    const std::uint32_t beyond_dc = twins_[before(other)];
    setCell(first, {a, b, d}, {beyond_bd, 3 * second + 2, beyond_ab});
    setCell(second, {a, d, c}, {beyond_dc, beyond_ca, 3 * first + 1});
    return {3 * first, 3 * first + 2, 3 * second, 3 * second + 1};
}

std::array<std::uint32_t, 3> TriangleNet::split(std::uint32_t cell, std::uint32_t vertex) {
    const std::uint32_t corner = 3 * cell;
    const std::uint32_t second = cornerCount() / 3;
    const std::uint32_t third = second + 1;
    const std::uint32_t a = vertices_[corner];
    const std::uint32_t b = vertices_[corner + 1];
    const std::uint32_t c = vertices_[corner + 2];
    const std::array<std::uint32_t, 3> beyond{
        twins_[corner], twins_[corner + 1], twins_[corner + 2]};
    vertices_.resize(vertices_.size() + 6);
    twins_.resize(twins_.size() + 6);
    setCell(cell, {a, b, vertex}, {3 * second + 1, 3 * third, beyond[2]});
    setCell(second, {b, c, vertex}, {3 * third + 1, 3 * cell, beyond[0]});
    setCell(third, {c, a, vertex}, {3 * cell + 1, 3 * second, beyond[1]});
    return {cell, second, third};
}

std::uint32_t TriangleNet::join(const std::array<std::uint32_t, 3>& corners) {
    std::array<std::uint32_t, 3> vertices{};
    std::array<std::uint32_t, 3> twins{};
    for (std::size_t i = 0; i < 3; ++i) {  // the edge from vertex i to the next is opposite i + 2
        vertices[i] = vertices_[after(corners[i])];
        twins[(i + 2) % 3] = twins_[corners[i]];
    }
    for (const std::uint32_t corner : corners) vertices_[corner / 3 * 3] = kNone;
    setCell(corners[0] / 3, vertices, twins);
    return corners[0] / 3;
}

void TriangleNet::erase(std::uint32_t cell) {
    for (std::uint32_t corner = 3 * cell; corner < 3 * cell + 3; ++corner) {
        if (twins_[corner] != kNone) twins_[twins_[corner]] = kNone;
        twins_[corner] = kNone;
        vertices_[corner] = kNone;
    }
}

}  // namespace hair
