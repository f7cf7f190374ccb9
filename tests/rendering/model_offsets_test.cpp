#include <cmath>
#include <numbers>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <gtest/gtest.h>

#include "hair/rendering/strand_offsets.h"
#include "tests/error_text.h"
#include "tests/largest_difference.h"
#include "tests/rendering/device_hair.h"

// Tests offsets that are taken from the strands of a model.
namespace hair::rendering {
namespace {

constexpr double kTurns = 32.0;
constexpr double kRadius = 0.004;
constexpr double kAxis = 0.2;  // m

// A helix round the y axis, which starts at the axis's end.
std::vector<glm::vec3> helix(std::size_t points) {
    std::vector<glm::vec3> strand;
    for (std::size_t i = 0; i < points; ++i) {
        const double along = static_cast<double>(i) / static_cast<double>(points - 1);
        const double angle = kTurn * kTurns * along;
        strand.emplace_back(kRadius * std::sin(angle), kAxis * along, kRadius * std::cos(angle));
    }
    return strand;
}

groom::StrandSet strandSet(const std::vector<std::vector<glm::vec3>>& strands) {
    groom::StrandSet set;
    for (const std::vector<glm::vec3>& strand : strands) {
        set.points.insert(set.points.end(), strand.begin(), strand.end());
        set.ends.push_back(static_cast<std::uint32_t>(set.points.size()));
    }
    return set;
}

groom::Groom straight(double length) {
    return oneTriangle({{0.0f, 0.0f, 0.0f}, {0.0f, static_cast<float>(length), 0.0f}});
}

StrandOffsets make(const groom::StrandSet& model, double length) {
    return makeStrandOffsets({.offsets = "model"}, straight(length), &model, 1);
}

// On hair half as long, a curl is half as wide and has as many turns. A cubic through the root
// is off the axis in the middle half for two reasons:
//  - it takes up a part of a wave of 32 periods: at most sum (2n + 1) |P_n| 2 / (2 pi 32), n = 0
//    to 3, with Legendre's polynomials P_n: 8 % of the amplitude;
//  - the root is off the axis: sum (2n + 1) P_n(-1) P_n / 16, 12 % of its distance.
TEST(ModelOffsets, AreAModelsCurlsInProportion) {
    const StrandOffsets offsets = make(strandSet({helix(2000)}), 0.5 * kAxis);
    EXPECT_EQ(offsets.profiles, 64u);  // all the same
    EXPECT_EQ(offsets.samples, 2000u);
    const auto samples = offsets.profile(5);
    EXPECT_EQ(samples[0], glm::vec3(0.0f));
    double angle = 0.0;
    for (std::size_t i = 500; i < 1500; ++i) {
        ASSERT_NEAR(std::hypot(samples[i].x, samples[i].y), 0.5 * kRadius, 0.2 * 0.5 * kRadius);
        ASSERT_LT(std::abs(samples[i].z), 0.2 * 0.5 * kRadius);
        angle += std::atan2(
            samples[i].x * samples[i + 1].y - samples[i].y * samples[i + 1].x,
            samples[i].x * samples[i + 1].x + samples[i].y * samples[i + 1].y);
    }
    // From x to z is clockwise about y: right-handed. Off by 20 % at both ends, 2 asin(0.2) / 2 pi.
    EXPECT_NEAR(angle / kTurn, 0.5 * kTurns, 0.064);
}

// The file's unit and place don't matter.
TEST(ModelOffsets, AreTheSameOfAModelThatIsMovedAndEnlarged) {
    glm::dmat4 motion = glm::translate(glm::dmat4(1.0), {3.0, -40.0, 7.0});
    motion = glm::rotate(motion, 1.0, glm::normalize(glm::dvec3(1.0, 2.0, -1.0)));
    motion = glm::scale(motion, glm::dvec3(100.0));
    std::vector<glm::vec3> moved = helix(500);
    for (glm::vec3& point : moved) point = glm::vec3(motion * glm::dvec4(point, 1.0));
    const StrandOffsets a = make(strandSet({helix(500)}), kAxis);
    const StrandOffsets b = make(strandSet({moved}), kAxis);
    ASSERT_EQ(a.samples, b.samples);
    for (std::size_t i = 0; i < a.samples; ++i) {
        // Rounding may choose where the frames start, so the test compares radius and tangent.
        // Floats round 40 by 2e-6, which is a 20th of that after scaling to 0.2 m, for each of
        // three coordinates.
        const glm::vec3& p = a.profile(0)[i];
        const glm::vec3& q = b.profile(0)[i];
        ASSERT_NEAR(std::hypot(p.x, p.y), std::hypot(q.x, q.y), 1e-6) << i;
        ASSERT_NEAR(p.z, q.z, 1e-6) << i;
    }
}

TEST(ModelOffsets, OfStraightStrandsAreNothing) {
    const StrandOffsets offsets = make(strandSet({{{0.0f, 0.0f, 0.0f}, {0.0f, 0.3f, 0.4f}}}), 0.5);
    for (const glm::vec3& value : offsets.values)
        ASSERT_LT(glm::length(value), 1e-7f);  // floats round 0.5 by 3e-8
}

TEST(ModelOffsets, TakeStrandsFromAllOverTheFile) {
    // The strands in the first half of the file are straight.
    std::vector<std::vector<glm::vec3>> strands(
        1500, {{0.0f, 0.0f, 0.0f}, {0.0f, 0.5f, 0.0f}, {0.0f, 1.0f, 0.0f}});
    strands.resize(3000, {{0.0f, 0.0f, 0.0f}, {0.3f, 0.5f, 0.0f}, {0.0f, 1.0f, 0.0f}});
    const StrandOffsets offsets = make(strandSet(strands), 1.0);
    ASSERT_EQ(offsets.profiles, 1024u);
    for (std::uint32_t p = 0; p < 1024; ++p) {
        Extremes sizes;
        for (const glm::vec3& sample : offsets.profile(p)) sizes.add(double{glm::length(sample)});
        const double size = sizes.greatest();
        EXPECT_TRUE(p < 512 ? size <= 1e-6 : size > 1e-6) << p << ": " << size;
    }
}

// Without the turns, strands that share a guide's frame would wave in step.
TEST(ModelOffsets, AreTurnedAtRandom) {
    const StrandOffsets offsets = make(strandSet({helix(500)}), kAxis);
    glm::dvec2 mean(0.0);
    for (std::uint32_t p = 0; p < offsets.profiles; ++p) {
        const glm::vec3& a = offsets.profile(p)[250];
        const glm::vec3& b = offsets.profile(0)[250];
        ASSERT_NEAR(std::hypot(a.x, a.y), std::hypot(b.x, b.y), 1e-8);  // roundings of 0.004
        mean += glm::normalize(glm::dvec2(a)) / 64.0;
    }
    EXPECT_LT(glm::length(mean), 4.0 / std::sqrt(64.0));  // 4 deviations of a random walk
}

TEST(ModelOffsets, PassOverStrandsWithoutLength) {
    const std::vector<glm::vec3> point{{1.0f, 2.0f, 3.0f}};
    const std::vector<glm::vec3> still(20, {1.0f, 2.0f, 3.0f});
    const StrandOffsets with = make(strandSet({point, helix(100), still}), kAxis);
    EXPECT_EQ(with.values, make(strandSet({helix(100)}), kAxis).values);
    EXPECT_EQ(errorText([&] { make(strandSet({point, still}), kAxis); }), "no strand has a length");
}

// Through points that coincide, the only possible fit is a line.
TEST(ModelOffsets, AreFiniteForAnyStrand) {
    std::vector<glm::vec3> heap(40, {0.0f, 0.0f, 0.0f});
    heap.back() = {0.0f, 0.1f, 0.0f};
    std::vector<glm::vec3> loop;
    for (int i = 0; i <= 40; ++i)
        loop.emplace_back(std::sin(i * kTurn / 40.0), std::cos(i * kTurn / 40.0), 0.0);
    const std::vector<glm::vec3> back{{0.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 0.0f}};
    for (const std::vector<glm::vec3>& strand : {heap, loop, back}) {
        for (const glm::vec3& value : make(strandSet({strand}), 0.1).values)
            ASSERT_TRUE(std::isfinite(value.x + value.y + value.z));
    }
}

}  // namespace
}  // namespace hair::rendering
