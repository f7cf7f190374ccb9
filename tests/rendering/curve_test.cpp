#include <algorithm>

#include <gtest/gtest.h>

#include "hair/rendering/renderer.h"
#include "tests/gpu_fixture.h"
#include "tests/rendering/device_hair.h"

// The curve of a strand: thesis equation (4), as the shaders evaluate it.
namespace hair::rendering {
namespace {

class CurveTest : public GpuTest {
protected:
    static StrandPoints evaluate(const groom::Groom& groom, const StrandSettings& strands) {
        const DeviceHair hair(device(), groom);
        return evaluateStrandPoints(device(), {.strands = strands}, hair.view());
    }

    static void expectNear(const glm::vec3& actual, const glm::vec3& expected, float tolerance) {
        EXPECT_NEAR(actual.x, expected.x, tolerance);
        EXPECT_NEAR(actual.y, expected.y, tolerance);
        EXPECT_NEAR(actual.z, expected.z, tolerance);
    }
};

// A guide that shows the weights of the control points of its segment 2, vertices 1 to 4: one is
// 48 in x, the next in y, the next in z. Then the position is 48 times the weights at t, and the
// tangent 48 times the slopes. With three equal guides the barycentric weights do not matter.
std::vector<glm::vec3> unitPulses(std::size_t first) {
    std::vector<glm::vec3> guide(6, glm::vec3(0.0f));
    for (std::size_t axis = 0; axis < 3; ++axis)
        guide[first + axis][static_cast<int>(axis)] = 48.0f;
    return guide;
}

// About ten roundings of numbers of up to 48.
constexpr float kPulseTolerance = 10 * 48 * kUlp;

TEST_F(CurveTest, WeighsFourControlPoints) {
    // 48 / 6 * (s^3, 3 t^3 - 6 t^2 + 4, 3 s^3 - 6 s^2 + 4, t^3), s = 1 - t
    const float expected[3][4] = {
        {8.0f, 32.0f, 8.0f, 0.0f},  // t = 0
        {3.375f, 29.375f, 15.125f, 0.125f},  // t = 1/4
        {1.0f, 23.0f, 23.0f, 1.0f}};  // t = 1/2
    const StrandSettings strands{.density = 3, .tessellation = 4};
    const StrandPoints low = evaluate(oneTriangle(unitPulses(1)), strands);
    const StrandPoints high = evaluate(oneTriangle(unitPulses(2)), strands);
    for (std::uint32_t strand = 0; strand < 3; ++strand) {
        for (std::uint32_t point = 0; point < 3; ++point) {
            const float* weights = expected[point];
            expectNear(
                low.at(0, strand, 2, point).position, {weights[0], weights[1], weights[2]},
                kPulseTolerance);
            expectNear(
                high.at(0, strand, 2, point).position, {weights[1], weights[2], weights[3]},
                kPulseTolerance);
        }
    }
}

TEST_F(CurveTest, TangentIsTheDerivative) {
    // 48 / 2 * (-s^2, 3 t^2 - 4 t, -3 s^2 + 4 s, t^2)
    const float expected[3][4] = {
        {-24.0f, 0.0f, 24.0f, 0.0f},  // t = 0
        {-13.5f, -19.5f, 31.5f, 1.5f},  // t = 1/4
        {-6.0f, -30.0f, 30.0f, 6.0f}};  // t = 1/2
    const StrandSettings strands{.density = 1, .tessellation = 4};
    const StrandPoints low = evaluate(oneTriangle(unitPulses(1)), strands);
    const StrandPoints high = evaluate(oneTriangle(unitPulses(2)), strands);
    for (std::uint32_t point = 0; point < 3; ++point) {
        const float* slopes = expected[point];
        expectNear(
            low.at(0, 0, 2, point).tangent, {slopes[0], slopes[1], slopes[2]}, kPulseTolerance);
        expectNear(
            high.at(0, 0, 2, point).tangent, {slopes[1], slopes[2], slopes[3]}, kPulseTolerance);
    }
}

// Seven segments along (3, -2, 1) from (1, 2, 4). A B-spline of evenly spaced points on a line is
// the line itself, and the reflected points at its ends continue it.
TEST_F(CurveTest, StraightGuideIsReproduced) {
    std::vector<glm::vec3> guide;
    const glm::vec3 root(1.0f, 2.0f, 4.0f);
    const glm::vec3 step(3.0f, -2.0f, 1.0f);
    for (int v = 0; v < 8; ++v) guide.push_back(root + static_cast<float>(v) * step);
    const StrandPoints points = evaluate(oneTriangle(guide), {.density = 2, .tessellation = 5});
    // The largest coordinate is the reflected one, 1 + 8 * 3. There are about ten roundings.
    constexpr float kTolerance = 10 * 25 * kUlp;
    for (std::uint32_t segment = 0; segment < 7; ++segment) {
        for (std::uint32_t point = 0; point <= 5; ++point) {
            const auto& record = points.at(0, 1, segment, point);
            const float along = static_cast<float>(segment) + static_cast<float>(point) / 5.0f;
            expectNear(record.position, root + along * step, kTolerance);
            expectNear(record.tangent, step, kTolerance);
            EXPECT_NEAR(record.along, along / 7.0f, 4 * kUlp);
        }
    }
}

const std::vector<glm::vec3> kBent{
    {0.1f, 0.2f, 0.3f}, {0.4f, 0.1f, 0.3f}, {0.3f, 0.5f, 0.2f}, {0.5f, 0.6f, 0.7f}};
constexpr float kBentTolerance = 20 * kUlp;  // twenty roundings of numbers of up to 1

TEST_F(CurveTest, StartsAtTheRootAndEndsAtTheTip) {
    const StrandPoints points = evaluate(oneTriangle(kBent), {.density = 2, .tessellation = 3});
    expectNear(points.at(0, 0, 0, 0).position, kBent.front(), kBentTolerance);
    expectNear(points.at(0, 1, 2, 3).position, kBent.back(), kBentTolerance);
    // (r1 - r(-1)) / 2 with r(-1) = 2 r0 - r1
    expectNear(points.at(0, 0, 0, 0).tangent, kBent[1] - kBent[0], kBentTolerance);
    expectNear(points.at(0, 0, 2, 3).tangent, kBent[3] - kBent[2], kBentTolerance);
}

TEST_F(CurveTest, ShortestGuidesAreLines) {
    const std::vector<glm::vec3> guide{{0.0f, 0.0f, 0.0f}, {0.5f, 1.0f, -0.25f}};
    const StrandPoints points = evaluate(oneTriangle(guide), {.density = 1, .tessellation = 2});
    ASSERT_EQ(points.records.size(), 3u);
    expectNear(points.at(0, 0, 0, 1).position, 0.5f * guide[1], kBentTolerance);
}

// The published program repeats the end points: (r0 + 4 r0 + r1) / 6.
TEST_F(CurveTest, UnpinnedFloatsOffTheScalp) {
    const StrandPoints points = evaluate(
        oneTriangle(kBent), {.density = 1, .tessellation = 3, .curve = Curve::bspline_unpinned});
    expectNear(points.at(0, 0, 0, 0).position, (5.0f * kBent[0] + kBent[1]) / 6.0f, kBentTolerance);
    expectNear(points.at(0, 0, 2, 3).position, (5.0f * kBent[3] + kBent[2]) / 6.0f, kBentTolerance);
}

TEST_F(CurveTest, CatmullRomGoesThroughEveryVertex) {
    const StrandPoints points = evaluate(
        oneTriangle(kBent), {.density = 2, .tessellation = 3, .curve = Curve::catmull_rom});
    for (std::uint32_t vertex = 0; vertex < 3; ++vertex) {
        expectNear(points.at(0, 1, vertex, 0).position, kBent[vertex], kBentTolerance);
        expectNear(points.at(0, 1, vertex, 3).position, kBent[vertex + 1], kBentTolerance);
    }
    // Half of the difference between the neighbours. Beyond an end, the neighbour is the end's
    // reflection.
    expectNear(points.at(0, 1, 1, 0).tangent, 0.5f * (kBent[2] - kBent[0]), kBentTolerance);
    expectNear(points.at(0, 1, 0, 0).tangent, kBent[1] - kBent[0], kBentTolerance);
    expectNear(points.at(0, 1, 2, 3).tangent, kBent[3] - kBent[2], kBentTolerance);
}

// Two patches meet in the same point, with the same tangent and width, so there is no visible
// seam.
TEST_F(CurveTest, JointsAreEqualToTheLastBit) {
    const groom::Groom groom = tangledGroom(8);
    for (const Curve curve : {Curve::bspline, Curve::bspline_unpinned, Curve::catmull_rom}) {
        for (const std::uint32_t tessellation : {1u, 3u, 4u, 7u, 8u}) {
            const StrandPoints points =
                evaluate(groom, {.density = 20, .tessellation = tessellation, .curve = curve});
            for (std::uint32_t i = 0; i < 4 * 20 * 6; ++i) {
                const std::uint32_t segment = i % 6;
                const auto& end = points.at(i / 120, i / 6 % 20, segment, tessellation);
                const auto& start = points.at(i / 120, i / 6 % 20, segment + 1, 0);
                ASSERT_EQ(end.position, start.position) << tessellation << " " << segment;
                ASSERT_EQ(end.tangent, start.tangent) << tessellation << " " << segment;
                ASSERT_EQ(end.width, start.width) << tessellation << " " << segment;
                ASSERT_EQ(end.along, start.along) << tessellation << " " << segment;
            }
        }
    }
}

// 7 segments of 4 pieces: width falls by the same amount in each of the 28.
TEST_F(CurveTest, WidthFallsAlongTheWholeStrand) {
    const StrandPoints points = evaluate(
        tangledGroom(8), {.density = 1, .tessellation = 4, .root_width = 2.0f, .tip_width = 0.5f});
    for (std::uint32_t segment = 0; segment < 7; ++segment) {
        for (std::uint32_t point = 0; point <= 4; ++point) {
            const auto pieces = static_cast<float>(4 * segment + point);
            EXPECT_NEAR(
                points.at(3, 0, segment, point).width, 2.0f - 1.5f * pieces / 28.0f, 4 * 2 * kUlp);
        }
    }
}

// The first 7 of 28 pieces have the root's width; then it falls over 21.
TEST_F(CurveTest, WidthFallsFromWhereTheTaperStarts) {
    const StrandPoints points = evaluate(
        tangledGroom(8), {.density = 1,
                          .tessellation = 4,
                          .root_width = 2.0f,
                          .tip_width = 0.5f,
                          .taper_start = 0.25f});
    for (std::uint32_t piece = 0; piece < 28; ++piece) {
        const float fallen = std::max(0.0f, static_cast<float>(piece) - 7.0f) / 21.0f;
        EXPECT_NEAR(
            points.at(3, 0, piece / 4, piece % 4).width, 2.0f - 1.5f * fallen, 8 * 2 * kUlp);
    }
    EXPECT_EQ(points.at(3, 0, 6, 4).width, 0.5f);
}

TEST_F(CurveTest, TaperThatStartsAtTheTipIsNone) {
    const StrandPoints points = evaluate(
        tangledGroom(3),
        {.density = 1, .tessellation = 4, .root_width = 2.0f, .tip_width = 0.5f, .taper_start = 1});
    for (const auto& record : points.records) EXPECT_EQ(record.width, 2.0f);
}

TEST_F(CurveTest, SegmentTaperRestarts) {
    const StrandPoints points = evaluate(
        tangledGroom(8), {.density = 1,
                          .tessellation = 4,
                          .root_width = 2.0f,
                          .tip_width = 0.5f,
                          .taper = Taper::segment});
    for (std::uint32_t segment = 0; segment < 7; ++segment) {
        EXPECT_EQ(points.at(0, 0, segment, 0).width, 2.0f);
        EXPECT_EQ(points.at(0, 0, segment, 2).width, 1.25f);
        EXPECT_EQ(points.at(0, 0, segment, 4).width, 0.5f);
    }
}

}  // namespace
}  // namespace hair::rendering
