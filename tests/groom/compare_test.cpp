#include "hair/groom/compare.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include <glm/vec3.hpp>
#include <gmock/gmock.h>

#include "engine/error.h"
#include "hair/groom/mesh/body_mesh.h"
#include "tests/error_text.h"
#include "tests/simulation/closed_meshes.h"

namespace hair::groom {
namespace {

using testing::HasSubstr;

// Coordinates are floats of up to 0.2 m: half a unit in their last place is 7.5e-9 m.
constexpr double kDistanceRounding = 2e-8;

StrandSet strandsOf(const std::vector<std::vector<glm::vec3>>& strands) {
    StrandSet set;
    for (const auto& points : strands) {
        set.points.insert(set.points.end(), points.begin(), points.end());
        set.ends.push_back(static_cast<std::uint32_t>(set.points.size()));
    }
    return set;
}

// Upwards from y = `from` to `to` at x, m.
std::vector<glm::vec3> upright(float from, float to, float x = 0.0f) {
    return {{x, from, 0}, {x, to, 0}};
}

StrandComparison
compared(const StrandSet& first, const StrandSet& second, const CompareSettings& settings = {}) {
    return compareStrands(first, second, nullptr, settings);
}

TEST(CompareStrands, MeasuresTheDistanceOfParallelStrands) {
    const auto found =
        compared(strandsOf({upright(0, 0.1f)}), strandsOf({upright(0, 0.1f, 0.0025f)}));
    EXPECT_EQ(found.first.samples, 50u);  // 2 mm apart
    EXPECT_NEAR(found.first.length, 0.1, kDistanceRounding);
    EXPECT_FALSE(found.equal);
    for (const DistanceFindings& each : {found.first_to_second, found.second_to_first}) {
        EXPECT_NEAR(each.mean, 2.5e-3, kDistanceRounding);
        EXPECT_NEAR(each.mean_square, 6.25e-6, 1e-10);
        EXPECT_NEAR(each.median, 2.5e-3, kDistanceRounding);
        EXPECT_NEAR(each.percentile99, 2.5e-3, kDistanceRounding);
        EXPECT_NEAR(each.maximum, 2.5e-3, kDistanceRounding);
    }
    ASSERT_EQ(found.scores.size(), 3u);
    for (const MatchScores& each : found.scores) {
        const double wanted = each.threshold.distance > 2.5e-3 ? 1.0 : 0.0;
        EXPECT_EQ(each.precision, wanted);
        EXPECT_EQ(each.recall, wanted);
        EXPECT_EQ(each.f1, wanted);  // 0, not a quotient of zeros
        EXPECT_EQ(each.strand_consistency, wanted);
    }
}

TEST(CompareStrands, FindsAGroomInItself) {
    const StrandSet strands = strandsOf(
        {upright(0, 0.1f), {{0, 0, 0}, {0.01f, 0, 0}, {0.01f, 0, 0}, {0.01f, 0.03f, 0.02f}}});
    CompareSettings settings;
    settings.thresholds = {{1e-9, 0.0}};
    const auto found = compared(strands, strands, settings);
    EXPECT_TRUE(found.equal);
    EXPECT_EQ(found.scores[0].f1, 1.0);
    EXPECT_EQ(found.scores[0].strand_consistency, 1.0);
    EXPECT_LT(found.first_to_second.maximum, 1e-15);
    EXPECT_EQ(found.lengths.earth_movers_distance, 0.0);
    EXPECT_EQ(found.curvatures.histogram_distance, 0.0);
}

TEST(CompareStrands, TellsRootFromTipUnlessItMayNot) {
    const StrandSet up = strandsOf({upright(0, 0.1f)});
    const StrandSet down = strandsOf({upright(0.1f, 0)});
    EXPECT_EQ(compared(up, down).scores[2].f1, 0.0);
    EXPECT_LT(compared(up, down).first_to_second.maximum, kDistanceRounding);
    CompareSettings settings;
    settings.directions = StrandDirections::either_way;
    EXPECT_EQ(compared(up, down, settings).scores[0].f1, 1.0);
}

// A strand of 2 mm crosses the middle of one of 100 mm at 25 degrees. The long one has samples at
// 1, 3 ... 99 mm; four of them are within 3 and 4 mm: a sample 3 mm from the middle is 2.1 mm
// away, one 5 mm from the middle 4.1 mm.
TEST(CompareStrands, HoldsDirectionsAgainstTheAngle) {
    const double turn = 25.0 * std::numbers::pi / 180.0;
    const glm::vec3 half(0.001 * std::sin(turn), 0.001 * std::cos(turn), 0.0);
    const glm::vec3 middle(0.0f, 0.05f, 0.0f);
    const auto found =
        compared(strandsOf({upright(0, 0.1f)}), strandsOf({{middle - half, middle + half}}));
    EXPECT_EQ(found.scores[0].precision, 0.0);
    EXPECT_EQ(found.scores[0].recall, 0.0);
    for (const std::size_t i : {1, 2}) {
        EXPECT_EQ(found.scores[i].precision, 1.0);
        EXPECT_DOUBLE_EQ(found.scores[i].recall, 0.08);
        EXPECT_DOUBLE_EQ(found.scores[i].f1, 2 * 0.08 / 1.08);
    }
}

// Samples at 1, 3 ... 99 mm; the longer part runs from 60.5 to 62.5, 63.5 and 64.5 mm.
TEST(CompareStrands, CountsHowMuchOfAStrandIsInOne) {
    const StrandSet whole = strandsOf({upright(0, 0.1f)});
    const StrandSet parts = strandsOf({upright(0, 0.0605f), upright(0.0605f, 0.1f)});
    CompareSettings settings;
    settings.consistency_samples = 0;
    const auto found = compared(whole, parts, settings);
    const double wanted[] = {0.62, 0.64, 0.64};
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(found.scores[i].f1, 1.0);
        EXPECT_DOUBLE_EQ(found.scores[i].strand_consistency, wanted[i]);
    }
    for (const MatchScores& each : compared(parts, whole, settings).scores)
        EXPECT_EQ(each.strand_consistency, 1.0);
    // The 6th, 16th, 26th, 36th and 46th of the 50 samples: at 11, 31, 51, 71 and 91 mm.
    settings.consistency_samples = 5;
    EXPECT_DOUBLE_EQ(compared(whole, parts, settings).scores[0].strand_consistency, 0.6);
}

// The mean over strands counts each once, long or short: one is found, one is not.
TEST(CompareStrands, CountsEveryStrandOnceInConsistency) {
    const auto found = compared(
        strandsOf({upright(0, 0.1f), upright(0, 0.01f, 1.0f)}), strandsOf({upright(0, 0.1f)}));
    EXPECT_DOUBLE_EQ(found.scores[0].strand_consistency, 0.5);
    EXPECT_DOUBLE_EQ(found.scores[0].recall, 50.0 / 55.0);
    EXPECT_NEAR(found.first_to_second.maximum, 1.0, 1e-6);  // far beyond all thresholds
}

// The second strand is the first 50.25 of 100 mm: 25 samples are 0.75, 2.75 ... 48.75 mm from its
// end.
TEST(CompareStrands, TellsBothWaysApart) {
    const auto found = compared(strandsOf({upright(0, 0.1f)}), strandsOf({upright(0, 0.05025f)}));
    EXPECT_NEAR(found.first_to_second.mean, 12.375e-3, kDistanceRounding);
    EXPECT_NEAR(found.first_to_second.median, 0.375e-3, kDistanceRounding);
    EXPECT_NEAR(found.first_to_second.maximum, 48.75e-3, kDistanceRounding);
    // Rank 0.9 * 49 = 44.1: a tenth of the way from the 20th of those distances to the next.
    EXPECT_NEAR(found.first_to_second.percentile90, 38.95e-3, kDistanceRounding);
    EXPECT_LT(found.second_to_first.maximum, kDistanceRounding);
    const double recalls[] = {26.0 / 50, 27.0 / 50, 27.0 / 50};
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(found.scores[i].precision, 1.0);
        EXPECT_DOUBLE_EQ(found.scores[i].recall, recalls[i]);
    }
}

