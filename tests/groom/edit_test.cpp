#include "hair/groom/edit.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

#include "hair/groom/inspect.h"
#include "hair/groom/mesh/body_mesh.h"
#include "tests/error_text.h"
#include "tests/groom/style/sample_strand_set.h"
#include "tests/simulation/closed_meshes.h"

namespace hair::groom {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

StrandSet strandSet(const std::vector<std::vector<glm::vec3>>& strands) {
    StrandSet set;
    for (const auto& points : strands) {
        set.points.insert(set.points.end(), points.begin(), points.end());
        set.ends.push_back(static_cast<std::uint32_t>(set.points.size()));
    }
    return set;
}

std::vector<std::uint64_t> countsOf(const EditedStrands& edited) {
    std::vector<std::uint64_t> counts;
    for (const EditNote& note : edited.notes) counts.push_back(note.count);
    return counts;
}

// ---- Filter -------------------------------------------------------------------------------------

// Strands in centimetres: 1, 2, 3 and 4 long, with 2, 3, 2 and 2 points.
StrandSet fourLengths() {
    StrandSet set = strandSet(
        {{{0, 0, 0}, {0, 1, 0}},
         {{1, 0, 0}, {1, 1, 0}, {1, 2, 0}},
         {{2, 0, 0}, {2, 3, 0}},
         {{3, 0, 0}, {3, 4, 0}}});
    set.root_triangles = {{0, 1, 2}, {1, 2, 3}};
    return set;
}

TEST(FilterStrands, LeavesOutByTheFirstTestThatAStrandFails) {
    FilterSettings settings;
    settings.shortest = 0.015;
    settings.longest = 0.035;
    settings.most_points = 2;
    const EditedStrands edited = filterStrands(fourLengths(), settings, nullptr, 0.01);
    EXPECT_THAT(countsOf(edited), ElementsAre(1, 1, 1));
    EXPECT_THAT(edited.notes[0].what, HasSubstr("shorter than 15 mm"));
    EXPECT_THAT(edited.strands.points, ElementsAre(glm::vec3(2, 0, 0), glm::vec3(2, 3, 0)));
    EXPECT_TRUE(edited.strands.root_triangles.empty());
}

TEST(FilterStrands, KeepsTrianglesWhoseStrandsStay) {
    FilterSettings settings;
    settings.shortest = 0.015;
    const EditedStrands edited = filterStrands(fourLengths(), settings, nullptr, 0.01);
    EXPECT_EQ(edited.strands.strandCount(), 3u);
    EXPECT_THAT(edited.strands.root_triangles, ElementsAre(std::array<std::uint32_t, 3>{0, 1, 2}));
}

TEST(FilterStrands, HoldsStrandsAgainstAMesh) {
    const BodyMesh ball = bodyMesh(simulation::makeSphere(glm::dvec3(0.0), 0.1, 4));
    const StrandSet strands = strandSet(
        {{{0, 0.1f, 0}, {0, 0.2f, 0}},  // good
         {{0, 0.105f, 0}, {0, 0.2f, 0}},  // 5 mm off
         {{0, 0.1f, 0}, {0, 0.08f, 0}}});  // 20 mm inside
    FilterSettings settings;
    settings.farthest_root = 0.002;
    settings.deepest = 0.015;
    const EditedStrands edited = filterStrands(strands, settings, &ball, 1.0);
    EXPECT_THAT(countsOf(edited), ElementsAre(1, 1));
    EXPECT_EQ(edited.strands.strandCount(), 1u);
    EXPECT_EQ(edited.strands.points[1], glm::vec3(0, 0.2f, 0));
    EXPECT_THAT(
        errorText([&] { filterStrands(strands, settings, nullptr, 1.0); }), HasSubstr("no mesh"));
}

TEST(FilterStrands, RefusesToLeaveNothing) {
    FilterSettings settings;
    settings.shortest = 1.0;
    EXPECT_EQ(
        errorText([&] { filterStrands(fourLengths(), settings, nullptr, 0.01); }),
        "no strand is left");
    EXPECT_EQ(
        errorText([&] { filterStrands(StrandSet{}, {}, nullptr, 1.0); }), "no strand is left");
}

// ---- Smooth -------------------------------------------------------------------------------------

TEST(SmoothStrands, KeepsStraightStrandsRootsAndSegments) {
    const StrandSet straight = strandSet({{{1, 2, 3}, {1, 2, 5}, {1, 2, 6}, {1, 2, 10}}});
    EXPECT_EQ(smoothStrands(straight, 3.0).points, straight.points);
    const StrandSet bent = strandSet({{{1, 2, 3}, {2, 2, 3}, {2, 4, 3}, {2, 4, 3}, {2, 4, 4}}});
    const StrandSet smooth = smoothStrands(bent, 0.7);
    EXPECT_EQ(smooth.points[0], bent.points[0]);
    for (std::size_t k = 1; k < 5; ++k)
        EXPECT_NEAR(
            glm::distance(smooth.points[k - 1], smooth.points[k]),
            glm::distance(bent.points[k - 1], bent.points[k]), 2e-6)  // ten roundings of floats
            << k;
    EXPECT_EQ(smooth.points[2], smooth.points[3]);
}

// Two segments of the lengths 1 and directions x and y. With the flow length^2 / 1 = 1 between them
// (2 -1; -1 2) t = (x, y): t = ((2, 1) / 3, (1, 2) / 3).
TEST(SmoothStrands, SolvesTheDiffusionOfTwoDirections) {
    const StrandSet smooth = smoothStrands(strandSet({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}}), 1.0);
    const double root = std::sqrt(5.0);
    EXPECT_NEAR(smooth.points[1].x, 2.0 / root, 1e-7);
    EXPECT_NEAR(smooth.points[1].y, 1.0 / root, 1e-7);
    EXPECT_NEAR(smooth.points[2].x, 3.0 / root, 2e-7);
    EXPECT_NEAR(smooth.points[2].y, 3.0 / root, 2e-7);
}

