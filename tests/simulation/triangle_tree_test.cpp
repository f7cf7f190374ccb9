#include "hair/groom/mesh/surface.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/simulation/closed_meshes.h"

namespace hair::simulation {
namespace {

constexpr std::size_t kMostInLeaf = 12;

struct Walk {
    const groom::ClosedMesh& mesh;
    const groom::TriangleBvh& tree;
    std::vector<int> visits;  // [triangle]
    std::uint32_t depth = 0;
    std::size_t nodes = 0;

    void visit(std::uint32_t index, std::uint32_t level, glm::vec3 lower, glm::vec3 upper) {
        ASSERT_LT(index, tree.nodes.size());
        const groom::TriangleBvh::Node& node = tree.nodes[index];
        ++nodes;
        depth = std::max(depth, level);
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_GE(node.low[axis], lower[axis]);
            EXPECT_LE(node.high[axis], upper[axis]);
        }
        if (node.count == 0) {
            visit(node.first, level + 1, node.low, node.high);
            visit(node.first + 1, level + 1, node.low, node.high);
            return;
        }
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            ++visits[tree.order[i]];
            for (const std::uint32_t corner : mesh.triangles[tree.order[i]]) {
                for (int axis = 0; axis < 3; ++axis) {
                    EXPECT_GE(mesh.positions[corner][axis], node.low[axis]);
                    EXPECT_LE(mesh.positions[corner][axis], node.high[axis]);
                }
            }
        }
    }
};

Walk walk(const groom::ClosedMesh& mesh, const groom::TriangleBvh& tree) {
    Walk result{mesh, tree, std::vector<int>(mesh.triangles.size())};
    result.visit(0, 1, glm::vec3(-1e30f), glm::vec3(1e30f));
    return result;
}

TEST(TriangleBvh, HoldsEveryTriangleOnceInItsBoxes) {
    for (const groom::Mesh& mesh :
         {makeBox({0, 0, 0}, {1, 2, 3}), makeTorus(1.0, 0.3, 40, 20), makeStar()}) {
        const groom::ClosedMesh closed = groom::closeMesh(mesh);
        const groom::TriangleBvh tree =
            groom::buildTriangleBvh(closed.positions, closed.triangles, kMostInLeaf);
        const Walk seen = walk(closed, tree);
        EXPECT_EQ(seen.visits, std::vector<int>(closed.triangles.size(), 1));
        EXPECT_EQ(seen.nodes, tree.nodes.size());
        EXPECT_EQ(tree.order.size(), closed.triangles.size());
    }
}

// 20 * 4^4 triangles are halved; on level 10 leaves have 10.
TEST(TriangleBvh, IsAsShallowAsHalvingMakesIt) {
    const groom::ClosedMesh closed = groom::closeMesh(makeSphere({0, 0, 0}, 1.0, 4));
    const groom::TriangleBvh tree =
        groom::buildTriangleBvh(closed.positions, closed.triangles, kMostInLeaf);
    EXPECT_EQ(walk(closed, tree).depth, 10u);
}

}  // namespace
}  // namespace hair::simulation
