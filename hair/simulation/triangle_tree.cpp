#include "hair/simulation/triangle_tree.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include <glm/common.hpp>

namespace hair {
namespace {

// On lavapipe 12 bake 1.4 times as fast as 4: going through a leaf costs less than finding it.
constexpr std::size_t kMostInLeaf = 12;

struct Box {
    glm::vec3 lower{std::numeric_limits<float>::max()};
    glm::vec3 upper{std::numeric_limits<float>::lowest()};

    void add(const glm::vec3& point) {
        lower = glm::min(lower, point);
        upper = glm::max(upper, point);
    }

    int longestAxis() const {
        const glm::vec3 size = upper - lower;
        return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    }
};

class Builder {
public:
    explicit Builder(const ClosedMesh& mesh) : mesh_(mesh) {
        for (const auto& [a, b, c] : mesh.triangles) {
            const auto& at = mesh.positions;
            centroids_.push_back((at[a] + at[b] + at[c]) / 3.0f);
        }
        tree_.order.resize(mesh.triangles.size());
        std::iota(tree_.order.begin(), tree_.order.end(), 0u);
        tree_.nodes.resize(1);
        split(0, 0, tree_.order.size());
    }

    TriangleTree take() { return std::move(tree_); }

private:
    // Makes node `index` of the triangles order[first, first + count).
    void split(std::size_t index, std::size_t first, std::size_t count) {
        const auto members = std::span(tree_.order).subspan(first, count);
        Box box;
        Box middle;
        for (const std::uint32_t triangle : members) {
            for (const std::uint32_t corner : mesh_.triangles[triangle])
                box.add(mesh_.positions[corner]);
            middle.add(centroids_[triangle]);
        }
        gpu::TreeNode node{
            .lower = box.lower,
            .first = static_cast<std::uint32_t>(first),
            .upper = box.upper,
            .count = static_cast<std::uint32_t>(count)};
        if (count > kMostInLeaf) {
            node.first = static_cast<std::uint32_t>(tree_.nodes.size());
            node.count = 0;
        }
        tree_.nodes[index] = node;
        // Ties go by number here and below, so that the tree is the same everywhere.
        if (count <= kMostInLeaf) {
            std::ranges::sort(members);
            return;
        }
        const int axis = middle.longestAxis();
        const std::size_t half = count / 2;
        std::ranges::nth_element(
            members, members.begin() + static_cast<std::ptrdiff_t>(half),
            [&](std::uint32_t a, std::uint32_t b) {
                return std::pair(centroids_[a][axis], a) < std::pair(centroids_[b][axis], b);
            });
        tree_.nodes.resize(tree_.nodes.size() + 2);
        split(node.first, first, half);
        split(node.first + 1, first + half, count - half);
    }

    const ClosedMesh& mesh_;
    std::vector<glm::vec3> centroids_;
    TriangleTree tree_;
};

}  // namespace

TriangleTree buildTriangleTree(const ClosedMesh& mesh) {
    assert(!mesh.triangles.empty());
    return Builder(mesh).take();
}

}  // namespace hair
