#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "hair/groom/mesh/mesh.h"

namespace hair::groom {

// Directions that tell outside from inside at a triangle's features: with p a point and c the point
// of the surface nearest to it, p is inside if (p - c) . n < 0 for the n of the feature that c lies
// on. Baerentzen and Aanaes 2005, Signed distance computation using the angle weighted
// pseudonormal.
struct Pseudonormals {
    glm::dvec3 face;  // unit length
    std::array<glm::dvec3, 3> edges;  // sum of the two faces' normals; from corner i to the next
    std::array<glm::dvec3, 3> corners;  // sum of the faces' normals times their angles, rad
};

// A surface that bounds a volume: every edge belongs to two triangles that run along it in opposite
// directions. It may have several parts, apart or one in another (a cavity). Parts may cut each
// other; this is not checked. No triangle is without area.
struct ClosedMesh {
    std::vector<glm::vec3> positions;  // [vertex], m, each position once
    std::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise seen from outside
    std::vector<Pseudonormals> normals;  // [triangle]
};

// Joins vertices with equal positions, and leaves out triangles without area. Throws engine::Error
// with the fault and its place for a mesh that is not closed or is inside out.
ClosedMesh closeMesh(const Mesh& mesh);

// Any mesh, with each position once, no triangle without area and no triangle twice. Triangles are
// the same if they have the same corners in the same cyclic order.
struct JoinedMesh {
    std::vector<glm::vec3> positions;  // [vertex], m
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::size_t repeated = 0;  // repeated triangles that were left out
};

JoinedMesh joinMesh(const Mesh& mesh);

// How a mesh's triangles meet at its edges.
struct MeshEdges {
    // Pairs of triangles that run along a common edge in opposite directions, without a third one.
    std::vector<std::array<std::uint32_t, 2>> pairs;
    std::size_t boundary = 0;  // edges with one triangle
    std::size_t opposed = 0;  // edges with two triangles that run along it in one direction
    std::size_t branching = 0;  // edges with more than two triangles
    // Description of the three, with the place of the first of each; empty: none.
    std::string faults;
};

MeshEdges meshEdges(const JoinedMesh& mesh);

// A bounding volume hierarchy of triangles, for nearest neighbours. Every split halves the
// triangles, so no path from the root is longer than halving makes it.
struct TriangleBvh {
    struct Node {
        glm::vec3 low;
        glm::vec3 high;
        std::uint32_t first;  // of a leaf's triangles in `order`, or of two adjacent children
        std::uint32_t count;  // of a leaf's triangles; 0: an inner node
    };
    std::vector<Node> nodes;  // the root first
    std::vector<std::uint32_t> order;  // the mesh's triangles, in the order of the leaves
};

// Needs at least one triangle; triangles without area count, too.
TriangleBvh buildTriangleBvh(
    std::span<const glm::vec3> positions, std::span<const std::array<std::uint32_t, 3>> triangles,
    std::size_t most_in_leaf);

// The squared distance of a point from a node's box.
inline double squareDistance(const glm::dvec3& point, const TriangleBvh::Node& box) {
    const glm::dvec3 off = point - glm::clamp(point, glm::dvec3(box.low), glm::dvec3(box.high));
    return glm::dot(off, off);
}

// Depth of a traversal: every split halves the triangles, and counts have 32 bits.
inline constexpr std::size_t kBvhStackSize = 64;

// Calls visit(slot) for each triangle in a box within the square root of `square` of a point, by
// its place in the order of the leaves and near boxes first. visit() may lessen `square`.
template <class Visit>
void forEachNearer(
    const TriangleBvh& tree, const glm::dvec3& point, const double& square, Visit&& visit) {
    struct StackEntry {
        std::uint32_t node;
        double square;  // of its box's distance
    };
    std::array<StackEntry, kBvhStackSize> stack;
    std::size_t count = 0;
    const auto push = [&](std::uint32_t node) {
        stack[count++] = {node, squareDistance(point, tree.nodes[node])};
    };
    push(0);
    while (count > 0) {
        const StackEntry next = stack[--count];
        if (next.square >= square) continue;
        const TriangleBvh::Node& node = tree.nodes[next.node];
        for (std::size_t i = 0; i < node.count; ++i) visit(node.first + i);
        if (node.count > 0) continue;
        push(node.first);
        push(node.first + 1);
        if (stack[count - 2].square < stack[count - 1].square)
            std::swap(stack[count - 2], stack[count - 1]);
    }
}

// A point of a triangle mesh.
struct MeshPoint {
    glm::dvec3 position{0.0};
    std::uint32_t triangle = 0;
    glm::dvec3 weights{1.0, 0.0, 0.0};  // of the triangle's corners, sum 1, none negative
    double distance = 0.0;  // from the point that was asked for
};

// The best result so far of a search for the nearest point.
struct NearestCandidate {
    double square;  // of the distance
    glm::dvec3 weights{1.0, 0.0, 0.0};
    std::size_t slot = 0;  // of the triangle
};

// Finds the point of a mesh that is nearest to a point. Keeps copies of its arguments.
class NearestSurface {
public:
    // Needs at least one triangle; triangles without area count, too.
    NearestSurface(
        std::span<const glm::vec3> positions,
        std::span<const std::array<std::uint32_t, 3>> triangles);

    MeshPoint operator()(const glm::dvec3& point) const;
    // Returns nothing if that point is `reach` away or farther, which is known much sooner.
    std::optional<MeshPoint> within(const glm::dvec3& point, double reach) const;

private:
    NearestCandidate nearest(const glm::dvec3& point, double square) const;
    MeshPoint meshPoint(const NearestCandidate& best, const glm::dvec3& point) const;

    TriangleBvh tree_;
    std::vector<std::array<glm::vec3, 3>> corners_;  // in the order of the leaves
};

}  // namespace hair::groom