// A wave of small slope along x, ten periods. Smoothing multiplies slopes in the middle by 1 / (1 +
// k^2 length^2), whatever the distance between points.
TEST(SmoothStrands, DampsWavesByTheirLength) {
    for (const int points_per_wave : {50, 100}) {
        constexpr double kSlope = 1e-2;
        const double wave_number = 2.0 * std::numbers::pi;  // for waves of length 1
        std::vector<glm::vec3> wave;
        for (int i = 0; i <= 10 * points_per_wave; ++i) {
            const double x = static_cast<double>(i) / points_per_wave;
            wave.emplace_back(x, kSlope / wave_number * std::sin(wave_number * x), 0.0);
        }
        const double length = 0.2;
        const StrandSet smooth = smoothStrands(strandSet({wave}), length);
        double steepest = 0.0;
        for (int i = 4 * points_per_wave; i < 6 * points_per_wave; ++i) {
            const glm::dvec3 along = glm::dvec3(smooth.points[static_cast<std::size_t>(i) + 1]) -
                                     glm::dvec3(smooth.points[static_cast<std::size_t>(i)]);
            steepest = std::max(steepest, std::abs(along.y / along.x));
        }
        const double wanted = kSlope / (1.0 + std::pow(wave_number * length, 2));
        // The error of finite volumes is (k h)^2 / 12, which is 0.13 % with 50 points a wave.
        // Floats round slopes by 1e-6, relative to 4e-3, over a segment of 0.01 m at x = 5.
        EXPECT_NEAR(steepest / wanted, 1.0, 0.01) << points_per_wave;
    }
}

TEST(SmoothStrands, KeepsCirclesAwayFromTheirEnds) {
    std::vector<glm::vec3> circle;
    for (int degree = 0; degree <= 720; ++degree) {
        const double turn = degree * std::numbers::pi / 180.0;
        circle.emplace_back(std::cos(turn), std::sin(turn), 0.0);
    }
    const StrandSet smooth = smoothStrands(strandSet({circle}), 0.2);
    // The ends have no effect twenty lengths away: exp(-20). The chord turns by a degree.
    for (std::size_t k = 230; k < 490; ++k) {
        const glm::dvec3 a = smooth.points[k - 1];
        const glm::dvec3 b = smooth.points[k];
        const glm::dvec3 c = smooth.points[k + 1];
        const double turn = std::acos(glm::dot(glm::normalize(b - a), glm::normalize(c - b)));
        EXPECT_NEAR(turn * 180.0 / std::numbers::pi, 1.0, 0.01) << k;
    }
}