// The result doesn't depend on the places of a groom's vertices.
TEST(CompareStrands, DoesNotDependOnVertices) {
    std::vector<glm::vec3> dense;
    for (int k = 0; k <= 64; ++k)
        dense.emplace_back(0.0f, 0.1f * static_cast<float>(k) / 64.0f, 0.0f);
    const auto found = compared(strandsOf({upright(0, 0.1f)}), strandsOf({dense}));
    EXPECT_EQ(found.scores[0].f1, 1.0);
    EXPECT_LT(found.first_to_second.maximum, kDistanceRounding);
    EXPECT_LT(found.curvatures.earth_movers_distance, 1e-3);  // a radius of one kilometre
}

TEST(CompareStrands, MovesLengthsOntoEachOther) {
    const StrandSet three =
        strandsOf({upright(0, 0.01f), upright(0, 0.02f, 1), upright(0, 0.03f, 2)});
    const StrandSet longer =
        strandsOf({upright(0, 0.02f), upright(0, 0.03f, 1), upright(0, 0.04f, 2)});
    EXPECT_NEAR(compared(three, longer).lengths.earth_movers_distance, 0.01, kDistanceRounding);
    // Half of the first groom's strands and two thirds of the second groom's are 30 mm long, the
    // others 10 mm.
    const auto found = compared(
        strandsOf({upright(0, 0.01f), upright(0, 0.03f, 1)}),
        strandsOf({upright(0, 0.01f), upright(0, 0.03f, 1), upright(0, 0.03f, 2)}));
    EXPECT_NEAR(found.lengths.earth_movers_distance, 0.02 / 6.0, kDistanceRounding);
    EXPECT_NEAR(found.lengths.histogram_distance, 2.0 / 6.0, 1e-12);
}

