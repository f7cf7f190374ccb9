// Reads files that make_usd_meshes.py writes with usd-core. Expected values are computed by hand.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

#include "hair/groom/mesh/deforming_mesh.h"
#include "hair/groom/mesh/import_mesh.h"
#include "tests/error_text.h"
#include "tests/python.h"
#include "tests/required.h"
#include "tests/temporary_folder.h"

namespace hair::groom {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// Rounding of floats up to 5.
constexpr double kFloatRounding = 1e-6;

class UsdMeshes : public testing::Test {
protected:
    void SetUp() override {
        if (pythonInterpreter().empty()) return skipWithout(Need::python, kNoPython);
        const Outcome made =
            runPython("tests/skin/make_usd_meshes.py", "'" + folder_.path().string() + "'");
        ASSERT_EQ(made.status, 0) << made.output;
    }

    std::filesystem::path file(const std::string& name) const {
        return folder_.path() / (name + ".usda");
    }
    std::vector<glm::dvec3> at(const std::string& name, double time) const {
        const MeshAnimation animation(file(name), "points");
        MeshAnimation::Pose pose;
        animation.poseAt(time, pose);
        std::vector<glm::dvec3> positions;
        animation.positions(pose, positions);
        for (std::size_t i = 0; i < positions.size(); ++i)
            EXPECT_EQ(animation.position(pose, i), positions[i]);
        return positions;
    }

private:
    TemporaryFolder folder_;
};

void expectNear(const std::vector<glm::dvec3>& found, const std::vector<glm::dvec3>& expected) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
        EXPECT_LT(glm::distance(found[i], expected[i]), kFloatRounding)
            << i << ": " << found[i].x << ' ' << found[i].y << ' ' << found[i].z;
}

// The file has (x, y, z) in cm with z up, which becomes (x, z, -y) / 100.
TEST_F(UsdMeshes, APointCacheIsPlayedFromItsFirstSampleOn) {
    expectNear(at("cache", 0.0), {{0, 0, 0}, {1, 0, 0}, {1, 0, -1}, {0, 0, -1}});
    // Half of the 12 time codes to the second sample, with 24 a second.
    expectNear(at("cache", 0.25), {{0, 0, 0}, {1, 0, 0}, {1, 0.25, -1}, {0, 0.25, -1}});
    expectNear(at("cache", 0.5), {{0, 0, 0}, {1, 0, 0}, {1, 0.5, -1}, {0, 0.5, -1}});
    // A quarter of the 24 time codes to the third sample.
    expectNear(at("cache", 0.75), {{0.05, 0, 0}, {1.05, 0, 0}, {1.05, 0.5, -1}, {0.05, 0.5, -1}});
    for (const double late : {1.5, 99.0})
        expectNear(at("cache", late), {{0.2, 0, 0}, {1.2, 0, 0}, {1.2, 0.5, -1}, {0.2, 0.5, -1}});
    EXPECT_EQ(MeshAnimation(file("cache"), "points").duration(), 1.5);
}

TEST_F(UsdMeshes, TransformsMoveWhatIsUnderThem) {
    expectNear(
        at("moved", 0.5),
        {{0, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}, {0, 0, 5}, {1, 0, 5}, {1, 1, 5}, {0, 1, 5}});
}

// Points turn about (0, 1, 0) by 90 degrees counter-clockwise. Relative to it, (1, 2) is at (1, 1)
// and moves to (-1, 1); (0, 2) is at (0, 1) and moves to (-1, 0).
TEST_F(UsdMeshes, ASkeletonTurnsThePointsThatItCarries) {
    expectNear(at("skeleton", 0.0), {{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0, 2, 0}});
    expectNear(at("skeleton", 1.0), {{0, 0, 0}, {1, 0, 0}, {-1, 2, 0}, {-1, 1, 0}});
}

TEST_F(UsdMeshes, ItsOneClipIsNamedPoints) {
    EXPECT_THAT(animationNames(file("cache")), ElementsAre("points"));
    EXPECT_THAT(animationNames(file("surface")), IsEmpty());
    EXPECT_THAT(
        errorText([&] { MeshAnimation(file("cache"), "walk"); }),
        HasSubstr("cache.usda: has no animation 'walk'; the only one of a USD file is 'points'"));
    EXPECT_THAT(
        errorText([&] { MeshAnimation(file("surface"), "points"); }),
        HasSubstr("surface.usda: nothing in it moves"));
}