// ---- Resample -----------------------------------------------------------------------------------

TEST(ResampleBySpacing, SpacesEachStrandAsNearAsItGoes) {
    StrandSet set = strandSet({{{0, 0, 0}, {4, 0, 0}}, {{0, 1, 0}, {0.3f, 1, 0}}, {{5, 5, 5}}});
    set.widths.values = {2, 6, 1, 1, 7};
    const StrandSet even = resampleBySpacing(set, 1.3);
    EXPECT_EQ(even.ends, (std::vector<std::uint32_t>{4, 6, 7}));
    EXPECT_THAT(
        even.points, ElementsAre(
                         glm::vec3(0, 0, 0), glm::vec3(static_cast<float>(4.0 / 3.0), 0, 0),
                         glm::vec3(static_cast<float>(8.0 / 3.0), 0, 0), glm::vec3(4, 0, 0),
                         glm::vec3(0, 1, 0), glm::vec3(0.3f, 1, 0), glm::vec3(5, 5, 5)));
    EXPECT_FLOAT_EQ(even.widths.values[1], 2.0f + 4.0f / 3.0f);
    EXPECT_EQ(even.widths.values.back(), 7.0f);
}

// ---- Fix ----------------------------------------------------------------------------------------

TEST(FixStrands, LeavesOutWhatShowsNothing) {
    StrandSet set = strandSet(
        {{{9, 9, 9}},
         {{0, 0, 0}, {0, 1, 0}},
         {{1, 1, 1}, {1, 1, 1}},
         {{2, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 1, 0}, {2, 2, 0}},
         {{0, 0, 0}, {0, 1, 0}}});
    set.widths.values = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
    set.root_triangles = {{1, 3, 3}, {1, 2, 3}};
    const EditedStrands edited = fixStrands(set, nullptr, 1.0, 0.01);
    EXPECT_THAT(countsOf(edited), ElementsAre(1, 1, 1, 2, 0));
    EXPECT_EQ(edited.strands.ends, (std::vector<std::uint32_t>{2, 5}));
    EXPECT_THAT(
        edited.strands.points, ElementsAre(
                                   glm::vec3(0, 0, 0), glm::vec3(0, 1, 0), glm::vec3(2, 0, 0),
                                   glm::vec3(2, 1, 0), glm::vec3(2, 2, 0)));
    EXPECT_EQ(edited.strands.widths.values, (std::vector<float>{2, 3, 6, 8, 10}));
    EXPECT_THAT(edited.strands.root_triangles, ElementsAre(std::array<std::uint32_t, 3>{0, 1, 1}));
    // A second inspection finds none of the repaired faults.
    const StrandFindings found = inspect(edited.strands, nullptr, {});
    EXPECT_EQ(found.single_point_strands, 0u);
    EXPECT_EQ(found.zero_length_strands, 0u);
    EXPECT_EQ(found.zero_length_segments, 0u);
    EXPECT_EQ(found.duplicate_strands, 0u);
    EXPECT_THAT(countsOf(fixStrands(edited.strands, nullptr, 1.0, 0.01)), testing::Each(0));
}

TEST(FixStrands, ResamplesStrandsThatAreTooLongForGuides) {
    std::vector<glm::vec3> many;
    for (int i = 0; i < 300; ++i) many.emplace_back(0.01f * static_cast<float>(i), 0.0f, 0.0f);
    const EditedStrands edited =
        fixStrands(strandSet({many, {{0, 1, 0}, {1, 1, 0}}}), nullptr, 1.0, 0.01);
    EXPECT_EQ(edited.strands.ends, (std::vector<std::uint32_t>{256, 258}));
    EXPECT_EQ(edited.strands.points[255], many.back());
    EXPECT_EQ(edited.notes.back().count, 1u);
}