TEST(CompareStrands, MeasuresTheCurvatureOfACircle) {
    std::vector<glm::vec3> circle;
    for (int degree = 0; degree <= 270; ++degree) {
        const double turn = degree * std::numbers::pi / 180.0;
        circle.emplace_back(0.05 * std::cos(turn), 0.05 * std::sin(turn), 0.0);
    }
    const auto found = compared(strandsOf({upright(0, 0.1f)}), strandsOf({circle}));
    EXPECT_EQ(found.curvatures.first.maximum, 0.0);
    // 1 / 0.05 m; chords of a degree turn the polyline's own chords by up to half of one in 5.7.
    EXPECT_NEAR(found.curvatures.second.mean, 20.0, 0.05);
    EXPECT_NEAR(found.curvatures.second.minimum, 20.0, 2.0);
    EXPECT_NEAR(found.curvatures.earth_movers_distance, found.curvatures.second.mean, 1e-5);
    EXPECT_DOUBLE_EQ(found.curvatures.histogram_distance, 2.0);
}

// A strand from the centre of a ball of 100 mm straight out to 200 mm: samples at 1, 3 ... 97 mm
// are deeper than 1 mm, by 51 mm on average. The sphere of triangles lies up to 0.2 mm inside the
// ball.
TEST(CompareStrands, SaysHowMuchIsInsideAMesh) {
    const StrandSet out = strandsOf({upright(0, 0.2f, 0.0f)});
    const StrandSet beside = strandsOf({upright(0, 0.2f, 0.3f)});
    for (const Mesh& mesh :
         {simulation::makeSphere(glm::dvec3(0.0), 0.1, 4),
          simulation::makeOpenSphere(glm::dvec3(0.0), 0.1, 2.6, 128, 64)}) {
        const BodyMesh body = bodyMesh(mesh);
        const auto found = compareStrands(out, beside, &body, {});
        ASSERT_TRUE(found.first_inside && found.second_inside);
        EXPECT_EQ(found.first_inside->samples_inside, 49u);
        EXPECT_DOUBLE_EQ(found.first_inside->share, 0.49);
        EXPECT_EQ(found.first_inside->strands_inside, 1u);
        EXPECT_NEAR(found.first_inside->mean_depth, 51e-3, 2e-4);
        EXPECT_NEAR(found.first_inside->deepest, 99e-3, 2e-4);
        EXPECT_EQ(found.second_inside->samples_inside, 0u);
        EXPECT_EQ(found.second_inside->mean_depth, 0.0);
        EXPECT_EQ(found.second_inside->deepest, 0.0);
    }
}

