#include "benchmarks/viewer/scene_file.h"

#include <cmath>

#include <gmock/gmock.h>

#include "benchmarks/measure/case.h"
#include "benchmarks/scene/assets.h"
#include "benchmarks/scene/schema.h"
#include "engine/pictures.h"
#include "hair/groom/build_groom.h"
#include "hair/groom/mesh/import_mesh.h"
#include "tests/error_text.h"
#include "tests/temporary_folder.h"

namespace benchmarks::viewer {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const std::string kScenes = HAIRBENCH_SCENES_DIR;
const std::vector<std::uint8_t> kPixel{1, 2, 3, 4};

// Strands that stand on a sphere of 0.1 m, as an OBJ in a unit of `unit` metres, moved by `offset`
// m along x.
std::string objOf(int strands, double unit, double offset) {
    std::string text;
    for (int i = 0; i < strands; ++i) {
        // Fibonacci lattice, upper half.
        const double y = 1.0 - (i + 0.5) / strands;
        const double angle = 2.399963 * i;
        const double r = std::sqrt(1.0 - y * y);
        for (const double radius : {0.1, 0.15, 0.2})
            text += "v " + std::to_string((radius * r * std::cos(angle) + offset) / unit) + ' ' +
                    std::to_string(radius * y / unit) + ' ' +
                    std::to_string(radius * r * std::sin(angle) / unit) + '\n';
    }
    for (int i = 0; i < strands; ++i)
        text += "l " + std::to_string(3 * i + 1) + ' ' + std::to_string(3 * i + 2) + ' ' +
                std::to_string(3 * i + 3) + '\n';
    return text;
}

std::string gltfOf(const std::string& mode) {
    return R"({"asset": {"version": "2.0"}, "meshes": [{"primitives": [{"attributes": {})" + mode +
           "}]}]}";
}

TEST(OpenScene, ReadsSceneFilesWithoutTheirSweep) {
    const SceneFile file = openScene(kScenes + "/smoke.json");
    EXPECT_EQ(file.name, "smoke");
    EXPECT_EQ(file.directory, kScenes);
    EXPECT_EQ(file.settings.strands.density, 16u);
    EXPECT_EQ(file.settings.render.msaa, 1u);
}

TEST(OpenScene, ReadsScreenshots) {
    const TemporaryFolder folder;
    writeScreenshot(folder.file("shot.png"), 1, 1, kPixel, R"({"strands": {"density": 9}})");
    const SceneFile file = openScene(folder.file("shot.png"));
    EXPECT_EQ(file.settings.strands.density, 9u);
    EXPECT_EQ(file.directory, folder.path());
}

TEST(OpenScene, SaysWhatIsNone) {
    const TemporaryFolder folder;
    EXPECT_THAT(
        errorText([] { openScene(kScenes + "/full.json"); }),
        HasSubstr("full.json: /suite: is a suite of scenes"));
    folder.write("cut.png", "\x89PNG\r\n\x1a\n");
    EXPECT_EQ(
        folder.relative(errorText([&] { openScene(folder.file("cut.png")); })),
        "cut.png: byte 8: the file ends before its last chunk");
    EXPECT_THAT(errorText([&] { openScene(folder.file("gone.json")); }), HasSubstr("no such file"));
}

TEST(DroppedFiles, AreWhatTheyHold) {
    const TemporaryFolder folder;
    const auto kind = [&](const char* name, std::string_view content) {
        return whatIs(folder.write(name, content));
    };
    EXPECT_EQ(kind("a.json", "{}"), Dropped::scene);
    EXPECT_EQ(kind("a.exr", ""), Dropped::environment);
    EXPECT_EQ(kind("a.HDR", ""), Dropped::environment);
    EXPECT_EQ(kind("a.hair", "HAIR"), Dropped::groom);
    EXPECT_EQ(kind("a.bin", "HAIR"), Dropped::groom);
    EXPECT_EQ(kind("a.tfx", ""), Dropped::groom);
    EXPECT_EQ(kind("a.usda", "#usda 1.0"), Dropped::groom);
    EXPECT_EQ(kind("a.stl", ""), Dropped::mesh);
    EXPECT_EQ(kind("a.log", "text"), Dropped::unknown);
    EXPECT_EQ(whatIs(folder.file("gone.hair")), Dropped::unknown);
    EXPECT_EQ(whatIs(folder.path()), Dropped::unknown);
    EXPECT_EQ(whatIs(kScenes + "/assets/head.glb"), Dropped::mesh);
    EXPECT_EQ(whatIs(kScenes + "/assets/studio.exr"), Dropped::environment);
}

TEST(DroppedFiles, AreStrandsOrTrianglesByTheirContent) {
    const TemporaryFolder folder;
    const auto kind = [&](const char* name, std::string_view content) {
        return whatIs(folder.write(name, content));
    };
    const std::string vertices = "v 0 0 0\nvn 0 1 0\nv 1 0 0\nv 0 1 0\n";
    EXPECT_EQ(kind("a.obj", vertices + "l 1 2 3\n"), Dropped::groom);
    EXPECT_EQ(kind("a.obj", vertices + "f 1 2 3\n"), Dropped::mesh);
    EXPECT_EQ(kind("a.obj", vertices + "l 1 2\n  f 1 2 3"), Dropped::mesh);
    EXPECT_EQ(kind("a.gltf", gltfOf("")), Dropped::mesh);
    EXPECT_EQ(kind("a.gltf", gltfOf(R"(, "mode": 4)")), Dropped::mesh);
    EXPECT_EQ(kind("a.gltf", gltfOf(R"(, "mode": 3)")), Dropped::groom);
    EXPECT_EQ(kind("a.gltf", "[1, 2]"), Dropped::mesh);
    const std::string ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n";
    const std::string face = "element face 1\nproperty list uchar int vertex_indices\n";
    const std::string edge = "element edge 2\nproperty int vertex1\nproperty int vertex2\n";
    EXPECT_EQ(kind("a.ply", ply + edge + "end_header\n"), Dropped::groom);
    EXPECT_EQ(kind("a.ply", ply + face + "end_header\n"), Dropped::mesh);
    EXPECT_EQ(kind("a.ply", ply + face + edge + "end_header\n"), Dropped::mesh);
}

TEST(DroppedFiles, AreScenesWhereAPictureHasOne) {
    const TemporaryFolder folder;
    writeScreenshot(folder.file("shot.png"), 1, 1, kPixel, "{}");
    engine::writePng(folder.file("picture.png"), 1, 1, kPixel);
    EXPECT_EQ(whatIs(folder.file("shot.png")), Dropped::scene);
    EXPECT_EQ(whatIs(folder.file("picture.png")), Dropped::unknown);
    EXPECT_EQ(whatIs(folder.write("cut.png", "\x89PNG\r\n\x1a\n")), Dropped::scene);
}

class DroppedOn : public testing::Test {
protected:
    // Drops a file on the defaults with one collider that follows the head and one in the world.
    hair::Settings dropped(const fs::path& file) const {
        hair::Settings settings;
        settings.groom.grow.mesh = kScenes + "/assets/head.glb";
        settings.groom.style.cut.length = 0.05f;
        settings.simulation.colliders = {{}, {.follows = hair::Follows::world}};
        settings.simulation.distance_fields = {{}};
        settings.simulation.pulls = {{}};
        return withDropped(settings, folder_.path(), file);
    }

