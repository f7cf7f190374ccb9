#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "engine/error.h"
#include "hair/groom/style/style.h"
#include "tests/groom/surface_meshes.h"
#include "tests/largest_difference.h"

namespace hair::groom {
namespace {

constexpr double kSphereRadius = 0.1;
constexpr double kClearance = 0.004;

// Strands from the top of the ball: through it, along it, away from it, and one without length.
Groom onBall() {
    Groom groom{.strand_count = 4, .vertices_per_strand = 17};
    for (const glm::dvec3& direction :
         {glm::dvec3(0.0, -1.0, 0.1), glm::dvec3(1.0, -0.2, 0.0), glm::dvec3(0.0, 1.0, 0.0),
          glm::dvec3(0.0)})
        for (int i = 0; i < 17; ++i) {
            const glm::dvec3 along =
                direction == glm::dvec3(0.0) ? direction : glm::normalize(direction);
            groom.points.emplace_back(glm::dvec3(0.0, kSphereRadius, 0.0) + 0.01 * i * along);
        }
    return groom;
}

// The ball has flat sides that lie up to r (1 - cos(pi / 48)) = 2.2e-4 m inside the sphere.
TEST(Clearance, LeadsStrandsRoundTheMesh) {
    const Mesh ball = makeSphere(kSphereRadius, 96, 48);
    const Groom before = onBall();
    const Groom after = keepClear(before, ball, kClearance);
    for (std::uint32_t s = 0; s < 4; ++s) {
        const auto points = after.strand(s);
        const auto old = before.strand(s);
        Extremes lengths;
        Extremes gaps;
        for (std::size_t i = 1; i < points.size(); ++i) {
            const double wanted = std::min(kClearance, 0.3 * 0.01 * static_cast<double>(i));
            lengths.add(
                glm::distance(glm::dvec3(points[i]), glm::dvec3(points[i - 1])) -
                glm::distance(glm::dvec3(old[i]), glm::dvec3(old[i - 1])));
            gaps.add(glm::length(glm::dvec3(points[i])) - kSphereRadius - wanted);
        }
        EXPECT_LT(std::max(lengths.greatest(), -lengths.least()), 1e-7) << s;
        if (s == 3) continue;
        EXPECT_GT(gaps.least(), -2.2e-4 - 2e-6) << s;
        // It follows the ball's surface down.
        EXPECT_EQ(gaps.greatest() < 0.01, s == 0) << s;
    }
    for (std::uint32_t s = 2; s < 4; ++s)
        for (std::size_t i = 0; i < 17; ++i)
            EXPECT_EQ(after.strand(s)[i], before.strand(s)[i]) << "it is clear of the ball";
}

// Two balls side by side, and a strand that hangs into the cleft between them. No turn of a single
// segment takes it out: a place clear of one ball is inside the other.
TEST(Clearance, TakesStrandsOutOfAClosingCleft) {
    Mesh balls = makeSphere(kSphereRadius, 96, 48);
    Mesh other = balls;
    const auto offset = static_cast<std::uint32_t>(balls.positions.size());
    for (glm::vec3& position : balls.positions) position.x -= 0.101f;
    for (glm::vec3& position : other.positions) position.x += 0.101f;
    balls.positions.insert(balls.positions.end(), other.positions.begin(), other.positions.end());
    balls.normals.insert(balls.normals.end(), other.normals.begin(), other.normals.end());
    for (const auto& [a, b, c] : other.triangles)
        balls.triangles.push_back({a + offset, b + offset, c + offset});
    Groom groom{.strand_count = 1, .vertices_per_strand = 17};
    for (int i = 0; i < 17; ++i) groom.points.emplace_back(-0.03, 0.07 - 0.006 * i, 0.02);
    groom.points[0] = {-0.101f, 0.1f, 0.0f};
    groom.points[1] = {-0.06f, 0.1f, 0.01f};

    const Groom after = keepClear(groom, balls, kClearance);
    Extremes gaps;
    Extremes lengths;
    for (std::size_t i = 1; i < 17; ++i) {
        const glm::dvec3 point(after.points[i]);
        gaps.add(
            std::min(
                glm::distance(point, glm::dvec3(-0.101, 0.0, 0.0)),
                glm::distance(point, glm::dvec3(0.101, 0.0, 0.0))) -
            kSphereRadius);
        lengths.add(
            glm::distance(point, glm::dvec3(after.points[i - 1])) -
            glm::distance(glm::dvec3(groom.points[i]), glm::dvec3(groom.points[i - 1])));
    }
    EXPECT_GT(gaps.least(), kClearance - 2.2e-4 - 1e-4);  // tolerances of pushes, and of the balls'
                                                          // flat sides
    EXPECT_LT(std::max(lengths.greatest(), -lengths.least()), 1e-7);
}

TEST(Clearance, NeedsAMesh) {
    EXPECT_THROW(style(onBall(), {.clearance = 0.004f}, 1, nullptr), engine::Error);
    EXPECT_EQ(style(onBall(), {}, 1, nullptr).points, onBall().points);
}

}  // namespace
}  // namespace hair::groom