TEST(FixStrands, PutsStrandsOntoAMesh) {
    const Mesh sphere = simulation::makeSphere(glm::dvec3(0.0), 0.1, 4);
    const BodyMesh ball = bodyMesh(sphere);
    // In centimetres, as the strands are; the first is 5 mm off, the second 50 mm.
    const StrandSet strands = strandSet(
        {{{0, 10.5f, 0}, {0, 12, 0}},
         {{15, 0, 0}, {16, 0, 0}},
         {{0, 0, 10}, {0, 0, 9}, {0, 0, 11}}});
    const EditedStrands edited = fixStrands(strands, &ball, 0.01, 0.01);
    EXPECT_THAT(countsOf(edited), ElementsAre(0, 0, 0, 0, 0, 1, 1, 1));
    // The sphere's triangles are up to 0.2 mm inside the ball.
    EXPECT_NEAR(edited.strands.points[0].y, 10.0, 0.02);
    EXPECT_NEAR(edited.strands.points[1].y - edited.strands.points[0].y, 1.5, 1e-5);
    EXPECT_EQ(edited.strands.points[2], strands.points[2]);
    EXPECT_NEAR(edited.strands.points[5].z, 10.0, 0.02);
    EXPECT_EQ(edited.strands.points[6], strands.points[6]);
    EXPECT_NEAR(arcLength(edited.strands.strand(2)), 1.0, 0.05);
    const StrandFindings found = inspect(edited.strands, &sphere, 0.01);
    EXPECT_EQ(found.mesh->roots_off_surface, 1u);
    EXPECT_EQ(found.mesh->strands_inside, 0u);
}

// ---- Reverse ------------------------------------------------------------------------------------

TEST(ReverseStrands, TurnsPointsAndTheirDataRound) {
    const StrandSet sample = sampleStrandSet();
    const StrandSet turned = reverseStrands(sample);
    EXPECT_EQ(turned.ends, sample.ends);
    EXPECT_EQ(
        turned.points,
        (std::vector<glm::vec3>{{0, 1, 0}, {0, 0, 0}, {2, 0, 3}, {2, 0, 2}, {2, 0, 0}, {5, 5, 5}}));
    EXPECT_EQ(turned.widths.values, (std::vector<float>{2, 1, 5, 4, 3, 6}));
    EXPECT_EQ(turned.colors.values[2], glm::vec3(0.5f));
    EXPECT_EQ(turned.transparencies.everywhere, 0.25f);
    EXPECT_EQ(turned.root_uvs, sample.root_uvs);
    EXPECT_EQ(turned.groups, sample.groups);
    EXPECT_EQ(turned.root_triangles, sample.root_triangles);
    EXPECT_EQ(reverseStrands(turned).points, sample.points);
}

// ---- Transform ----------------------------------------------------------------------------------

TEST(TransformStrands, TurnsEachUpwardAxisToEachOther) {
    for (std::uint8_t from = 0; from < 3; ++from) {
        for (std::uint8_t to = 0; to < 3; ++to) {
            const glm::dmat3 turn = upAxisTurn(from, to);
            glm::dvec3 up(0.0);
            up[from] = 1.0;
            glm::dvec3 expected(0.0);
            expected[to] = 1.0;
            EXPECT_EQ(turn * up, expected);
            EXPECT_EQ(glm::dot(turn[0], glm::cross(turn[1], turn[2])), 1.0) << "a mirror image";
            EXPECT_EQ(upAxisTurn(to, from) * turn, glm::dmat3(1.0));
        }
    }
}

