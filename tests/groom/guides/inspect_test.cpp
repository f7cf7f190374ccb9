#include "hair/groom/inspect.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

#include "hair/groom/build_groom.h"
#include "tests/groom/style/sample_strand_set.h"
#include "tests/groom/style/sample_strands.h"
#include "tests/groom/test_meshes.h"
#include "tests/simulation/closed_meshes.h"

namespace hair::groom {
namespace {

using testing::HasSubstr;

void expectSummary(const Summary& spread, const std::array<double, 6>& expected) {
    EXPECT_DOUBLE_EQ(spread.minimum, expected[0]);
    EXPECT_DOUBLE_EQ(spread.quartile1, expected[1]);
    EXPECT_DOUBLE_EQ(spread.median, expected[2]);
    EXPECT_DOUBLE_EQ(spread.quartile3, expected[3]);
    EXPECT_DOUBLE_EQ(spread.maximum, expected[4]);
    EXPECT_DOUBLE_EQ(spread.mean, expected[5]);
}

TEST(SummaryOf, InterpolatesBetweenRanks) {
    const auto of = [](std::vector<float> numbers) { return summaryOf(numbers); };
    expectSummary(of({7, 1, 4, 3, 9}), {1, 3, 4, 7, 9, 4.8});
    expectSummary(of({4, 1, 3, 2}), {1, 1.75, 2.5, 3.25, 4, 2.5});
    expectSummary(of({5}), {5, 5, 5, 5, 5, 5});
    expectSummary(of({}), {0, 0, 0, 0, 0, 0});
}

TEST(Inspect, CountsAndMeasures) {
    const StrandFindings found = inspect(sampleStrandSet(), nullptr, {});
    EXPECT_EQ(found.strands, 3u);
    EXPECT_EQ(found.points, 6u);
    expectSummary(found.points_per_strand, {1, 1.5, 2, 2.5, 3, 2});
    expectSummary(found.lengths, {0, 0.5, 1, 2, 3, 4.0 / 3.0});
    expectSummary(found.segment_lengths, {1, 1, 1, 1.5, 2, 4.0 / 3.0});
    expectSummary(found.widths, {1, 2.25, 3.5, 4.75, 6, 3.5});
    EXPECT_EQ(found.minimum, glm::vec3(0, 0, 0));
    EXPECT_EQ(found.maximum, glm::vec3(5, 5, 5));
    EXPECT_EQ(found.single_point_strands, 1u);
    EXPECT_EQ(found.zero_length_segments, 0u);
    EXPECT_EQ(found.zero_length_strands, 0u);
    EXPECT_EQ(found.duplicate_strands, 0u);
    EXPECT_EQ(found.duplicate_roots, 0u);
    EXPECT_FALSE(found.mesh.has_value());
}

TEST(Inspect, CountsWhatHasNoLength) {
    StrandSet strands;
    strands.points = {{1, 1, 1}, {0, 0, 0}, {0, 0, 0}, {2, 0, 0}, {2, 0, 0}, {3, 0, 0}};
    strands.ends = {1, 3, 6};
    strands.widths.everywhere = 0.5f;
    const StrandFindings found = inspect(strands, nullptr, {});
    EXPECT_EQ(found.single_point_strands, 1u);
    EXPECT_EQ(found.zero_length_strands, 1u);
    EXPECT_EQ(found.zero_length_segments, 2u);
    expectSummary(found.widths, {0.5, 0.5, 0.5, 0.5, 0.5, 0.5});
}

TEST(Inspect, CountsStrandsAndRootsThatWereThereBefore) {
    StrandSet strands;
    const auto add = [&strands](std::initializer_list<glm::vec3> points) {
        strands.points.insert(strands.points.end(), points);
        strands.ends.push_back(static_cast<std::uint32_t>(strands.points.size()));
    };
    add({{0, 0, 0}, {0, 1, 0}});
    add({{0, 0, 0}, {0, 2, 0}});              // a duplicate of only the root
    add({{-0.0f, 0, 0}, {0, 1, 0}});          // -0 equals 0
    add({{0, 0, 0}, {0, 1, 0}, {0, 1, 0}});   // one point more
    add({{1, 0, 0}, {0, 1, 0}});
    add({{0, 0, 0}, {0, 1, 0}});
    add({{0, 0, 0}});
    const StrandFindings found = inspect(strands, nullptr, {});
    EXPECT_EQ(found.duplicate_strands, 2u);
    EXPECT_EQ(found.duplicate_roots, 5u);
}

TEST(Inspect, TakesNoStrands) {
    const StrandFindings found = inspect({}, nullptr, {});
    EXPECT_EQ(found.strands, 0u);
    EXPECT_EQ(found.unit, "m");
    EXPECT_THAT(found.unit_reason, HasSubstr("nothing"));
    const Mesh mesh = makeCap();
    EXPECT_EQ(inspect({}, &mesh, {}).mesh->roots_off_surface, 0u);
}

// Hair of a head: 0.2 m across, 0.02 m to 0.8 m long.
TEST(Inspect, GuessesTheUnit) {
    for (const double length : {0.02, 0.25, 0.8}) {
        StrandSet strands = strandsOf(sampleGroom(50, 4, [=](std::uint32_t strand, double t) {
            const double turn = 0.7 * strand;
            return glm::dvec3(0.1 * std::cos(turn), 1.6 - length * t, 0.09 * std::sin(turn));
        }));
        strands.metres_per_unit.reset();
        const std::pair<const char*, double> units[] = {
            {"m", 1.0}, {"cm", 0.01}, {"mm", 0.001}, {"inch", 0.0254}};
        for (const auto& [name, metres] : units) {
            StrandSet scaled = strands;
            for (glm::vec3& point : scaled.points) point /= static_cast<float>(metres);
            const StrandFindings found = inspect(scaled, nullptr, {});
            EXPECT_EQ(found.unit, name);
            EXPECT_EQ(found.metres_per_unit, metres);
            EXPECT_FALSE(found.unit_stated);
            EXPECT_THAT(
                found.unit_reason, HasSubstr("in " + std::string(name) + " the roots span"));
        }
    }
}

TEST(Inspect, GuessesFromOneStrand) {
    StrandSet strands;
    strands.points = {{0, 0, 0}, {0, 150, 0}};
    strands.ends = {2};
    EXPECT_EQ(inspect(strands, nullptr, {}).unit, "mm");
}

TEST(Inspect, BelievesAStatedUnit) {
    StrandSet strands = sampleStrandSet();
    EXPECT_EQ(inspect(strands, nullptr, {}).unit, "cm");
    EXPECT_TRUE(inspect(strands, nullptr, {}).unit_stated);
    EXPECT_THAT(inspect(strands, nullptr, {}).unit_reason, HasSubstr("states"));
    strands.metres_per_unit = 0.5;
    EXPECT_EQ(inspect(strands, nullptr, {}).unit, "0.5 m");
    EXPECT_EQ(inspect(strands, nullptr, {}).metres_per_unit, 0.5);
}

// A square of roots as wide as a head, with hair of 0.1 m.
StrandSet squareOfHair(double metres_per_unit) {
    StrandSet strands;
    for (int i = 0; i < 400; ++i) {
        const glm::dvec3 root(0.01 * (i % 20), 0.0, 0.01 * (i / 20));
        for (int k = 0; k < 3; ++k)
            strands.points.emplace_back((root + glm::dvec3(0, 0.05 * k, 0)) / metres_per_unit);
        strands.ends.push_back(static_cast<std::uint32_t>(strands.points.size()));
    }
    return strands;
}

// Only a clear contradiction is one: half a metre is within the scatter of a head's size.
TEST(Inspect, DoubtsAStatedUnitThatSizesContradict) {
    for (const auto& [stated, doubted] :
         {std::pair{1.0, false}, {0.5, false}, {0.01, true}, {0.001, true}}) {
        StrandSet strands = squareOfHair(1.0);
        strands.metres_per_unit = stated;
        const StrandFindings found = inspect(strands, nullptr, {});
        EXPECT_EQ(found.metres_per_unit, stated);
        ASSERT_EQ(found.other_unit.has_value(), doubted) << stated;
        if (!doubted) continue;
        EXPECT_EQ(found.other_unit->unit.name, "m");
        EXPECT_GT(found.other_unit->certainty, 0.99);
        EXPECT_LE(found.other_unit->certainty, 1.0);
    }
}

// Two strands 5 cm apart are no scalp.
TEST(Inspect, DoubtsNoUnitOfAFewStrands) {
    StrandSet strands = squareOfHair(0.01);
    strands.ends.resize(19);
    strands.points.resize(strands.ends.back());
    strands.metres_per_unit = 1.0;
    EXPECT_FALSE(inspect(strands, nullptr, {}).other_unit);
    strands = squareOfHair(0.01);
    strands.metres_per_unit = 1.0;
    EXPECT_TRUE(inspect(strands, nullptr, {}).other_unit);
}

TEST(FindStrays, FindsRootsAndSegmentsThatAreFarOff) {
    StrandSet strands = squareOfHair(0.01);
    EXPECT_TRUE(findStrays(strands).empty());
    for (int k = 0; k < 3; ++k) strands.points[3 * 17 + k].z += 1000.0f;
    strands.points[3 * 230 + 2].y = -500.0f;
    const std::vector<Stray> strays = findStrays(strands);
    ASSERT_EQ(strays.size(), 2u);
    EXPECT_EQ(strays[0].strand, 17u);
    EXPECT_TRUE(strays[0].by_root);
    EXPECT_NEAR(strays[0].distance, 1000.0, 10.0);  // the roots are within 10 cm of their middle
    EXPECT_EQ(strays[1].strand, 230u);
    EXPECT_FALSE(strays[1].by_root);
    EXPECT_NEAR(strays[1].distance, 505.0, 1e-3);
    EXPECT_EQ(strandsBut(strands, strays).size(), 398u);
    const StrandFindings found = inspect(strands, nullptr, {});
    EXPECT_EQ(found.unit, "cm");
    EXPECT_LT(found.maximum.z, 20.0f);
    EXPECT_GE(found.minimum.y, 0.0f);
}

TEST(FindStrays, LeavesFewStrandsAndTwoHeadsAlone) {
    StrandSet few = squareOfHair(1.0);
    few.ends.resize(19);
    few.points.resize(few.ends.back());
    few.points[0].x = 1000.0f;
    EXPECT_TRUE(findStrays(few).empty());
    StrandSet heads = squareOfHair(1.0);
    for (std::size_t i = 0; i < heads.points.size() / 10; ++i) heads.points[i].x += 10.0f;
    EXPECT_TRUE(findStrays(heads).empty());  // a tenth of the strands
}

// In a box from 0 to 1 m the points' distances from the sides are known.
TEST(Inspect, MeasuresAgainstAClosedMesh) {
    StrandSet strands;
    strands.points = {{50, 100, 50},     {50, 150, 50},  // on the top, then upwards
                      {50, 100.25f, 50}, {75, 60, 50},
                      {50, 99.95f, 50},  // 2.5 mm off, then inside twice
                      {50, 99.5f, 20},   {50, 99.5f, 21},  // 5 mm deep
                      {-200, 300, 500}};
    strands.ends = {2, 5, 7, 8};
    strands.metres_per_unit = 0.01;
    const Mesh box = simulation::makeBox({0, 0, 0}, {1, 1, 1});
    const MeshFindings found = *inspect(strands, &box, {}).mesh;
    EXPECT_EQ(found.tolerance, 0.001);
    EXPECT_EQ(found.roots_off_surface, 3u);
    EXPECT_NEAR(found.root_distances.minimum, 0.0, 1e-7);
    EXPECT_NEAR(found.root_distances.maximum, std::sqrt(4.0 + 4.0 + 16.0), 1e-6);
    EXPECT_NEAR(found.root_distances.median, 0.5 * (0.0025 + 0.005), 1e-7);
    EXPECT_EQ(found.strands_inside, 2u);
    EXPECT_EQ(found.points_inside, 3u);  // the one at 0.5 mm counts as on the surface
    EXPECT_NEAR(found.deepest.value(), 0.25, 1e-7);
    EXPECT_TRUE(found.not_closed.empty());
    // At ten times the size, the other points are outside too.
    EXPECT_EQ(inspect(strands, &box, 0.1).mesh->points_inside, 0u);
}

// Points at known radii about a sphere: its triangles are at most 0.06 mm inside it.
TEST(Inspect, FindsTheDepthsInASphere) {
    const Mesh sphere = simulation::makeSphere({0, 1, 0}, 0.1, 4);
    const Groom groom = sampleGroom(400, 12, [](std::uint32_t strand, double t) {
        const double y = 1.0 - 2.0 * (strand + 0.5) / 400.0;
        const double r = std::sqrt(1.0 - y * y);
        const glm::dvec3 out(r * std::cos(2.4 * strand), y, r * std::sin(2.4 * strand));
        return glm::dvec3(0, 1, 0) + (0.05 + 0.11 * t) * out;  // 5 of 12 inside by 10 mm or more
    });
    const MeshFindings found = *inspect(strandsOf(groom), &sphere, {}).mesh;
    EXPECT_EQ(found.strands_inside, 400u);
    EXPECT_EQ(found.points_inside, 5u * 400u);
    EXPECT_NEAR(found.deepest.value(), 0.05, 1e-4);
    EXPECT_EQ(found.roots_off_surface, 400u);
}

// As before, on the upper half of a sphere that has a hole of 25 degrees at the bottom.
TEST(Inspect, FindsTheDepthsInAnOpenMesh) {
    Mesh sphere = simulation::makeSphere({0, 1, 0}, 0.1, 4);
    std::erase_if(sphere.triangles, [&](const std::array<std::uint32_t, 3>& triangle) {
        return std::ranges::all_of(
            triangle, [&](std::uint32_t vertex) { return sphere.positions[vertex].y < 0.91f; });
    });
    const Groom groom = sampleGroom(200, 12, [](std::uint32_t strand, double t) {
        const double y = (strand + 0.5) / 200.0;
        const double r = std::sqrt(1.0 - y * y);
        const glm::dvec3 out(r * std::cos(2.4 * strand), y, r * std::sin(2.4 * strand));
        return glm::dvec3(0, 1, 0) + (0.05 + 0.11 * t) * out;
    });
    const MeshFindings found = *inspect(strandsOf(groom), &sphere, {}).mesh;
    EXPECT_FALSE(found.closed);
    EXPECT_THAT(found.not_closed, HasSubstr("edges with one triangle"));
    EXPECT_EQ(found.strands_inside, 200u);
    EXPECT_EQ(found.points_inside, 5u * 200u);
    EXPECT_NEAR(found.deepest.value(), 0.05, 1e-4);
}

TEST(Inspect, SaysWhyNothingIsInsideAPlane) {
    Mesh plane;
    plane.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {1, 0, 1}};
    plane.normals.resize(4, glm::vec3(0, 1, 0));
    plane.triangles = {{0, 2, 1}, {1, 2, 3}};
    const MeshFindings found = *inspect(sampleStrandSet(), &plane, {}).mesh;
    EXPECT_FALSE(found.closed);
    EXPECT_FALSE(found.strands_inside.has_value());
    EXPECT_FALSE(found.points_inside.has_value());
    EXPECT_FALSE(found.deepest.has_value());
    EXPECT_FALSE(found.not_closed.empty());
}

}  // namespace
}  // namespace hair::groom
