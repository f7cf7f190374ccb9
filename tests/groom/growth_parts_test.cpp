#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

#include "hair/groom/growth/roots.h"
#include "hair/groom/growth/scalp.h"
#include "hair/groom/growth/scalp_triangulation.h"
#include "hair/random.h"
#include "tests/groom/surface_meshes.h"
#include "tests/largest_difference.h"

namespace hair::groom {
namespace {

using testing::ElementsAre;
using testing::UnorderedElementsAre;

// ---- Outline: against the winding number, which shares nothing with crossing parity.

double windingNumber(const std::vector<glm::dvec2>& polygon, const glm::dvec2& p) {
    double angle = 0.0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec2 a = polygon[i] - p;
        const glm::dvec2 b = polygon[(i + 1) % polygon.size()] - p;
        angle += std::atan2(a.x * b.y - a.y * b.x, glm::dot(a, b));
    }
    return angle / (2.0 * std::numbers::pi);
}

double distanceTo(const std::vector<glm::dvec2>& polygon, const glm::dvec2& p) {
    Extremes distances;  // in lengths of the edge
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec2 a = polygon[i];
        const glm::dvec2 edge = polygon[(i + 1) % polygon.size()] - a;
        const double t = std::clamp(glm::dot(p - a, edge) / glm::dot(edge, edge), 0.0, 1.0);
        distances.add(glm::distance(p, a + t * edge) / glm::length(edge));
    }
    return distances.least();
}

TEST(Outline, ContainsWhatItGoesRound) {
    for (std::uint32_t seed = 0; seed < 10; ++seed) {
        std::vector<glm::dvec2> star;
        for (std::uint32_t i = 0; i < 5 + 7 * seed; ++i) {
            const double angle = 2.0 * std::numbers::pi * i / (5 + 7 * seed);
            star.push_back(
                (0.3 + 0.7 * random01(seed, i, 200)) *
                glm::dvec2(std::cos(angle), std::sin(angle)));
        }
        const Outline outline(star);
        for (std::uint32_t i = 0; i < 2000; ++i) {
            const glm::dvec2 p =
                2.4 * glm::dvec2(random01(seed, i, 201), random01(seed, i, 202)) - 1.2;
            const double distance = distanceTo(star, p);
            if (std::abs(distance - 0.001) < 1e-9) continue;  // on the margin's edge
            EXPECT_EQ(outline.contains(p), windingNumber(star, p) > 0.5 && distance > 0.001);
        }
    }
}

// ---- HashGrid: against all pairs.

TEST(HashGrid, FindsAllThatAreNearAndLeft) {
    std::vector<glm::vec3> points;
    for (std::uint32_t i = 0; i < 400; ++i)
        points.emplace_back(random01(1, i, 0), random01(1, i, 1), 0.1f * random01(1, i, 2));
    for (const double radius : {0.03, 0.15, 3.0}) {
        HashGrid grid(points, radius);
        std::vector<std::uint32_t> place_of(points.size());
        for (std::uint32_t i = 0; i < points.size(); ++i) place_of[grid.source(i)] = i;
        std::vector<bool> erased(points.size(), false);
        for (std::uint32_t i = 0; i < points.size(); ++i) {
            std::vector<std::uint32_t> expected;
            for (std::uint32_t j = 0; j < points.size(); ++j) {
                const double distance = glm::distance(points[i], points[j]);
                if (i != j && !erased[j] && distance < radius) expected.push_back(j);
            }
            std::vector<std::uint32_t> found;
            grid.forEachNear(place_of[i], [&](std::uint32_t place, double distance) {
                found.push_back(grid.source(place));
                EXPECT_EQ(distance, double{glm::distance(points[i], points[grid.source(place)])});
            });
            std::ranges::sort(found);
            EXPECT_EQ(found, expected);
            if (i % 3 == 0) {
                grid.erase(place_of[i]);
                erased[i] = true;
            }
        }
    }
}

// ---- BucketQueue: against looking at all.