// An inch is 25.4 mm, and with +z up instead of +y, (x, y, z) becomes (x, -z, y).
TEST(TransformStrands, ChangesUnitAxisMirrorFactorAndPlaceInThisOrder) {
    StrandSet strands = strandSet({{{1, 2, 3}, {4, 5, 6}}});
    strands.widths.everywhere = 0.5f;
    const EditedStrands edited = transformStrands(
        strands, {.from_metres_per_unit = 0.0254,
                  .metres_per_unit = 0.001,
                  .from_up = std::uint8_t{1},
                  .up = std::uint8_t{2},
                  .mirror = std::uint8_t{0},
                  .scale = 2.0,
                  .translation = {100, 0, 1}});
    const std::vector<glm::dvec3> expected{
        {100 - 50.8 * 1, -50.8 * 3, 1 + 50.8 * 2}, {100 - 50.8 * 4, -50.8 * 6, 1 + 50.8 * 5}};
    ASSERT_EQ(edited.strands.points.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i)
        for (int axis = 0; axis < 3; ++axis)
            // One rounding to a float, below 512.
            EXPECT_NEAR(edited.strands.points[i][axis], expected[i][axis], 2e-5);
    EXPECT_FLOAT_EQ(*edited.strands.widths.everywhere, 25.4f);
    EXPECT_EQ(edited.strands.metres_per_unit, 0.001);
    EXPECT_EQ(edited.strands.up, 2);
    EXPECT_THAT(countsOf(edited), ElementsAre(1, 1, 1, 1, 1));
}

TEST(TransformStrands, KeepsOuterSidesOfAMirrorImage) {
    StrandSet strands = strandSet({{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}});
    strands.root_triangles = {{0, 1, 2}};
    const EditedStrands edited = transformStrands(strands, {.mirror = std::uint8_t{0}});
    const auto& corners = edited.strands.root_triangles[0];
    const auto at = [&](std::size_t i) { return edited.strands.points[corners[i]]; };
    EXPECT_EQ(glm::cross(at(1) - at(0), at(2) - at(0)), glm::vec3(0, 0, 1));
}

TEST(TransformStrands, RefusesWhatItCannotKnowOrHold) {
    const StrandSet strands = strandSet({{{0, 1e30f, 0}, {0, 2e30f, 0}}});
    EXPECT_THAT(
        errorText([&] { transformStrands(strands, {.metres_per_unit = 0.01}); }),
        HasSubstr("unit is not stated"));
    EXPECT_THAT(
        errorText([&] { transformStrands(strands, {.up = std::uint8_t{2}}); }),
        HasSubstr("axis is not stated"));
    EXPECT_THAT(
        errorText([&] { transformStrands(strands, {.scale = 1e10}); }),
        HasSubstr("strand 0 would be outside"));
}

// ---- Groups -------------------------------------------------------------------------------------

TEST(Groups, AreCountedInOrder) {
    const std::vector<StrandGroup> groups = groupsOf(sampleStrandSet());
    ASSERT_EQ(groups.size(), 3u);
    EXPECT_EQ(groups[0].number, -5);  // a strand along z from 0 by 2 and 3
    EXPECT_EQ(groups[0].strands, 1u);
    EXPECT_EQ(groups[0].guides, 0u);
    EXPECT_EQ(groups[0].points, 3u);
    EXPECT_EQ(groups[0].mean_length, 3.0);
    EXPECT_EQ(groups[1].number, 4);
    EXPECT_EQ(groups[1].guides, 1u);
    EXPECT_EQ(groups[2].number, 6);
    StrandSet none = sampleStrandSet();
    none.groups.clear();
    ASSERT_EQ(groupsOf(none).size(), 1u);
    EXPECT_EQ(groupsOf(none)[0].number, std::nullopt);
    EXPECT_EQ(groupsOf(none)[0].strands, 3u);
}

TEST(Groups, AreRenumberedAllAtOnce) {
    const EditedStrands edited = renumberGroups(sampleStrandSet(), {{4, 6}, {6, 4}, {-5, 4}});
    EXPECT_THAT(edited.strands.groups, ElementsAre(6, 4, 4));
    EXPECT_THAT(countsOf(edited), ElementsAre(1, 1, 1));
    EXPECT_THAT(
        errorText([] { renumberGroups(sampleStrandSet(), {{3, 1}}); }),
        HasSubstr("there is no group 3"));
    EXPECT_THAT(
        errorText([] { renumberGroups(sampleStrandSet(), {{4, 1}, {4, 2}}); }),
        HasSubstr("two numbers"));
}

}  // namespace
}  // namespace hair::groom
