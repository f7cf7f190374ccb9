#include "hair/groom/mesh/body_mesh.h"

#include <algorithm>
#include <cstddef>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hair/groom/mesh/import_mesh.h"
#include "tests/error_text.h"
#include "tests/simulation/closed_meshes.h"

namespace hair::simulation {
namespace {

using groom::ClosedMesh;
using groom::OpenMesh;
using testing::HasSubstr;
using testing::Not;

bool isClosed(const groom::Mesh& mesh) {
    return std::holds_alternative<ClosedMesh>(groom::bodyMesh(mesh));
}

OpenMesh openOf(const groom::Mesh& mesh) { return std::get<OpenMesh>(groom::bodyMesh(mesh)); }

std::ptrdiff_t innerCount(const OpenMesh& mesh) { return std::ranges::count(mesh.inner, true); }

std::string refusal(const groom::Mesh& mesh) {
    return errorText([&] { groom::bodyMesh(mesh); });
}

groom::Mesh openSphere(const glm::dvec3& centre = {0, 0, 0}) {
    return makeOpenSphere(centre, 1.0, 2.0, 24, 12);
}

TEST(BodyMesh, IsAClosedOneWithoutAWarningWhereItCan) {
    for (const groom::Mesh& mesh :
         {makeBox({0, 0, 0}, {1, 2, 3}), makeTorus(1.0, 0.4, 36, 18), makeLShape(), makeStar(),
          groom::importMesh(std::string(HAIRBENCH_SCENES_DIR) + "/assets/head.glb")}) {
        const groom::BodyMesh body = groom::bodyMesh(mesh);
        EXPECT_TRUE(std::holds_alternative<ClosedMesh>(body));
        EXPECT_EQ(groom::bodyWarning(body), "");
    }
    groom::Mesh parts = makeSphere({0, 0, 0}, 1.0, 2);
    append(parts, insideOut(makeSphere({0.1, 0, 0}, 0.6, 2)));  // a cavity
    append(parts, makeSphere({3, 0, 0}, 1.0, 2));
    EXPECT_TRUE(isClosed(parts));
}

// The rim has 24 edges.
TEST(BodyMesh, SaysHowManyEdgesAreOpen) {
    const groom::BodyMesh body = groom::bodyMesh(openSphere());
    EXPECT_THAT(
        groom::bodyWarning(body),
        testing::MatchesRegex(
            "the surface is not closed: edges with one triangle: 24, the first "
            "from .*[)][.] A point is inside if its winding number is 1/2 or more: "
            "openings are capped"));
    EXPECT_EQ(innerCount(std::get<OpenMesh>(body)), 0);
}

// A square sheet stands on an edge of a box: that edge has three triangles, and three edges of the
// sheet have one.
TEST(BodyMesh, TakesASheetThatBranchesOff) {
    groom::Mesh mesh = makeBox({0, 0, 0}, {1, 1, 1});
    addTriangle(mesh, {0, 1, 1}, {1, 1, 1}, {1, 2, 1});
    addTriangle(mesh, {0, 1, 1}, {1, 2, 1}, {0, 2, 1});
    const OpenMesh open = openOf(mesh);
    EXPECT_THAT(open.reason, HasSubstr("edges with one triangle: 3,"));
    EXPECT_THAT(open.reason, HasSubstr("edges with more than two triangles: 1,"));
    EXPECT_EQ(open.triangles.size(), 14u);
    EXPECT_EQ(innerCount(open), 0);
}

TEST(BodyMesh, CountsARepeatedShellOnce) {
    groom::Mesh mesh = openSphere();
    const OpenMesh once = openOf(mesh);
    append(mesh, openSphere());
    const OpenMesh twice = openOf(mesh);
    EXPECT_EQ(twice.triangles, once.triangles);
    EXPECT_THAT(
        twice.reason, HasSubstr("repeated triangles: " + std::to_string(once.triangles.size())));
}

// The spheres have radii 1 and 0.6, and their centres are 1 apart. A triangle inside the other
// sphere has the inside on both sides. This is known except for triangles that are crossed.
TEST(BodyMesh, FindsWhatIsInsideOfPartsThatCross) {
    const glm::dvec3 other{1, 0, 0};
    groom::Mesh mesh = makeSphere({0, 0, 0}, 1.0, 4);
    append(mesh, makeSphere(other, 0.6, 4));
    const OpenMesh open = openOf(mesh);
    EXPECT_THAT(open.reason, HasSubstr("triangles that intersect others: "));
    EXPECT_THAT(open.reason, Not(HasSubstr("edges")));
    constexpr double kEdge = 1.2 * 1.107 / 16;
    const std::size_t first = open.triangles.size() / 2;  // of the second sphere
    std::size_t inside = 0;
    for (std::size_t i = 0; i < open.triangles.size(); ++i) {
        const glm::dvec3 at(open.positions[open.triangles[i][0]]);
        const double depth = i < first ? 0.6 - glm::distance(at, other) : 1.0 - glm::length(at);
        if (depth > 2 * kEdge) {
            ASSERT_TRUE(open.inner[i]) << i;
            ++inside;
        } else if (depth < -2 * kEdge) {
            ASSERT_FALSE(open.inner[i]) << i;
        }
    }
    EXPECT_GT(inside, 100u);
}

TEST(BodyMesh, FindsWhatLiesInAnother) {
    groom::Mesh mesh = makeSphere({0, 0, 0}, 1.0, 2);
    append(mesh, makeSphere({0.1, 0, 0}, 0.6, 2));
    const OpenMesh open = openOf(mesh);
    for (std::size_t i = 0; i < open.triangles.size(); ++i)
        ASSERT_EQ(open.inner[i], i >= open.triangles.size() / 2) << i;
    EXPECT_EQ(open.reason, "triangles with the inside on both sides: 320");
}

// In front of a plane the winding number is at most 1/2, and less because the plane has a rim.
TEST(BodyMesh, RefusesAPlaneWithItsFigure) {
    groom::Mesh plane;
    addTriangle(plane, {0, 0, 0}, {1, 0, 0}, {1, 1, 0});
    addTriangle(plane, {0, 0, 0}, {1, 1, 0}, {0, 1, 0});
    EXPECT_THAT(
        refusal(plane),
        testing::MatchesRegex(
            "the surface encloses nothing: its winding number is at most 0[.](49.*|5), and a point "
            "is inside if it is 1/2 or more; close more of the mesh, or use capsules"));
    groom::Mesh both = openSphere();
    append(both, insideOut(openSphere()));
    EXPECT_THAT(refusal(both), HasSubstr("encloses nothing: its winding number is at most"));
    EXPECT_THAT(refusal({}), HasSubstr("encloses nothing: it has no triangle with an area"));
}

TEST(BodyMesh, RefusesTrianglesThatFaceInward) {
    for (const groom::Mesh& mesh : {openSphere(), makeBox({0, 0, 0}, {1, 1, 2})}) {
        const groom::Mesh turned = insideOut(mesh);
        EXPECT_THAT(
            refusal(turned),
            testing::MatchesRegex(
                "the surface faces inward: " + std::to_string(mesh.triangles.size()) +
                " connected triangles, the first at .*; make all normals point outward .*"));
    }
    groom::Mesh parts = makeBox({0, 0, 0}, {2, 2, 2});
    append(parts, insideOut(openSphere({4, 0, 0})));
    EXPECT_THAT(
        refusal(parts),
        HasSubstr(std::to_string(openSphere().triangles.size()) + " connected triangles"));
    groom::Mesh closed = makeBox({0, 0, 0}, {2, 2, 2});
    append(closed, insideOut(makeSphere({4, 0, 0}, 1.0, 1)));  // the volume is above 0
    EXPECT_THAT(refusal(closed), HasSubstr("faces inward: 80 connected triangles"));
}

TEST(BodyMesh, RefusesTrianglesThatFaceOppositeWays) {
    groom::Mesh mesh = openSphere();
    std::swap(mesh.triangles[70][0], mesh.triangles[70][1]);
    EXPECT_THAT(refusal(mesh), HasSubstr("the surface faces both ways: "));
    EXPECT_THAT(refusal(mesh), HasSubstr("edges whose two triangles face opposite ways: 3,"));
}

// A mask that is far more open than half a sphere, and lashes in front of it. The winding number at
// the lashes is negative, but they do not face inward.
TEST(BodyMesh, TakesASheetBeforeAnOpenMesh) {
    groom::Mesh mask = makeOpenSphere({0, 0, 0}, 1.0, 1.0, 24, 8);
    append(mask, makeOpenSphere({0, 0.01, 0}, 1.0, 0.1, 12, 2));
    EXPECT_EQ(innerCount(openOf(mask)), 0);
}

}  // namespace
}  // namespace hair::simulation
