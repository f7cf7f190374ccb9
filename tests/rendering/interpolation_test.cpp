#include <cmath>
#include <utility>

#include <glm/ext/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "hair/rendering/renderer.h"
#include "tests/error_text.h"
#include "tests/gpu_fixture.h"
#include "tests/rendering/device_hair.h"
#include "tests/rendering/expect_near_reference.h"

// Strands between three guides: thesis 2.3.1 to 2.3.4.
namespace hair::rendering {
namespace {

constexpr double kNearReference = 20 * 0x1p-24 * 1.5 * 2.0;  // as in expect_near_reference.h

class InterpolationTest : public GpuTest {
protected:
    static StrandPoints evaluate(const groom::Groom& groom, const StrandSettings& strands) {
        const DeviceHair hair(device(), groom, {.strands = strands});
        return evaluateStrandPoints(device(), {.strands = strands}, hair.view());
    }

    static void expectReference(const groom::Groom& groom, const StrandSettings& strands) {
        expectNearReference(
            evaluate(groom, strands), groom, {.strands = strands}, madeUpContacts(groom));
    }
};

constexpr Interpolation kAll[] = {
    Interpolation::multi, Interpolation::single, Interpolation::mixed};
constexpr Curve kCurves[] = {Curve::bspline, Curve::bspline_unpinned, Curve::catmull_rom};

TEST_F(InterpolationTest, AgreesWithTheReference) {
    for (const Interpolation interpolation : kAll) {
        for (const Curve curve : kCurves) {
            SCOPED_TRACE(testing::Message() << int(interpolation) << " " << int(curve));
            expectReference(
                tangledGroom(6), {.interpolation = interpolation,
                                  .blend = 0.3f,
                                  .density = 24,
                                  .tessellation = 3,
                                  .tip_width = 0.001f,
                                  .curve = curve,
                                  .taper_start = 0.3f});
        }
    }
}

// Includes guides of one segment: every window of four control points holds both of their ends.
TEST_F(InterpolationTest, CollisionRuleAgreesWithTheReference) {
    for (const Interpolation interpolation : {Interpolation::multi, Interpolation::mixed}) {
        for (const auto& [curve, vertices] :
             {std::pair{Curve::bspline, 2u},
              {Curve::bspline, 8u},
              {Curve::bspline_unpinned, 3u},
              {Curve::catmull_rom, 3u}}) {
            SCOPED_TRACE(testing::Message() << int(interpolation) << " " << int(curve));
            expectReference(
                tangledGroom(vertices), {.interpolation = interpolation,
                                         .blend = 0.7f,
                                         .collision_rule = true,
                                         .density = 16,
                                         .tessellation = 3,
                                         .curve = curve});
        }
    }
}

TEST_F(InterpolationTest, RootsAreTheSame) {
    const groom::Groom groom = tangledGroom(5);
    const StrandSettings plain{.density = 50, .tessellation = 1};
    const StrandPoints expected = evaluate(groom, plain);
    for (const Interpolation interpolation : kAll) {
        for (const bool rule : {false, true}) {
            StrandSettings strands = plain;
            strands.interpolation = interpolation;
            strands.collision_rule = rule;
            const StrandPoints points = evaluate(groom, strands);
            for (std::uint32_t i = 0; i < 4 * 50; ++i) {
                ASSERT_LT(
                    glm::distance(
                        points.at(i / 50, i % 50, 0, 0).position,
                        expected.at(i / 50, i % 50, 0, 0).position),
                    kNearReference);
            }
        }
    }
}

// Guide i of each triangle goes along axis i, so a strand's direction shows the guide that it
// follows. A third of n strands follow each guide: a binomial number with variance n 2 / 9, within
// 4 deviations. The random numbers are the same on every run.
TEST_F(InterpolationTest, GuidesHaveEqualTerritories) {
    constexpr std::uint32_t kDensity = 1000;
    const glm::vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    groom::Groom groom =
        oneTriangle({std::vector{x, x + x}, std::vector{y, y + y}, std::vector{z, z + z}});
    groom.root_triangles.assign(10, {0, 1, 2});
    const StrandPoints points = evaluate(
        groom, {.interpolation = Interpolation::single, .density = kDensity, .tessellation = 1});
    glm::dvec3 followers(0.0);
    for (std::uint32_t i = 0; i < 10 * kDensity; ++i) {
        const auto& root = points.at(i / kDensity, i % kDensity, 0, 0);
        const auto& tip = points.at(i / kDensity, i % kDensity, 0, 1);
        const glm::dvec3 along = tip.position - root.position;
        followers += along;
        // The nearest corner has the greatest weight, as the triangle is equilateral.
        for (int axis = 0; axis < 3; ++axis) {
            ASSERT_GE(
                glm::dot(along, glm::dvec3(root.position)), root.position[axis] - kNearReference);
        }
    }
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(followers[axis], 1e4 / 3.0, 4.0 * std::sqrt(1e4 * 2.0 / 9.0));
}

// The guide's offset turns with the head.
TEST_F(InterpolationTest, TurnsWithTheGuides) {
    groom::Groom groom = tangledGroom(5);
    groom.root_normals.clear();
    const glm::mat3 turn(
        glm::rotate(glm::mat4(1.0f), 2.0f, glm::normalize(glm::vec3(1.0f, -2.0f, 3.0f))));
    groom::Groom turned = groom;
    for (glm::vec3& point : turned.points) point = turn * point;
    for (const Interpolation interpolation : kAll) {
        const StrandSettings strands{
            .interpolation = interpolation, .density = 20, .tessellation = 2};
        const StrandPoints before = evaluate(groom, strands);
        const StrandPoints after = evaluate(turned, strands);
        for (std::size_t i = 0; i < before.records.size(); ++i) {
            ASSERT_LT(
                glm::distance(turn * before.records[i].position, after.records[i].position),
                2 * kNearReference);
        }
    }
}

TEST_F(InterpolationTest, JointsAreEqualToTheLastBitWhereContactsStart) {
    for (const Curve curve : kCurves) {
        const StrandPoints points = evaluate(
            tangledGroom(8),
            {.collision_rule = true, .density = 20, .tessellation = 3, .curve = curve});
        for (std::uint32_t i = 0; i < 4 * 20 * 6; ++i) {
            const auto& end = points.at(i / 120, i / 6 % 20, i % 6, 3);
            const auto& start = points.at(i / 120, i / 6 % 20, i % 6 + 1, 0);
            ASSERT_EQ(end.position, start.position);
            ASSERT_EQ(end.tangent, start.tangent);
        }
    }
}

TEST_F(InterpolationTest, CollisionRuleNeedsContacts) {
    const Settings settings{.strands = {.collision_rule = true}};
    const DeviceHair hair(device(), tangledGroom(3), settings);
    StrandView view = hair.view();
    view.contacts = 0;
    EXPECT_EQ(
        errorText([&] { evaluateStrandPoints(device(), settings, view); }),
        "/strands/collision_rule: is set, but it is not known where guides touch bodies");
}

// One pattern for all triangles; the fold is that of 2.3.2. Density 201 takes several patches.
TEST_F(InterpolationTest, ThesissPatternIsThatOfEveryTriangle) {
    const StrandSettings strands{
        .randomness = Randomness::thesis, .density = 201, .tessellation = 1};
    const StrandPoints points = evaluate(unitTriangles(3), strands);
    for (std::uint32_t strand = 0; strand < 201; ++strand) {
        const auto w = reference::thesisWeights(201, strand);
        const glm::dvec3 root(points.at(0, strand, 0, 0).position);
        // Pairs are cut to 2^-24; numbers of up to 3 are rounded ten times in each coordinate.
        ASSERT_LT(glm::distance(root, glm::dvec3(w[0], w[1], w[2])), 60 * 0x1p-24);
        ASSERT_EQ(points.at(2, strand, 0, 0).position, points.at(0, strand, 0, 0).position);
    }
}

}  // namespace
}  // namespace hair::rendering
