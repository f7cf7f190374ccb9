#include "hair/groom/growth/surface_triangles.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "hair/groom/growth/surface_net.h"

namespace hair {
namespace {

// [triangle of the scalp], a number that triangles have in common if a way over edges joins them.
std::vector<std::uint32_t> pieces(const Scalp& scalp) {
    const TriangleNet net(scalp.triangles);
    std::vector<std::uint32_t> parent(scalp.triangles.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](std::uint32_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    for (std::uint32_t corner = 0; corner < net.cornerCount(); ++corner) {
        if (net.twin(corner) != TriangleNet::kNone)
            parent[root(corner / 3)] = root(net.twin(corner) / 3);
    }
    for (std::uint32_t i = 0; i < parent.size(); ++i) parent[i] = root(i);
    return parent;
}

// For pieces without a triangle.
void joinLonely(
    std::vector<std::array<std::uint32_t, 3>>& triangles, const Scalp& scalp,
    std::span<const SurfacePoint> roots) {
    const std::vector<std::uint32_t> piece = pieces(scalp);
    std::vector<bool> spanned(scalp.triangles.size(), false);  // [piece]
    for (const auto& triangle : triangles) spanned[piece[roots[triangle[0]].triangle]] = true;
    std::map<std::uint32_t, std::vector<std::uint32_t>> lonely;  // roots by piece
    for (std::uint32_t i = 0; i < roots.size(); ++i) {
        const std::uint32_t home = piece[roots[i].triangle];
        if (!spanned[home]) lonely[home].push_back(i);
    }
    for (const auto& [home, members] : lonely) {
        if (members.size() == 1) triangles.push_back({members[0], members[0], members[0]});
        for (std::size_t i = 1; i < members.size(); ++i)
            triangles.push_back({members[i - 1], members[i], members[i]});
    }
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>>
surfaceTriangles(const Scalp& scalp, std::span<const SurfacePoint> roots) {
    SurfaceNet net(scalp, roots);
    net.makeDelaunay();
    net.removeScalpVertices();
    net.makeDelaunay();
    net.peel();
    std::vector<std::array<std::uint32_t, 3>> triangles = net.triangles();
    joinLonely(triangles, scalp, roots);
    return triangles;
}

}  // namespace hair
