#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "engine/transfer.h"
#include "hair/rendering/renderer.h"
#include "hair/simulation/bodies.h"
#include "tests/error_text.h"
#include "tests/gpu_fixture.h"
#include "tests/rendering/device_hair.h"

// The push of drawn strands out of bodies: shaders/strands/collision.glsl.
namespace hair::rendering {
namespace {

constexpr std::uint32_t kVertices = 6;
constexpr std::uint32_t kPieces = 4;

// The rounding of a point of about 0.5 m that is moved and turned, a dozen roundings in total. The
// exponential's error is 3 ulp and that of its argument (Vulkan specification, Precision and
// Operation of SPIR-V Instructions).
constexpr double kRounded = 40 * 0x1p-24;  // m

struct Nearest {
    double gap;  // m, negative inside
    glm::dvec3 normal;
};

Nearest nearestOf(const gpu::Capsule& capsule, const glm::dvec3& position) {
    const glm::dvec3 a(capsule.a), axis(glm::dvec3(capsule.b) - a);
    const double along = std::clamp(glm::dot(position - a, axis) / glm::dot(axis, axis), 0.0, 1.0);
    const glm::dvec3 away = position - a - along * axis;
    return {glm::length(away) - double{capsule.radius}, glm::normalize(away)};
}

// The distance outside after the push for a point that was `gap` outside. From the margin on it is
// unchanged. Below the margin it is an exponential that joins smoothly and stays above a quarter of
// the margin: docs/grooms.md.
double pressedGap(double gap, double margin) {
    if (gap >= margin) return gap;
    const double least = 0.25 * margin;
    return margin == 0.0 ? 0.0
                         : least + (margin - least) * std::exp((gap - margin) / (margin - least));
}

class StrandCollisionTest : public GpuTest {
protected:
    static Settings settingsOf(StrandCollision collision) {
        return {.strands = {.collision = collision, .density = 40, .tessellation = kPieces}};
    }

    static StrandPoints
    evaluate(StrandCollision collision, const glm::mat4& head = glm::mat4(1.0f)) {
        const Settings settings = settingsOf(collision);
        const DeviceHair hair(device(), tangledGroom(kVertices), settings);
        StrandView view = hair.view();
        view.head = head;
        return evaluateStrandPoints(device(), settings, view);
    }