    hair::groom::Groom build(const hair::Settings& settings) const {
        scene::checkSettings(settings);
        const auto mesh = scene::loadMesh(settings, folder_.path());
        return hair::groom::buildGroom(
            settings.groom, mesh ? &*mesh : nullptr, folder_.path(), settings.seed);
    }

    TemporaryFolder folder_;
};

TEST_F(DroppedOn, AGroomIsInPlaceOfTheHair) {
    const auto file = folder_.write("hair/few.obj", objOf(40, 0.01, 5.0));
    const hair::Settings settings = dropped(file);
    EXPECT_EQ(settings.groom.file, "hair/few.obj");
    EXPECT_EQ(settings.groom.placement.scale, 0.01f);  // the file's unit
    EXPECT_EQ(settings.groom.style.cut.length, 0.0f);
    EXPECT_TRUE(settings.simulation.pulls.empty());
    const hair::groom::Groom groom = build(settings);
    EXPECT_EQ(groom.strand_count, 40u);
}

TEST_F(DroppedOn, AGroomThatIsElsewhereHasNoHead) {
    const hair::Settings settings = dropped(folder_.write("far.obj", objOf(40, 0.01, 5.0)));
    EXPECT_EQ(settings.groom.mesh, "");
    ASSERT_EQ(settings.simulation.colliders.size(), 1u);
    EXPECT_EQ(settings.simulation.colliders[0].follows, hair::Follows::world);
    EXPECT_TRUE(settings.simulation.distance_fields.empty());
}

TEST_F(DroppedOn, AGroomOnTheHeadKeepsIt) {
    const hair::groom::Mesh head = hair::groom::importMesh(kScenes + "/assets/head.glb");
    std::string text;
    int vertex = 0;
    std::string lines;
    for (std::size_t i = 0; i < head.positions.size(); i += head.positions.size() / 50) {
        for (const float height : {0.0f, 0.05f, 0.1f}) {
            const glm::vec3 point = head.positions[i] + height * head.normals[i];
            text += "v " + std::to_string(point.x) + ' ' + std::to_string(point.y) + ' ' +
                    std::to_string(point.z) + '\n';
        }
        lines += "l " + std::to_string(vertex + 1) + ' ' + std::to_string(vertex + 2) + ' ' +
                 std::to_string(vertex + 3) + '\n';
        vertex += 3;
    }
    const hair::Settings settings = dropped(folder_.write("on.obj", text + lines));
    EXPECT_EQ(settings.groom.placement.scale, 1.0f);
    EXPECT_EQ(settings.groom.mesh, kScenes + "/assets/head.glb");
    EXPECT_EQ(settings.simulation.colliders.size(), 2u);
    EXPECT_EQ(settings.simulation.distance_fields.size(), 1u);
}

TEST_F(DroppedOn, ADenseGroomGetsGuidesAndIsDrawnAsItIs) {
    const hair::Settings settings = dropped(folder_.write("dense.obj", objOf(1500, 0.01, 5.0)));
    EXPECT_EQ(settings.groom.guides, 300u);
    EXPECT_EQ(settings.strands.source, hair::StrandSource::groom);
    const hair::groom::Groom groom = build(settings);
    EXPECT_EQ(groom.strand_count, 300u);
    EXPECT_EQ(groom.bindings.size(), 1500u);
}

TEST_F(DroppedOn, AFileOutsideTheFolderHasItsWholeName) {
    const TemporaryFolder other;
    const auto file = other.write("few.obj", objOf(40, 0.01, 5.0));
    EXPECT_EQ(dropped(file).groom.file, fs::canonical(file).string());
}

TEST_F(DroppedOn, AMeshIsOneMore) {
    const hair::Settings settings =
        dropped(folder_.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
    ASSERT_EQ(settings.render.meshes.size(), 1u);
    EXPECT_EQ(settings.render.meshes[0].file, "a.obj");
    EXPECT_EQ(settings.groom.file, "");
    hair::Settings full;
    full.render.meshes.resize(16);
    EXPECT_THAT(
        errorText([&] { withDropped(full, folder_.path(), folder_.file("a.obj")); }),
        HasSubstr("a.obj: the scene has 16 meshes already"));
}

TEST_F(DroppedOn, AnEnvironmentIsInPlaceOfTheOneThatWasThere) {
    fs::copy(kScenes + "/assets/studio.exr", folder_.file("sky.exr"));
    EXPECT_EQ(dropped(folder_.file("sky.exr")).render.environment, "sky.exr");
}

TEST_F(DroppedOn, WhatCannotBeUsedSaysWhy) {
    const auto error = [&](const fs::path& file) {
        return folder_.relative(errorText([&] { dropped(file); }));
    };
    EXPECT_EQ(
        error(folder_.write("a.log", "x")),
        "a.log: is not a groom, mesh or environment (.exr, .hdr)");
    EXPECT_EQ(error(folder_.file("gone.hair")), "gone.hair: no such file");
    EXPECT_THAT(error(folder_.write("a.hair", "HAIR")), HasSubstr("a.hair: byte "));
    EXPECT_THAT(error(folder_.write("a.exr", "x")), HasSubstr("a.exr: "));
    EXPECT_THAT(error(folder_.write("a.obj", "v 0 0 0\n")), HasSubstr("a.obj: "));
    EXPECT_THAT(
        error(folder_.write("\xff.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")),
        HasSubstr("its name is not UTF-8"));
}

}  // namespace
}  // namespace benchmarks::viewer