TEST(CompareStrands, LeavesOutWhatHasNoLength) {
    const auto found = compared(
        strandsOf({{{5, 5, 5}}, upright(0, 0.1f), {{1, 1, 1}, {1, 1, 1}}}),
        strandsOf({upright(0, 0.1f)}));
    EXPECT_EQ(found.first.strands, 3u);
    EXPECT_EQ(found.first.without_length, 2u);
    EXPECT_EQ(found.scores[0].f1, 1.0);
    EXPECT_EQ(found.scores[0].strand_consistency, 1.0);
    EXPECT_LT(found.first_to_second.maximum, kDistanceRounding);
}

TEST(CompareStrands, IsTheSameWithAnyNumberOfThreads) {
    std::vector<std::vector<glm::vec3>> first;
    std::vector<std::vector<glm::vec3>> second;
    for (int i = 0; i < 300; ++i) {
        const auto x = 0.001f * static_cast<float>(i % 17);
        const auto y = 0.0013f * static_cast<float>(i % 23);
        first.push_back({{x, 0, y}, {x + 0.01f, 0.05f, y}});
        second.push_back({{y, 0, x}, {y, 0.04f, x + 0.01f}, {y, 0.06f, x}});
    }
    CompareSettings settings;
    settings.threads = 1;
    const auto one = compared(strandsOf(first), strandsOf(second), settings);
    settings.threads = 3;
    const auto three = compared(strandsOf(first), strandsOf(second), settings);
    EXPECT_GT(one.scores[2].f1, 0.0);
    EXPECT_LT(one.scores[0].f1, 1.0);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(one.scores[i].f1, three.scores[i].f1);
        EXPECT_EQ(one.scores[i].strand_consistency, three.scores[i].strand_consistency);
    }
    EXPECT_EQ(one.first_to_second.mean, three.first_to_second.mean);
    EXPECT_EQ(one.second_to_first.mean_square, three.second_to_first.mean_square);
}

TEST(CompareStrands, RefusesWhatCannotBeCompared) {
    const StrandSet good = strandsOf({upright(0, 0.1f)});
    EXPECT_THAT(
        errorText([&] { compared({}, good); }), HasSubstr("the first groom: has no strand"));
    EXPECT_THAT(
        errorText([&] { compared(good, strandsOf({{{1, 1, 1}, {1, 1, 1}}})); }),
        HasSubstr("the second groom: has no strand"));
    for (const float odd :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        EXPECT_THAT(
            errorText([&] { compared(good, strandsOf({upright(0, 0.1f), upright(0, odd)})); }),
            HasSubstr("the second groom: strand 1 has coordinates that are not finite"));
        CompareSettings settings;
        settings.spacing = odd;
        EXPECT_THAT(errorText([&] { compared(good, good, settings); }), HasSubstr("spacing"));
        settings = {};
        settings.thresholds = {{2e-3, odd}};
        EXPECT_THAT(errorText([&] { compared(good, good, settings); }), HasSubstr("threshold"));
    }
    CompareSettings settings;
    settings.thresholds.clear();
    EXPECT_THAT(errorText([&] { compared(good, good, settings); }), HasSubstr("thresholds"));
    settings = {};
    settings.spacing = 1e-12;
    EXPECT_THAT(errorText([&] { compared(good, good, settings); }), HasSubstr("is it in metres?"));
}

}  // namespace
}  // namespace hair::groom
