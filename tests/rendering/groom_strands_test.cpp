#include <algorithm>
#include <cmath>
#include <numeric>

#include <glm/ext/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "hair/rendering/renderer.h"
#include "tests/error_text.h"
#include "tests/gpu_fixture.h"
#include "tests/rendering/device_hair.h"
#include "tests/rendering/strand_reference.h"

// The groom's own strands and widths.
namespace hair::rendering {
namespace {

constexpr double kStrandTolerance = 20 * 0x1p-24 * 1.5 * 2.0;  // as in strand_points_test.cpp

// Every third strand is a guide bound to itself.
groom::Groom boundGroom(std::uint32_t vertices, std::uint32_t strands) {
    groom::Groom groom = tangledGroom(vertices);
    groom.root_triangles.clear();
    std::mt19937 random(3);
    const auto number = [&] { return static_cast<float>(random() >> 8u) * 0x1p-24f; };
    for (std::uint32_t i = 0; i < strands; ++i) {
        const std::uint32_t guide = i % groom.strand_count;
        if (i % 3 == 0) {
            groom.bindings.push_back({.guides = {guide, guide, guide}});
            continue;
        }
        const float a = number();
        const float b = number() * (1.0f - a);
        groom.bindings.push_back(
            {.guides = {guide, (guide + 1) % 6, (guide + 3) % 6},
             .weights = {a, b, 1.0f - a - b},
             .offset = {0.05f * number(), 0.05f * number(), -0.05f * number()}});
    }
    for (std::size_t i = 0; i < groom.points.size(); ++i) groom.widths.push_back(1e-3f * number());
    return groom;
}

// The bindings in the drawn order.
std::vector<groom::StrandBinding> inOrder(const groom::Groom& groom, std::uint32_t seed) {
    std::vector<std::pair<std::uint32_t, std::size_t>> order;
    for (std::size_t i = 0; i < groom.bindings.size(); ++i)
        order.emplace_back(hash(seed, static_cast<std::uint32_t>(i), gpu::kOrderPurpose), i);
    std::ranges::sort(order);
    std::vector<groom::StrandBinding> bindings;
    for (const auto& [key, i] : order) bindings.push_back(groom.bindings[i]);
    return bindings;
}

// A groom of this strand alone, as its guides give it.
groom::Groom
alone(const groom::Groom& groom, const groom::StrandBinding& binding, const glm::dmat3& head) {
    std::vector<glm::vec3> strand;
    for (std::uint32_t v = 0; v < groom.vertices_per_strand; ++v) {
        glm::dvec3 point = head * glm::dvec3(binding.offset);
        for (int i = 0; i < 3; ++i)
            point += double{binding.weights[i]} *
                     glm::dvec3(groom.strand(binding.guides[static_cast<std::size_t>(i)])[v]);
        strand.emplace_back(point);
    }
    return oneTriangle(strand);
}

double widthAt(
    const groom::Groom& groom, const groom::StrandBinding& binding, std::uint32_t segment,
    double t) {
    double width = 0.0;
    for (std::uint32_t i = 0; i < 3; ++i) {
        const std::size_t at = std::size_t{binding.guides[i]} * groom.vertices_per_strand + segment;
        width += double{binding.weights[static_cast<int>(i)]} *
                 ((1.0 - t) * groom.widths[at] + t * groom.widths[at + 1]);
    }
    return width;
}

class GroomStrandsTest : public GpuTest {
protected:
    static StrandPoints evaluate(
        const groom::Groom& groom, const Settings& settings,
        const glm::mat4& head = glm::mat4(1.0f)) {
        const DeviceHair hair(device(), groom, settings);
        StrandView view = hair.view();
        view.head = head;
        return evaluateStrandPoints(device(), settings, view);
    }
};

const StrandSettings kGroomStrands{
    .source = StrandSource::groom, .tessellation = 4, .width = WidthSource::groom};

TEST_F(GroomStrandsTest, AreTheSumsOfTheirGuides) {
    const groom::Groom groom = boundGroom(8, 100);
    const glm::mat4 head =
        glm::rotate(glm::mat4(1.0f), 2.0f, glm::normalize(glm::vec3(1.0f, -2.0f, 3.0f)));
    const Settings settings{.seed = 9, .strands = kGroomStrands};
    const StrandPoints points = evaluate(groom, settings, head);
    ASSERT_EQ(points.plan.strands(), 100u);
    const std::vector<groom::StrandBinding> bindings = inOrder(groom, 9);
    for (std::uint32_t strand = 0; strand < 100; ++strand) {
        const groom::Groom expected = alone(groom, bindings[strand], glm::dmat3(glm::mat3(head)));
        for (std::uint32_t i = 0; i < 7 * 5; ++i) {
            const double t = (i % 5) / 4.0;
            const auto& record = points.at(0, strand, i / 5, i % 5);
            const reference::Point point =
                reference::pointOnStrand(expected, settings, 0, 0, i / 5, t);
            ASSERT_LT(glm::distance(glm::dvec3(record.position), point.position), kStrandTolerance);
            ASSERT_LT(glm::distance(glm::dvec3(record.tangent), point.tangent), kStrandTolerance);
            const double width = widthAt(groom, bindings[strand], i / 5, t);
            ASSERT_NEAR(record.width, width, 10 * 0x1p-24 * 1e-3);  // rounding of a sum of six
                                                                    // terms below 1 mm
        }
    }
}

// Weights and widths of strands between root triangles.
TEST_F(GroomStrandsTest, WidthsOfTheGroomAreMixedBetweenRootTriangles) {
    groom::Groom groom = boundGroom(5, 0);
    groom.root_triangles = {{0, 1, 2}, {3, 5, 4}};
    const Settings settings{
        .strands = {.density = 20, .tessellation = 4, .width = WidthSource::groom},
        .lod = {.level = 1.0f}};
    const StrandPoints points = evaluate(groom, settings);
    ASSERT_EQ(points.plan.forced_density, 10u);
    for (std::uint32_t i = 0; i < 2 * 10 * 4 * 3; ++i) {
        const std::uint32_t triangle = i / 120;
        const std::uint32_t strand = i / 12 % 10;
        const auto weights = reference::weights(settings.seed, triangle, strand);
        const groom::StrandBinding binding{
            .guides = groom.root_triangles[triangle],
            .weights = {weights[0], weights[1], weights[2]}};
        const std::uint32_t segment = i / 3 % 4;
        // Two of four pieces at level 1; strands are twice as wide.
        const double expected = 2.0 * widthAt(groom, binding, segment, i % 3 / 2.0);
        ASSERT_NEAR(
            points.at(triangle, strand, segment, i % 3).width, expected, 20 * 0x1p-24 * 1e-3);
    }
}

TEST_F(GroomStrandsTest, LowerLevelsKeepTheFirstStrandsAndWidenThem) {
    const groom::Groom groom = boundGroom(4, 301);
    Settings settings{.strands = kGroomStrands};
    const StrandPoints fine = evaluate(groom, settings);
    for (const auto& [level, kept, tessellation] :
         {std::tuple{1.0f, 150.5f, 2u}, {2.0f, 75.25f, 1u}}) {
        settings.lod.level = level;
        const StrandPoints coarse = evaluate(groom, settings);
        const auto whole = static_cast<std::uint32_t>(kept);
        ASSERT_EQ(coarse.plan.strands(), whole + 1);
        ASSERT_EQ(coarse.plan.forced_tessellation, tessellation);
        for (std::uint32_t i = 0; i < (whole + 1) * 3; ++i) {
            const auto& a = coarse.at(0, i / 3, i % 3, tessellation);
            const auto& b = fine.at(0, i / 3, i % 3, 4);
            ASSERT_EQ(a.position, b.position);
            const float share = i / 3 < whole ? 1.0f : kept - static_cast<float>(whole);
            ASSERT_FLOAT_EQ(a.width * kept, share * b.width * 301.0f);
        }
    }
}

// near is 1 m and far 4 m, with level 2 there. Guides are at the origin, half of the strands 4 m
// away.
TEST_F(GroomStrandsTest, EveryStrandHasTheLevelOfItsOwnRoot) {
    groom::Groom groom = boundGroom(3, 400);
    for (std::size_t i = 0; i < 200; ++i) groom.bindings[2 * i].offset.z = -10.0f;
    const Settings settings{
        .strands = kGroomStrands,
        .lod =
            {.mode = LodMode::distance,
             .near_distance = 1.0f,
             .far_distance = 4.0f,
             .maximum_level = 2.0f},
        .camera = {.position = {0.0f, 0.0f, 0.5f}}};
    const StrandPoints points = evaluate(groom, settings);
    const std::vector<groom::StrandBinding> bindings = inOrder(groom, settings.seed);
    for (std::uint32_t strand = 0; strand < 400; ++strand) {
        const bool far = bindings[strand].offset.z < -5.0f;
        const auto& record = points.at(0, strand, 1, 0);
        if (far && strand >= 100) {
            ASSERT_EQ(record.width, -1.0f) << strand;
        } else {
            const double width = widthAt(groom, bindings[strand], 1, 0.0);
            ASSERT_NEAR(record.width, (far ? 4.0 : 1.0) * width, 40 * 0x1p-24 * 1e-3) << strand;
        }
    }
}

// In the order of the file, the first half would be one side of the head.
TEST_F(GroomStrandsTest, StrandsAreDroppedAllOverTheGroom) {
    groom::Groom groom = boundGroom(2, 2000);
    for (std::size_t i = 0; i < 2000; ++i)
        groom.bindings[i] = {.offset = {0.0f, static_cast<float>(i), 0.0f}};
    const StrandPoints points =
        evaluate(groom, {.strands = {.source = StrandSource::groom}, .lod = {.level = 3.0f}});
    ASSERT_EQ(points.plan.strands(), 250u);
    double mean = 0.0;
    for (std::uint32_t i = 0; i < 250; ++i) mean += points.at(0, i, 0, 0).position.y / 250.0;
    EXPECT_NEAR(mean, 1000.0, 4.0 * 2000.0 / std::sqrt(12.0 * 250.0));  // 4 deviations of a mean
}

TEST(CheckStrands, NamesWhatTheGroomLacks) {
    groom::Groom groom = boundGroom(3, 5);
    EXPECT_EQ(errorText([&] { checkStrands(kGroomStrands, groom); }), "no error");
    groom.widths.clear();
    EXPECT_EQ(
        errorText([&] { checkStrands(kGroomStrands, groom); }),
        "/strands/width: is groom, but the groom has no widths");
    groom = boundGroom(3, 0);
    EXPECT_EQ(
        errorText([&] { checkStrands(kGroomStrands, groom); }),
        "/strands/source: is groom, but the groom has no bindings");
    EXPECT_EQ(errorText([&] { checkStrands({}, groom); }), "no error");
}

}  // namespace
}  // namespace hair::rendering
