#include "hair/groom/guides/bind_strands.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "hair/random.h"

namespace hair::groom {
namespace {

std::vector<std::uint32_t>
nearestByAll(const std::vector<glm::vec3>& points, const glm::vec3& place, std::size_t count) {
    std::vector<std::uint32_t> order(points.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::sort(order, {}, [&](std::uint32_t i) {
        const glm::dvec3 apart = glm::dvec3(points[i]) - glm::dvec3(place);
        return std::pair(glm::dot(apart, apart), i);
    });
    order.resize(std::min(count, order.size()));
    return order;
}

void expectNearest(const std::vector<glm::vec3>& points, std::size_t count) {
    const RootKdTree tree(points);
    for (std::uint32_t i = 0; i < 100; ++i) {
        const glm::vec3 place(random01(9, i, 1), random01(9, i, 2), random01(9, i, 3));
        std::vector<std::uint32_t> nearest(count);
        nearest.resize(tree.find(place, nearest));
        EXPECT_EQ(nearest, nearestByAll(points, place, count));
    }
}

TEST(RootKdTree, FindsTheNearest) {
    std::vector<glm::vec3> points;
    for (std::uint32_t i = 0; i < 1000; ++i)
        points.emplace_back(random01(1, i, 1), random01(1, i, 2), random01(1, i, 3));
    expectNearest(points, 1);
    expectNearest(points, 8);
}

// A lattice has equal distances, and coordinates that are equal.
TEST(RootKdTree, BreaksTiesByIndex) {
    std::vector<glm::vec3> points;
    for (int i = 0; i < 400; ++i) points.emplace_back(0.1f * (i % 10), 0.0f, 0.1f * (i / 20));
    expectNearest(points, 8);
    expectNearest(std::vector<glm::vec3>(50, glm::vec3(0.5f)), 8);
}

TEST(RootKdTree, FindsFewerWhereThereAreFewer) {
    expectNearest({{0.1f, 0.2f, 0.3f}}, 8);
    expectNearest({{0.1f, 0.2f, 0.3f}, {0.9f, 0.8f, 0.7f}, {0.5f, 0.5f, 0.5f}}, 8);
}

}  // namespace
}  // namespace hair::groom
