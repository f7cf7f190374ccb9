#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "benchmarks/measure/case.h"
#include "benchmarks/scene/assets.h"
#include "hair/rendering/scene_meshes.h"
#include "tests/error_text.h"
#include "tests/gpu_fixture.h"
#include "tests/rendering/mesh_pictures.h"

namespace hair::rendering {
namespace {

constexpr Rgb kWhite{255, 255, 255};

groom::Mesh white() { return quad({.base_color = {1, 1, 1}}); }

// The turns take +y to +z, that to +x, and that back to +y.
TEST(MeshPlacement, ScalesTurnsAboutXThenYThenZAndMoves) {
    groom::Mesh mesh = white();
    mesh.positions[0] = {0, 1, 0};
    mesh.normals[0] = {0, 1, 0};
    const auto place = [&](const glm::vec3& rotation) {
        return placed(mesh, {.translation = {10, 20, 30}, .rotation = rotation, .scale = 2});
    };
    // Sines and cosines of right angles in float are off by 1e-7.
    const auto expectNear = [](const glm::vec3& found, const glm::vec3& expected) {
        EXPECT_LT(glm::distance(found, expected), 1e-5f);
    };
    expectNear(place({90, 0, 0}).positions[0], {10, 20, 32});
    expectNear(place({90, 90, 0}).positions[0], {12, 20, 30});
    expectNear(place({90, 90, 90}).positions[0], {10, 22, 30});
    expectNear(place({90, 90, 0}).normals[0], {1, 0, 0});
}

class MeshPlacementTest : public GpuTest {};

// The other meshes stay when the head moves.
TEST_F(MeshPlacementTest, OnlyTheHeadMoves) {
    Settings settings = quadSettings(20);
    // Seen from 0.5 m, half a metre is the picture's half: each square is an eighth of its side.
    settings.render.meshes = {{.translation = {0.25f, 0.25f, 0.0f}, .scale = 0.125f}};
    groom::Mesh head = white();
    for (glm::vec3& position : head.positions) position *= 0.125f;
    const RenderAssets assets{.head = &head, .meshes = {white()}};
    const Pixels still = drawScene(device(), settings, assets);
    const Pixels moved =
        drawScene(device(), settings, assets, glm::translate(glm::mat4(1.0f), {0.0f, -0.3f, 0.0f}));
    EXPECT_EQ(at(still, 20, 15, 5), kWhite);
    EXPECT_EQ(at(moved, 20, 15, 5), kWhite);
    EXPECT_EQ(at(still, 20, 10, 10), kWhite);
    EXPECT_EQ(at(moved, 20, 10, 10), kBackground);
    EXPECT_EQ(at(moved, 20, 10, 16), kWhite);
    EXPECT_EQ(at(still, 20, 5, 5), kBackground);
}

TEST_F(MeshPlacementTest, OnlyTheHeadIsHidden) {
    Settings settings = quadSettings(20);
    settings.render.meshes = {{.translation = {0.25f, 0.25f, 0.0f}, .scale = 0.125f}};
    settings.render.head = false;
    const groom::Mesh head = white();
    const Pixels pixels = drawScene(device(), settings, {.head = &head, .meshes = {white()}});
    EXPECT_EQ(at(pixels, 20, 15, 5), kWhite);
    EXPECT_EQ(at(pixels, 20, 5, 15), kBackground);
}

TEST(MeshAssets, NeedFiles) {
    Settings settings;
    settings.render.meshes = {{.file = "assets/head.glb"}, {}};
    const std::string scene = HAIRBENCH_SCENES_DIR "/rest.json";
    EXPECT_EQ(
        errorText([&] { benchmarks::scene::checkAssets(settings, scene); }),
        scene + ": /render/meshes/1/file: is empty; expected the name of a mesh file");
    settings.render.meshes[1].file = "nowhere.glb";
    EXPECT_EQ(
        errorText([&] { benchmarks::scene::checkAssets(settings, scene); }),
        HAIRBENCH_SCENES_DIR "/nowhere.glb: no such file");
}

}  // namespace
}  // namespace hair::rendering