TEST(BucketQueue, GivesTheGreatestWeightOfNow) {
    for (const std::uint32_t count : {1u, 10u, 2000u}) {
        std::vector<double> weights;
        std::vector<BucketQueue::Entry> entries;
        for (std::uint32_t i = 0; i < count; ++i) {
            weights.push_back(std::floor(20.0 * random01(2, i, 0)));  // many are equal
            entries.push_back({weights[i], i, i});
        }
        std::vector<bool> gone(count, false);
        BucketQueue queue(entries);
        for (std::uint32_t step = 0; step < count; ++step) {
            std::uint32_t expected = count;
            for (std::uint32_t i = 0; i < count; ++i) {
                if (!gone[i] && (expected == count || weights[i] >= weights[expected]))
                    expected = i;
            }
            ASSERT_EQ(queue.pop([&](std::uint32_t item) { return weights[item]; }), expected);
            gone[expected] = true;
            for (std::uint32_t k = 0; k < 5; ++k)
                weights[hash(step, k, 1) % count] *= random01(step, k, 2);
        }
    }
}

// ---- CornerTable

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

// A star round vertex 0, with the neighbours 1 to 5.
CornerTable star() {
    return CornerTable(Triangles{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 1}});
}

std::vector<std::uint32_t> around(const CornerTable& net, std::uint32_t corner) {
    std::vector<std::uint32_t> vertices;
    for (const std::uint32_t member : net.fan(corner).corners)
        vertices.push_back(net.vertex(CornerTable::after(member)));
    return vertices;
}

TEST(CornerTable, WalksRoundAVertex) {
    const CornerTable net = star();
    EXPECT_TRUE(net.fan(6).closed);
    EXPECT_THAT(around(net, 6), ElementsAre(3, 4, 5, 1, 2));
    EXPECT_FALSE(net.fan(1).closed);  // vertex 1
    EXPECT_THAT(around(net, 1), ElementsAre(2, 0));
}

TEST(CornerTable, FlipsADiagonal) {
    CornerTable net(Triangles{{0, 1, 2}, {2, 1, 3}});
    net.flip(0);  // 1-2 becomes 0-3
    EXPECT_THAT(
        net.triangles(), UnorderedElementsAre(std::array{0u, 1u, 3u}, std::array{0u, 3u, 2u}));
    net.flip(1);
    const Topology topology = topologyOf(net.triangles());
    EXPECT_TRUE(topology.is_manifold);
    EXPECT_EQ(topology.euler, 1);
}

TEST(CornerTable, JoinsWhatItSplit) {
    CornerTable net(Triangles{{0, 1, 2}, {2, 1, 3}});
    const auto cells = net.split(0, 9);
    EXPECT_EQ(topologyOf(net.triangles()).vertices, 5u);
    EXPECT_EQ(topologyOf(net.triangles()).euler, 1);
    const std::uint32_t corner = 3 * cells[0] + 2;
    ASSERT_EQ(net.vertex(corner), 9u);
    const auto corners = net.fan(corner).corners;
    ASSERT_EQ(corners.size(), 3u);
    const std::uint32_t cell = net.join({corners[0], corners[1], corners[2]});
    EXPECT_EQ(net.triangles().size(), 2u);
    for (std::uint32_t i = 3 * cell; i < 3 * cell + 3; ++i) {
        if (net.vertex(i) != 0) continue;
        EXPECT_EQ(net.vertex(net.opposite(i)), 3u);
    }
}

TEST(CornerTable, ErasesACell) {
    CornerTable net = star();
    net.erase(2);
    EXPECT_FALSE(net.exists(2));
    EXPECT_FALSE(net.fan(0).closed);
    EXPECT_THAT(around(net, 0), ElementsAre(4, 5, 1, 2));
}

TEST(CornerTable, LinksOnlyWhatIsASurface) {
    const CornerTable three(Triangles{{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
    const CornerTable opposite(Triangles{{0, 1, 2}, {0, 1, 3}});
    for (std::uint32_t corner = 0; corner < 6; ++corner) {
        EXPECT_EQ(three.opposite(corner), CornerTable::kNone);
        EXPECT_EQ(opposite.opposite(corner), CornerTable::kNone);
    }
}

}  // namespace
}  // namespace hair::groom
