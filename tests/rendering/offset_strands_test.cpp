#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "hair/rendering/renderer.h"
#include "tests/gpu_fixture.h"
#include "tests/largest_difference.h"
#include "tests/rendering/device_hair.h"
#include "tests/rendering/offset_reference.h"

// Strands off their smooth shape, as the shaders draw them: thesis 2.3.8.2 and 2.3.8.3.
namespace hair::rendering {
namespace {

class OffsetStrandsTest : public GpuTest {
protected:
    static StrandPoints evaluate(const groom::Groom& groom, const Settings& settings) {
        const DeviceHair hair(device(), groom, settings);
        return evaluateStrandPoints(device(), settings, hair.view());
    }

    // The same strands without the offsets from their smooth shape.
    static StrandPoints evaluateSmooth(const groom::Groom& groom, Settings settings) {
        settings.strands.curl.radius = 0.0f;
        settings.strands.variation.amplitude = 0.0f;
        return evaluate(groom, settings);
    }
};

// The upright guides' strands have 12 turns.
constexpr StrandCurlSettings kCurl{
    .radius = 0.004f, .frequency = 40.0f, .frequency_variation = 0.0f, .start = 0.2f};

// Includes the tangled guides and every part of an offset. Points are within 0.5 m as in
// strand_points_test.cpp. The frame of a guide is good to 1e-4 rad (frames_pass_test.cpp) for an
// offset of 0.01 m, and the place in the table to 2^-24 of a slope of 2 pi 5 turns 0.01 m.
TEST_F(OffsetStrandsTest, AgreeWithTheReference) {
    constexpr double kTolerance = 20 * 0x1p-24 * 1.5 * 2.0 + 1e-6;
    const groom::Groom groom = tangledGroom(8);
    const Settings settings{
        .seed = 5,
        .strands = {
            .density = 40,
            .tessellation = 3,
            .curl = {.radius = 0.006f, .frequency = 30.0f},
            .variation = {.amplitude = 0.004f}}};
    const StrandOffsets offsets = makeStrandOffsets(settings.strands, groom, nullptr, 5);
    const StrandPoints points = evaluate(groom, settings);
    for (std::uint32_t triangle = 0; triangle < 4; ++triangle) {
        for (std::uint32_t i = 0; i < 40 * 7 * 4; ++i) {
            const std::uint32_t strand = i / 28;
            const std::uint32_t segment = i / 4 % 7;
            const auto& record = points.at(triangle, strand, segment, i % 4);
            const reference::Point expected = reference::offsetPoint(
                groom, settings, offsets, triangle, strand, segment, (i % 4) / 3.0);
            ASSERT_LT(glm::distance(glm::dvec3(record.position), expected.position), kTolerance);
            // Slopes are about 10 times the offsets: 6 turns over 7 segments.
            ASSERT_LT(glm::distance(glm::dvec3(record.tangent), expected.tangent), 10 * kTolerance);
        }
    }
}

// With 16 samples a turn, Catmull and Rom's curve is within 1 - (9 cos d - cos 3d) / 8 = 0.06 % of
// the circle, d = 2 pi / 32. Floats round coordinates of 0.3 m by 2e-8, twice, which is also 1e-5
// rad.
TEST_F(OffsetStrandsTest, CurlsHaveTheirRadiusAndTurns) {
    const Settings settings{.strands = {.density = 8, .tessellation = 16, .curl = kCurl}};
    const StrandPoints curled = evaluate(uprightGroom(), settings);
    const StrandPoints smooth = evaluateSmooth(uprightGroom(), settings);
    for (std::uint32_t strand = 0; strand < 8; ++strand) {
        double angle = 0.0;
        glm::dvec3 last(0.0);
        constexpr std::uint32_t kFirst = 4 * 16;  // well past the start, which is at 3 / 15
        for (std::uint32_t i = kFirst; i <= 15 * 16; ++i) {
            const std::uint32_t segment = std::min(i / 16, 14u);
            const std::uint32_t point = i - 16 * segment;
            const glm::dvec3 from_axis = glm::dvec3(curled.at(0, strand, segment, point).position) -
                                         glm::dvec3(smooth.at(0, strand, segment, point).position);
            ASSERT_NEAR(glm::length(from_axis), 0.004, 0.0006 * 0.004 + 4e-8);
            ASSERT_NEAR(from_axis.y, 0.0, 4e-8);
            if (i > kFirst)
                angle += std::atan2(glm::cross(last, from_axis).y, glm::dot(last, from_axis));
            last = from_axis;
        }
        EXPECT_NEAR(std::abs(angle) / kTurn, 11.0 / 15.0 * 12.0, 1e-3);
    }
}

// Tangents are those of the drawn curve. The helix is as steep as 2 pi 0.004 * 40 = 1: 45 degrees.
// Catmull and Rom's curvature jumps at the samples. The curve's speed jumps, too, by 0.76 a radian
// at 16 samples a turn. So a chord over two steps of 2 pi 12 / 960 rad differs by 1.5 % of the
// slope from the tangent in its middle, 0.75 % in length and direction at 45 degrees.
TEST_F(OffsetStrandsTest, TangentsAreThoseOfTheCurls) {
    const StrandPoints points =
        evaluate(uprightGroom(), {.strands = {.density = 8, .tessellation = 64, .curl = kCurl}});
    Extremes slopes;
    for (std::uint32_t i = 0; i < 8 * 15 * 63; ++i) {
        const std::uint32_t strand = i / 945;
        const std::uint32_t segment = i / 63 % 15;
        const std::uint32_t point = i % 63 + 1;
        const glm::dvec3 chord(
            points.at(0, strand, segment, point + 1).position -
            points.at(0, strand, segment, point - 1).position);
        const glm::dvec3 tangent(points.at(0, strand, segment, point).tangent);
        const glm::dvec3 direction = glm::normalize(tangent);
        ASSERT_LT(glm::length(glm::cross(glm::normalize(chord), direction)), 0.01);
        ASSERT_NEAR(32.0 * glm::length(chord) / glm::length(tangent), 1.0, 0.01);
        slopes.add(std::abs(direction.x));
    }
    EXPECT_GT(slopes.greatest(), 0.65);
}

Settings everything(std::uint32_t tessellation, Curve curve) {
    return {
        .strands = {
            .density = 20,
            .tessellation = tessellation,
            .width = WidthSource::groom,
            .curl = {.radius = 0.004f, .frequency = 50.0f, .start = 0.0f},
            .variation = {.amplitude = 0.003f, .start = 0.0f},
            .curve = curve}};
}

groom::Groom tangledWithWidths() {
    groom::Groom groom = tangledGroom(8);
    for (std::size_t i = 0; i < groom.points.size(); ++i)
        groom.widths.push_back(1e-4f * static_cast<float>(1 + i * 7 % 11));
    return groom;
}

TEST_F(OffsetStrandsTest, JointsAreEqualToTheLastBit) {
    for (const Curve curve : {Curve::bspline, Curve::bspline_unpinned}) {
        for (const std::uint32_t tessellation : {1u, 3u, 4u, 7u}) {
            const StrandPoints points =
                evaluate(tangledWithWidths(), everything(tessellation, curve));
            for (std::uint32_t i = 0; i < 4 * 20 * 6; ++i) {
                const std::uint32_t segment = i % 6;
                const auto& end = points.at(i / 120, i / 6 % 20, segment, tessellation);
                const auto& start = points.at(i / 120, i / 6 % 20, segment + 1, 0);
                ASSERT_EQ(end.position, start.position) << tessellation << " " << segment;
                ASSERT_EQ(end.tangent, start.tangent) << tessellation << " " << segment;
                ASSERT_EQ(end.width, start.width) << tessellation << " " << segment;
            }
        }
    }
}

TEST_F(OffsetStrandsTest, RootsStayWhereTheyAre) {
    const Settings settings = everything(2, Curve::bspline);
    const StrandPoints moved = evaluate(tangledWithWidths(), settings);
    const StrandPoints smooth = evaluateSmooth(tangledWithWidths(), settings);
    for (std::uint32_t i = 0; i < 80; ++i) {
        ASSERT_EQ(
            moved.at(i / 20, i % 20, 0, 0).position, smooth.at(i / 20, i % 20, 0, 0).position);
        ASSERT_NE(
            moved.at(i / 20, i % 20, 3, 0).position, smooth.at(i / 20, i % 20, 3, 0).position);
    }
}

TEST_F(OffsetStrandsTest, LowerLevelsKeepTheirOffsets) {
    Settings settings = everything(4, Curve::bspline);
    const StrandPoints fine = evaluate(tangledWithWidths(), settings);
    settings.lod.level = 1.0f;
    const StrandPoints coarse = evaluate(tangledWithWidths(), settings);
    ASSERT_EQ(coarse.plan.forced_density, 10u);
    for (std::uint32_t i = 0; i < 10 * 7 * 3; ++i) {
        const std::uint32_t segment = i / 3 % 7;
        const auto& kept = coarse.at(2, i / 21, segment, i % 3);
        const auto& same = fine.at(2, i / 21, segment, 2 * (i % 3));
        ASSERT_EQ(kept.position, same.position);
        ASSERT_EQ(kept.tangent, same.tangent);
        ASSERT_EQ(kept.width, 2.0f * same.width);
    }
}

// A quarter of 2,000 strands, within four deviations of sqrt(2000 * 3 / 16) = 19.
TEST_F(OffsetStrandsTest, VariationMovesItsShareOfTheStrands) {
    const Settings settings{
        .strands = {
            .density = 500, .tessellation = 1, .variation = {.amplitude = 0.01f, .share = 0.25f}}};
    const StrandPoints varied = evaluate(tangledGroom(4), settings);
    const StrandPoints smooth = evaluateSmooth(tangledGroom(4), settings);
    int moved = 0;
    for (std::uint32_t i = 0; i < 2000; ++i) {
        const auto& a = varied.at(i / 500, i % 500, 1, 1);
        moved += a.position != smooth.at(i / 500, i % 500, 1, 1).position;
    }
    EXPECT_NEAR(moved, 500, 4 * 19);
}

}  // namespace
}  // namespace hair::rendering