    // Guide segments from the root.
    static double alongOf(std::size_t record) {
        const std::size_t point = record % (kPieces + 1);
        const std::size_t segment = record / (kPieces + 1) % (kVertices - 1);
        return static_cast<double>(segment) + static_cast<double>(point) / kPieces;
    }
};

TEST_F(StrandCollisionTest, PointsAreAsFarOutsideAsIsSaid) {
    // The head has moved: the body with it.
    const glm::mat4 head = glm::rotate(
        glm::translate(glm::mat4(1.0f), glm::vec3(0.02f, -0.01f, 0.03f)), 0.4f,
        glm::normalize(glm::vec3(1.0f, 2.0f, -1.0f)));
    const StrandPoints plain = evaluate(StrandCollision::none, head);
    const StrandPoints pushed = evaluate(StrandCollision::push_out, head);
    ASSERT_EQ(plain.records.size(), pushed.records.size());
    const glm::dmat4 to_head = glm::inverse(glm::dmat4(head));
    int inside = 0, within = 0, outside = 0;
    for (std::size_t i = 0; i < plain.records.size(); ++i) {
        const glm::dvec3 from(to_head * glm::dvec4(plain.records[i].position, 1.0));
        const glm::dvec3 to(to_head * glm::dvec4(pushed.records[i].position, 1.0));
        const double along = alongOf(i);
        const double margin = kMadeUpMargin * std::min(along, 1.0);
        const Nearest nearest = nearestOf(kMadeUpBody, from);
        const double moved =
            std::min(along / 0.25, 1.0) * (pressedGap(nearest.gap, margin) - nearest.gap);
        ASSERT_LE(glm::distance(to, from + moved * nearest.normal), kRounded) << i;
        if (along >= 0.25) {
            ASSERT_GE(nearestOf(kMadeUpBody, to).gap, 0.25 * margin - kRounded) << i;
        }
        ++(nearest.gap < 0.0 ? inside : nearest.gap < margin ? within : outside);
    }
    // There are points of all kinds.
    EXPECT_GT(inside, 100);
    EXPECT_GT(within, 100);
    EXPECT_GT(outside, 100);
}

TEST_F(StrandCollisionTest, RootsStay) {
    const StrandPoints plain = evaluate(StrandCollision::none);
    const StrandPoints pushed = evaluate(StrandCollision::push_out);
    for (std::size_t i = 0; i < plain.records.size(); i += (kPieces + 1) * (kVertices - 1))
        ASSERT_EQ(plain.records[i].position, pushed.records[i].position);
}

TEST_F(StrandCollisionTest, JointsAreEqualToTheLastBit) {
    const StrandPoints points = evaluate(StrandCollision::push_out);
    for (std::uint32_t strand = 0; strand < 4 * 40; ++strand)
        for (std::uint32_t segment = 0; segment + 2 < kVertices; ++segment) {
            const auto& end = points.at(strand / 40, strand % 40, segment, kPieces);
            const auto& start = points.at(strand / 40, strand % 40, segment + 1, 0);
            ASSERT_EQ(end.position, start.position);
            ASSERT_EQ(end.tangent, start.tangent);
        }
}

// A distance field of the half space y >= 0 in the world's frame; a grid of any size holds it
// exactly. The drawn line is a smooth curve there, and finite differences give its tangents.
TEST_F(StrandCollisionTest, FieldsPushAndTurnTangents) {
    constexpr float kHalf = 2.0f;  // m
    const simulation::DistanceField field(
        device(), {.grid =
                       {.distances = 0,
                        .origin = glm::vec3(-kHalf),
                        .cell = 2.0f * kHalf,
                        .points = glm::uvec3(2),
                        .cells_per_metre = 0.5f / kHalf},
                   .distances = {-kHalf, -kHalf, kHalf, kHalf, -kHalf, -kHalf, kHalf, kHalf}});
    const std::vector body{
        gpu::BodyField{.field = field.parameters(), .follows = gpu::kFollowsWorld}};
    const engine::Buffer fields = engine::makeBuffer(device(), body, "fields", "tests");
    constexpr float kMargin = 0.05f;
    const std::vector bodies{gpu::Bodies{
        .capsules = 0,
        .fields = fields.address(),
        .capsule_count = 0,
        .field_count = 1,
        .margin = kMargin,
        .friction = 0.0f}};
    const engine::Buffer buffer = engine::makeBuffer(device(), bodies, "bodies", "tests");

    // Down into the half space, and along it.
    std::vector<glm::vec3> guide;
    for (int i = 0; i < 6; ++i)
        guide.emplace_back(
            0.1f * static_cast<float>(i), 0.2f - 0.08f * static_cast<float>(i), 0.0f);
    constexpr std::uint32_t kFine = 64;
    const Settings settings{
        .strands = {.collision = StrandCollision::push_out, .density = 1, .tessellation = kFine}};
    const DeviceHair hair(device(), oneTriangle(guide), settings);
    StrandView view = hair.view();
    view.bodies = buffer.address();
    const StrandPoints points = evaluateStrandPoints(device(), settings, view);

    float lowest = 1.0f;
    for (std::uint32_t segment = 1; segment < 5; ++segment) {
        for (std::uint32_t i = 1; i < kFine; ++i) {
            const glm::dvec3 before = points.at(0, 0, segment, i - 1).position;
            const glm::dvec3 after = points.at(0, 0, segment, i + 1).position;
            const glm::dvec3 slope = (after - before) * (0.5 * kFine);
            const auto& here = points.at(0, 0, segment, i);
            // Positions of 0.5 m are rounded to 6e-8, which the difference takes 64 times; at the
            // margin's beginning the second derivative jumps, which affects 0.08 / 64 m.
            ASSERT_LE(glm::distance(slope, glm::dvec3(here.tangent)), 1e-3) << segment << " " << i;
            lowest = std::min(lowest, here.position.y);
        }
    }
    // The guide ends 0.2 m deep.
    EXPECT_GE(lowest, 0.25f * kMargin);
    EXPECT_LE(lowest, 0.3f * kMargin);
}

TEST_F(StrandCollisionTest, NeedsBodies) {
    const Settings settings = settingsOf(StrandCollision::push_out);
    const DeviceHair hair(device(), tangledGroom(3), settings);
    StrandView view = hair.view();
    view.bodies = 0;
    EXPECT_EQ(
        errorText([&] { evaluateStrandPoints(device(), settings, view); }),
        "/strands/collision: is push_out, but it is not known what strands collide with");
}

}  // namespace
}  // namespace hair::rendering
