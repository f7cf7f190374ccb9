#include "hair/groom/mesh/surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hair/groom/mesh/import_mesh.h"
#include "tests/error_text.h"
#include "tests/simulation/closed_meshes.h"

namespace hair::simulation {
namespace {

using testing::HasSubstr;

double volumeOf(const groom::ClosedMesh& mesh) {
    double volume = 0.0;
    for (const auto& [a, b, c] : mesh.triangles)
        volume += glm::dot(
                      glm::dvec3(mesh.positions[a]),
                      glm::cross(glm::dvec3(mesh.positions[b]), glm::dvec3(mesh.positions[c]))) /
                  6.0;
    return volume;
}

double areaOf(const groom::ClosedMesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
    const glm::dvec3 a(mesh.positions[triangle[0]]);
    return glm::length(glm::cross(
               glm::dvec3(mesh.positions[triangle[1]]) - a,
               glm::dvec3(mesh.positions[triangle[2]]) - a)) /
           2.0;
}

TEST(ClosedMesh, WeldsTheCornersOfABox) {
    const groom::ClosedMesh box = groom::closeMesh(makeBox({-1, -2, -3}, {1, 2, 3}));
    EXPECT_EQ(box.positions.size(), 8u);
    EXPECT_EQ(box.triangles.size(), 12u);
    EXPECT_NEAR(volumeOf(box), 48.0, 1e-12);
}

// The three faces at a corner each have the weight of a right angle, into however many triangles
// they are cut. The two faces at an edge have equal weights. Both triangles at a face's diagonal
// have the same normal. Tolerance: roundings of numbers below 5.
TEST(ClosedMesh, PseudonormalsOfABoxAreItsDiagonals) {
    const groom::ClosedMesh box = groom::closeMesh(makeBox({-1, -1, -1}, {1, 1, 1}));
    const double quarter = std::numbers::pi / 2;
    for (std::size_t i = 0; i < box.triangles.size(); ++i) {
        const groom::Pseudonormals& normals = box.normals[i];
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3 corner(box.positions[box.triangles[i][k]]);
            const glm::dvec3 next(box.positions[box.triangles[i][(k + 1) % 3]]);
            EXPECT_LT(glm::distance(normals.corners[k], quarter * corner), 1e-14);
            const glm::dvec3 middle = (corner + next) / 2.0;
            const glm::dvec3 expected =
                glm::length(middle) > 1.1 ? middle : 2.0 * normals.face;  // else a diagonal
            EXPECT_LT(glm::distance(normals.edges[k], expected), 1e-14);
            EXPECT_NEAR(glm::dot(normals.face, corner), 1.0, 1e-14);
        }
        EXPECT_NEAR(glm::length(normals.face), 1.0, 1e-14);
    }
}

TEST(ClosedMesh, SaysWhereAnOpenMeshIsOpen) {
    groom::Mesh box = makeBox({0, 0, 0}, {1, 2, 3});
    box.triangles.erase(box.triangles.begin());  // of the face x = 0
    const std::string error = errorText([&] { groom::closeMesh(box); });
    EXPECT_THAT(error, HasSubstr("not closed: edges with one triangle: 3, the first from (0, "));
    EXPECT_THAT(error, testing::Not(HasSubstr("nan")));
    EXPECT_THAT(errorText([] { groom::closeMesh({}); }), HasSubstr("it has 0 triangles"));
}

TEST(ClosedMesh, RefusesATriangleThatFacesTheOtherWay) {
    groom::Mesh box = makeBox({0, 0, 0}, {1, 2, 3});
    std::swap(box.triangles[5][0], box.triangles[5][1]);
    EXPECT_THAT(
        errorText([&] { groom::closeMesh(box); }),
        HasSubstr("not closed: edges whose two triangles face opposite ways: 3, the first from ("));
}

// Two boxes share the edge x = y = 1.
TEST(ClosedMesh, RefusesAnEdgeOfFourTriangles) {
    groom::Mesh boxes = makeBox({0, 0, 0}, {1, 1, 1});
    append(boxes, makeBox({1, 1, 0}, {2, 2, 1}));
    EXPECT_THAT(
        errorText([&] { groom::closeMesh(boxes); }),
        HasSubstr("edges with more than two triangles: 1, the first from (1, 1, "));
}

TEST(ClosedMesh, RefusesASurfaceWhoseInsideIsOut) {
    EXPECT_THAT(
        errorText([] { groom::closeMesh(insideOut(makeBox({0, 0, 0}, {1, 1, 2}))); }),
        HasSubstr("inside out or encloses nothing: it has 12 triangles and a volume of -2 m^3"));
}

TEST(ClosedMesh, TakesSeveralPartsAndCavities) {
    groom::Mesh parts = makeBox({0, 0, 0}, {3, 3, 3});
    append(parts, makeSphere({5, 0, 0}, 1.0, 0));
    append(parts, insideOut(makeBox({1, 1, 1}, {2, 2, 2})));
    const groom::ClosedMesh closed = groom::closeMesh(parts);
    EXPECT_EQ(closed.positions.size(), 8u + 12u + 8u);
    EXPECT_EQ(closed.triangles.size(), 12u + 20u + 12u);
}

TEST(ClosedMesh, LeavesOutTrianglesWithEqualCorners) {
    groom::Mesh box = makeBox({0, 0, 0}, {1, 1, 1});
    addTriangle(box, {0, 0, 0}, {1, 0, 0}, {0, 0, 0});
    addTriangle(box, {7, 7, 7}, {7, 7, 7}, {7, 7, 7});
    EXPECT_EQ(groom::closeMesh(box).triangles.size(), 12u);
}

// A tetrahedron has the volume 4. One of its edges is cut in three on one of its two faces, and two
// triangles without area fill the slit.
TEST(ClosedMesh, TurnsTheEdgesOfTrianglesWithoutArea) {
    const glm::dvec3 a{0, 0, 0}, b{6, 0, 0}, c{0, 2, 0}, d{0, 0, -2};
    const glm::dvec3 m1{2, 0, 0}, m2{4, 0, 0};
    groom::Mesh mesh;
    addTriangle(mesh, a, b, c);
    addTriangle(mesh, b, a, m1);
    addTriangle(mesh, b, m1, m2);
    addTriangle(mesh, b, m2, d);
    addTriangle(mesh, m2, m1, d);
    addTriangle(mesh, m1, a, d);
    addTriangle(mesh, c, b, d);
    addTriangle(mesh, a, c, d);
    const groom::ClosedMesh closed = groom::closeMesh(mesh);
    EXPECT_EQ(closed.triangles.size(), 8u);
    EXPECT_NEAR(volumeOf(closed), 4.0, 1e-12);
    double area = 0.0;
    for (const auto& triangle : closed.triangles) {
        EXPECT_GT(areaOf(closed, triangle), 0.5);
        area += areaOf(closed, triangle);
    }
    // The faces have the areas 6 * 2 / 2 twice, 2 * 2 / 2, and |(-6, 2, 0) x (-6, 0, -2)| / 2 for
    // the slanted one.
    EXPECT_NEAR(area, 14.0 + std::sqrt(16.0 + 144.0 + 144.0) / 2, 1e-12);
}

// V - E + F = 2 with E = 3 F / 2.
TEST(ClosedMesh, TheHeadIsClosed) {
    const groom::Mesh head =
        groom::importMesh(std::string(HAIRBENCH_SCENES_DIR) + "/assets/head.glb");
    const groom::ClosedMesh closed = groom::closeMesh(head);
    EXPECT_EQ(closed.triangles.size(), head.triangles.size());
    EXPECT_EQ(closed.positions.size(), 2 + closed.triangles.size() / 2);
}

}  // namespace
}  // namespace hair::simulation