// The root is 0.1 m above the middle of an edge that the second sample lifts by 0.5 m. The triangle
// below turns about the first edge by atan(0.5), so its normal is (0, 2, 1) / sqrt(5).
TEST_F(UsdMeshes, RootsGoWithTheirTriangles) {
    AnimationSettings settings;
    settings.clip = "points";
    const DeformingMesh mesh(
        importMesh(file("cache")), MeshAnimation(file("cache"), "points"), settings);
    const std::vector<glm::vec3> roots{{0.5f, 0.1f, -1.0f}};
    const std::vector<SurfaceMotion> motions = mesh.motions(mesh.bind(roots), 0.5);
    ASSERT_EQ(motions.size(), 1u);
    const glm::dvec3 on_edge(0.5, 0.5, -1.0);
    const glm::dvec3 root = motions[0](glm::dvec3(roots[0]));
    // The triangle also stretches along its slope by sqrt(1.25). The rotation of the polar
    // decomposition is still the one about the first edge.
    EXPECT_LT(
        glm::distance(root, on_edge + 0.1 * glm::normalize(glm::dvec3(0, 2, 1))), kFloatRounding);
}

TEST_F(UsdMeshes, FacesBecomeTrianglesAndSeamsVertices) {
    const Mesh mesh = importMesh(file("surface"));
    EXPECT_THAT(mesh.parts, ElementsAre("head", "flipped"));
    ASSERT_EQ(mesh.materials.size(), 3u);
    EXPECT_EQ(mesh.materials[0].name, "head");
    EXPECT_EQ(mesh.materials[1].name, "scalp");
    EXPECT_EQ(mesh.materials[2].name, "flipped");
    EXPECT_THAT(mesh.triangle_parts, ElementsAre(0u, 0u, 0u, 1u, 1u));
    EXPECT_THAT(mesh.triangle_materials, ElementsAre(0u, 0u, 1u, 2u, 2u));
    // IEC 61966-2-1: 1.055 0.5^(1 / 2.4) - 0.055.
    EXPECT_NEAR(mesh.materials[0].base_color.x, 0.735357, 1e-5);
    EXPECT_EQ(mesh.materials[0].base_color.y, 0.0f);
    EXPECT_EQ(mesh.materials[0].base_color.z, 1.0f);
    // Points 1 and 2 are on the seam. So there are five points, two more for the seam, and the four
    // of the second mesh.
    ASSERT_EQ(mesh.positions.size(), 11u);
    ASSERT_EQ(mesh.texture_coordinates.size(), 11u);
    // Each corner of each triangle has its face's texture coordinate, v down.
    const std::vector<std::pair<glm::vec3, glm::vec2>> corners{
        {{0, 0, 0}, {0, 1}},    {{1, 0, 0}, {0.5, 1}}, {{1, 1, 0}, {0.5, 0}},
        {{0, 0, 0}, {0, 1}},    {{1, 1, 0}, {0.5, 0}}, {{0, 1, 0}, {0, 0}},
        {{1, 0, 0}, {0.75, 1}}, {{2, 0, 0}, {1, 1}},   {{1, 1, 0}, {0.75, 0}}};
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::uint32_t vertex = mesh.triangles[i / 3][i % 3];
        EXPECT_EQ(mesh.positions[vertex], corners[i].first) << i;
        EXPECT_EQ(mesh.texture_coordinates[vertex], corners[i].second) << i;
        EXPECT_EQ(mesh.normals[vertex], glm::vec3(0, 0, 1)) << i;
    }
    const auto& [a, b, c] = mesh.triangles[3];
    EXPECT_EQ(mesh.normals[a], glm::vec3(0, 0, -1));
    EXPECT_LT(
        glm::cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]).z,
        0.0f);
}

TEST_F(UsdMeshes, WhatIsWrongIsNamed) {
    const std::pair<const char*, const char*> refused[] = {
        {"corner", "/a: corner 3 is point 4 of 4"},
        {"face", "/a: face 0 has 2 corners"},
        {"corners", "/a: 4 corners of faces, but 7 are needed"},
        {"topology", "/a: faceVertexIndices changes over time"},
        {"number", "/a: point 1 is not finite"},
        {"empty", "the stage has no Mesh with faces"},
    };
    for (const auto& [name, reason] : refused) {
        const std::string error =
            errorText([&] { importMesh(file(std::string("refused_") + name)); });
        EXPECT_THAT(error, HasSubstr(reason));
        EXPECT_THAT(error, HasSubstr(std::string("refused_") + name + ".usda: "));
    }
    EXPECT_THAT(
        errorText([&] { MeshAnimation(file("refused_count"), "points"); }),
        HasSubstr("/a: 5 points at time code 2"));
}

}  // namespace
}  // namespace hair::groom
