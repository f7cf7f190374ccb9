#include "engine/transfer.h"
#include "hair/rendering/strand_offsets.h"

#include <cmath>
#include <numbers>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "hair/groom/style/displace.h"
#include "tests/gpu_fixture.h"
#include "tests/rendering/device_hair.h"

// Compares frames that don't turn about the guides with their known properties.
namespace hair::rendering {
namespace {

class FramesPassTest : public GpuTest {
protected:
    // The normals [guide][vertex] of guides that moved from rest to `now`.
    static std::vector<glm::dvec3> normals(
        const groom::Groom& rest, const groom::Groom& now,
        const glm::mat4& head = glm::mat4(1.0f)) {
        const Settings settings{.strands = {.curl = {.radius = 0.001f}}};
        const DeviceHair at_rest(device(), rest, settings);
        const DeviceHair moved(device(), now);
        StrandView view = at_rest.view();
        view.guides = moved.view().guides;
        view.head = head;
        const FramesPass pass(device(), view);
        runOnce(device(), [&](engine::Commands& commands) { pass.record(commands, view); });
        const auto floats = engine::downloadAs<glm::vec3>(device(), pass.normals());
        return {floats.begin(), floats.end()};
    }

    static std::vector<glm::dvec3> normals(const groom::Groom& groom) {
        return normals(groom, groom);
    }
};

constexpr double kUlp = 0x1p-24;

// A spiral in a tilted plane: parallel transport along a plane curve turns only about the plane's
// normal, so the component along that normal stays.
TEST_F(FramesPassTest, KeepTheirPartAcrossAPlane) {
    const glm::dvec3 x = glm::normalize(glm::dvec3(1.0, 2.0, -0.5));
    const glm::dvec3 z = glm::normalize(glm::cross(x, glm::dvec3(0.3, 1.0, 1.0)));
    const glm::dvec3 y = glm::cross(z, x);
    std::vector<glm::vec3> guide;
    for (int v = 0; v < 20; ++v) {
        const double angle = 0.4 * v;
        guide.emplace_back(0.1 * std::exp(-0.05 * v) * (std::cos(angle) * x + std::sin(angle) * y));
    }
    const std::vector<glm::dvec3> n = normals(oneTriangle(guide));
    EXPECT_GT(std::abs(glm::dot(n[0], z)), 0.01);
    // The points round to 1e-8 of steps of 0.03 m: 3e-7 in a direction, and there are 20.
    for (int v = 1; v < 20; ++v) EXPECT_NEAR(glm::dot(n[v], z), glm::dot(n[0], z), 20 * 3e-7);
}

// The frame turns by minus torsion times length against the Frenet frame of a helix. The tangents
// are those of chords over two steps of h = 0.1 rad. They are flatter than the curve's by h^2 / 6
// = 0.17 %, and the rotation is smaller by the same share.
TEST_F(FramesPassTest, TurnByMinusTheTorsionOfAHelix) {
    constexpr int kVertices = 200;
    constexpr double kStep = 0.1;  // rad
    constexpr double kRadius = 0.03;  // m
    constexpr double kRise = 0.02;  // m / rad
    std::vector<glm::vec3> guide;
    for (int v = 0; v < kVertices; ++v) {
        const double angle = kStep * v;
        guide.emplace_back(kRadius * std::cos(angle), kRadius * std::sin(angle), kRise * angle);
    }
    const std::vector<glm::dvec3> n = normals(oneTriangle(guide));
    const auto angleInFrenet = [&](int v) {
        const double angle = kStep * v;
        const glm::dvec3 normal(-std::cos(angle), -std::sin(angle), 0.0);
        const glm::dvec3 tangent = glm::normalize(
            glm::dvec3(-kRadius * std::sin(angle), kRadius * std::cos(angle), kRise));
        return std::atan2(glm::dot(n[v], glm::cross(tangent, normal)), glm::dot(n[v], normal));
    };
    const double speed = std::hypot(kRadius, kRise);
    const double torsion = kRise / (speed * speed);
    double turned = 0.0;
    for (int v = 2; v < kVertices - 1; ++v) {  // the chords at the ends span one step
        turned += std::remainder(angleInFrenet(v) - angleInFrenet(v - 1), 2.0 * std::numbers::pi);
        const double expected = -torsion * speed * kStep * (v - 1);
        ASSERT_NEAR(turned, expected, 0.003 * std::abs(expected) + 1e-4) << v;
    }
    EXPECT_LT(turned, -10.0);
}

// Compares with the same method in double precision, from the styling of grooms. The angle between
// two frames that don't turn is the same all along the strand, for any frames at the start.
TEST_F(FramesPassTest, AgreeWithThoseOfStyling) {
    const groom::Groom groom = tangledGroom(16);
    const std::vector<glm::dvec3> n = normals(groom);
    for (std::uint32_t guide = 0; guide < groom.strand_count; ++guide) {
        const std::vector<groom::StrandFrame> frames =
            groom::strandFrames(groom.strand(guide), nullptr);
        const auto angle = [&](std::size_t v) {
            const glm::dvec3& normal = n[guide * 16 + v];
            return std::atan2(
                glm::dot(normal, frames[v].binormal), glm::dot(normal, frames[v].normal));
        };
        for (std::size_t v = 0; v < 16; ++v) {
            const glm::dvec3& normal = n[guide * 16 + v];
            ASSERT_NEAR(glm::length(normal), 1.0, 4 * kUlp);
            // Points of up to 0.5 m round to 3e-8, in steps of 0.02 m and more: 1.5e-6 in a
            // direction. Both methods get the same rounded points; the frames add some twenty
            // roundings of 6e-8 a vertex.
            ASSERT_NEAR(glm::dot(normal, frames[v].tangent), 0.0, 1e-5);
            ASSERT_NEAR(std::remainder(angle(v) - angle(0), 2.0 * std::numbers::pi), 0.0, 1e-4);
        }
    }
}

TEST_F(FramesPassTest, MoveWithTheHead) {
    glm::mat4 head = glm::translate(glm::mat4(1.0f), {0.1f, -0.2f, 0.3f});
    head = glm::rotate(head, 2.0f, glm::normalize(glm::vec3(1.0f, -2.0f, 3.0f)));
    const groom::Groom groom = tangledGroom(8);
    groom::Groom moved = groom;
    for (glm::vec3& point : moved.points) point = glm::vec3(head * glm::vec4(point, 1.0f));
    const std::vector<glm::dvec3> before = normals(groom);
    const std::vector<glm::dvec3> after = normals(groom, moved, head);
    // Points of up to 1 m round to 6e-8, in steps of 0.02 m and more: 3e-6 in a direction. Some of
    // these errors add up over 8 vertices.
    for (std::size_t i = 0; i < before.size(); ++i)
        ASSERT_LT(glm::distance(glm::dmat3(glm::mat3(head)) * before[i], after[i]), 3e-5) << i;
}

// A guide swings round its root from straight up to nearly straight down; its frame turns by the
// same angle, step by step.
TEST_F(FramesPassTest, SwingWithoutAJump) {
    const auto swung = [](double degrees) {
        const double angle = degrees * std::numbers::pi / 180.0;
        std::vector<glm::vec3> guide;
        for (int v = 0; v < 5; ++v)
            guide.emplace_back(0.05 * v * std::sin(angle), 0.05 * v * std::cos(angle), 0.0);
        return oneTriangle(guide);
    };
    std::vector<glm::dvec3> last = normals(swung(0.0));
    const double step = 5.0 * std::numbers::pi / 180.0;
    for (double degrees = 5.0; degrees < 179.0; degrees += 5.0) {
        const std::vector<glm::dvec3> next = normals(swung(0.0), swung(degrees));
        // A chord is no longer than its arc; directions are good to 1e-6.
        for (std::size_t i = 0; i < next.size(); ++i)
            ASSERT_LT(glm::distance(last[i], next[i]), step + 1e-5) << degrees;
        last = next;
    }
}

TEST_F(FramesPassTest, AreUnitVectorsWherePointsCoincide) {
    const glm::vec3 root(0.1f, 0.2f, 0.3f);
    const glm::vec3 next(0.2f, 0.2f, 0.3f);
    for (const std::vector<glm::vec3>& guide :
         {std::vector(4, root), std::vector{root, root, next, next},
          std::vector{root, next, root, next}}) {
        for (const glm::dvec3& normal : normals(oneTriangle(guide)))
            ASSERT_NEAR(glm::length(normal), 1.0, 4 * kUlp);
    }
}

}  // namespace
}  // namespace hair::rendering
