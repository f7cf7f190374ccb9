#include "benchmarks/scene/extensions.h"

#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "benchmarks/scene/assets.h"
#include "benchmarks/scene/sweep.h"
#include "tests/error_text.h"
#include "tests/temporary_folder.h"

namespace benchmarks {
namespace {

namespace fs = std::filesystem;

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

// "in" is the scene's folder; files beside it are out of reach.
class SceneReach : public testing::Test {
protected:
    SceneReach() {
        folder.write("private/head.obj", kTetrahedron);
        folder.write("private/base.json", "{}");
        folder.write("in/below/head.obj", kTetrahedron);
    }

    // Returns the error of opening a scene with this text and all files of its cases.
    std::string error(const std::string& text, scene::Outside outside = scene::Outside::refused) {
        const fs::path path = folder.write("in/s.json", text);
        return folder.relative(errorText([&] {
            scene::Scene opened = scene::loadScene(path, outside);
            scene::checkAssets(opened.settings, path, assets, opened.reach);
        }));
    }

    static std::string fieldOf(const std::string& mesh) {
        return R"({"groom": {"grow": {"mesh": ")" HAIRBENCH_SCENES_DIR
               R"(/assets/head.glb"}}, "simulation": {"distance_fields": [{"mesh": ")" +
               mesh + "\"}]}}";
    }

    static constexpr const char* kTetrahedron =
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

    TemporaryFolder folder;
    scene::AssetStore assets;
};

TEST_F(SceneReach, EndsAtItsFolder) {
    EXPECT_EQ(error(fieldOf("below/head.obj")), "no error");
    EXPECT_EQ(error(fieldOf("below/../below/head.obj")), "no error");
    for (const std::string& name :
         {std::string("../private/head.obj"), folder.file("private/head.obj").string(),
          std::string("below/../../private/head.obj")})
        EXPECT_THAT(
            error(fieldOf(name)), AllOf(
                                      StartsWith("in/s.json: /simulation/distance_fields/0/mesh: "),
                                      HasSubstr("is outside"), HasSubstr("--allow-outside")))
            << name;
    EXPECT_EQ(error(fieldOf("../private/head.obj"), scene::Outside::allowed), "no error");
}

TEST_F(SceneReach, EndsWhereLinksLeadOut) {
    fs::create_directory_symlink("../private", folder.file("in/linked"));
    EXPECT_THAT(error(fieldOf("linked/head.obj")), HasSubstr("is outside"));
    fs::create_symlink("round", folder.file("in/round"));
    EXPECT_THAT(error(fieldOf("round")), HasSubstr("round: "));
}

TEST_F(SceneReach, IsThatOfBasesToo) {
    EXPECT_THAT(
        error(R"({"base": "../private/base.json"})"),
        AllOf(StartsWith("in/s.json: /base: "), HasSubstr("is outside")));
    // A file out of reach is not even looked up.
    EXPECT_THAT(error(R"({"base": "../../none.json"})"), HasSubstr("is outside"));
    EXPECT_EQ(
        error(
            R"({"base": "../private/base.json", "groom": {"grow": {"mesh": ")" HAIRBENCH_SCENES_DIR
            R"(/assets/head.glb"}}})",
            scene::Outside::allowed),
        "no error");
    EXPECT_EQ(error(R"({"base": ")" HAIRBENCH_SCENES_DIR R"(/smoke.json"})"), "no error");
}

TEST_F(SceneReach, IsThatOfEveryValueOfAnAxis) {
    const std::string base = R"({"base": ")" HAIRBENCH_SCENES_DIR R"(/smoke.json", "sweep": {)";
    for (const char* axis :
         {R"("/render/environment": ["", "../private/sky.exr"])",
          R"("/render": [{"environment": "../private/sky.exr"}, {"msaa": 1}])",
          R"("zip": [{"/strands/density": [1, 2], "/render/environment": ["", "/etc/sky.exr"]}])",
          R"("cases": [{"/render/environment": "../private/sky.exr"}, {"/strands/density": 2}])"})
        EXPECT_THAT(error(base + axis + "}}"), HasSubstr("is outside")) << axis;
    EXPECT_EQ(error(base + R"("/render/environment": ["", "below/sky.exr"]}})"), "no error");
}

TEST_F(SceneReach, IsThatOfTheSuiteForItsMembers) {
    folder.write("in/below/m.json", fieldOf("../s.obj"));
    folder.write("in/s.obj", kTetrahedron);
    const fs::path suite = folder.write("in/all.json", R"({"suite": ["below/m.json"]})");
    EXPECT_EQ(errorText([&] { scene::loadScenes(suite); }), "no error");
    EXPECT_THAT(
        errorText([&] { scene::loadScene(folder.file("in/below/m.json")); }),
        HasSubstr("is outside"));
    const fs::path other = folder.write("in/other.json", R"({"suite": ["../private/base.json"]})");
    EXPECT_THAT(errorText([&] { scene::loadScenes(other); }), HasSubstr("is outside"));
    EXPECT_EQ(errorText([&] { scene::loadScenes(other, scene::Outside::allowed); }), "no error");
}

// A schema beside scenes marks a folder of scenes.
TEST_F(SceneReach, IsTheWholeFolderOfScenes) {
    const fs::path path = folder.write("in/below/s.json", fieldOf("../far/head.obj"));
    folder.write("in/far/head.obj", kTetrahedron);
    const auto load = [&] { return errorText([&] { scene::loadScene(path); }); };
    EXPECT_THAT(load(), HasSubstr("is outside"));
    folder.write("in/scene.schema.json", "{}");
    EXPECT_EQ(load(), "no error");
    folder.write("in/below/scene.schema.json", "{}");  // the nearest one counts
    EXPECT_THAT(load(), HasSubstr("is outside"));
    fs::remove(folder.file("in/below/scene.schema.json"));
    EXPECT_EQ(load(), "no error");
    fs::permissions(folder.file("in"), fs::perms::all);  // anybody could have put the schema there
    EXPECT_THAT(load(), HasSubstr("is outside"));
}

// 36 bytes for the corners of a triangle. Tests buffers and pictures of a glTF file, and textures
// of an OBJ file.
TEST_F(SceneReach, IsThatOfFilesThatFilesName) {
    folder.write("private/buffer.bin", std::string(36, '\0'));
    const std::string gltf =
        R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
        "textures": [{"source": 0}], "images": [{"uri": "IMAGE"}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri": "BUFFER"}]})";
    const auto meshOf = [&](std::string buffer, std::string image) {
        std::string text = gltf;
        text.replace(text.find("BUFFER"), 6, buffer);
        text.replace(text.find("IMAGE"), 5, image);
        folder.write("in/m.gltf", text);
        return R"({"base": ")" HAIRBENCH_SCENES_DIR
               R"(/smoke.json", "render": {"meshes": [{"file": "m.gltf"}]}})";
    };
    EXPECT_THAT(
        error(meshOf("../private/buffer.bin", "none.png")),
        AllOf(StartsWith("in/m.gltf: "), HasSubstr("buffer.bin: is outside")));
    EXPECT_THAT(
        error(meshOf("../private/buffer.bin", "none.png"), scene::Outside::allowed),
        HasSubstr("none.png: no such file"));
    folder.write("in/buffer.bin", std::string(36, '\0'));
    EXPECT_THAT(
        error(meshOf("buffer.bin", "../private/skin.png")),
        AllOf(StartsWith("in/m.gltf: "), HasSubstr("skin.png: is outside")));
    EXPECT_THAT(error(meshOf("buffer.bin", "..%2Fprivate%2Fskin.png")), HasSubstr("is outside"));

    folder.write("in/m.mtl", "newmtl skin\nmap_Kd ../private/skin.png\n");
    folder.write(
        "in/m.obj", std::string("mtllib m.mtl\nusemtl skin\nvt 0 0\n") +
                        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/1 2/1 3/1\n");
    EXPECT_THAT(
        error(R"({"base": ")" HAIRBENCH_SCENES_DIR
              R"(/smoke.json", "render": {"meshes": [{"file": "m.obj"}]}})"),
        AllOf(StartsWith("in/m.obj: "), HasSubstr("skin.png: is outside")));
}

// Another program opens the materials.
TEST_F(SceneReach, IsThatOfMaterialsToo) {
    folder.write("private/a.mtl", "newmtl a\nKd 1 0 0\n");
    folder.write("in/a.obj", std::string("mtllib ../private/a.mtl\n") + kTetrahedron);
    EXPECT_THAT(error(fieldOf("a.obj")), HasSubstr("is outside the scene's folder"));
    EXPECT_EQ(error(fieldOf("a.obj"), scene::Outside::allowed), "no error");
}

// The user may name any file on the command line.
TEST_F(SceneReach, IsNotThatOfTheCommandLine) {
    const fs::path path =
        folder.write("in/s.json", R"({"base": ")" HAIRBENCH_SCENES_DIR R"(/smoke.json"})");
    scene::Scene opened = scene::loadScene(path);
    const scene::SceneOptions options{
        .scene = path,
        .axes = {"/simulation/distance_fields/0/mesh=" + folder.file("private/head.obj").string()},
        .sets = {"/simulation/distance_fields=[{\"mesh\": \"../private/head.obj\"}]"}};
    EXPECT_EQ(errorText([&] { scene::selectCases(opened, options); }), "no error");
}

TEST(ShippedScenes, AreNamedFromAnywhere) {
    const TemporaryFolder folder;
    const fs::path before = fs::current_path();
    fs::current_path(folder.path());
    const fs::path thesis = fs::canonical(HAIRBENCH_SCENES_DIR "/thesis.json");
    for (const char* name : {"thesis", "thesis.json", "scenes/thesis", "./scenes/thesis.json"})
        EXPECT_EQ(scene::sceneNamed(name), thesis) << name;
    EXPECT_EQ(
        scene::sceneNamed("portraits/braid"),
        fs::canonical(HAIRBENCH_SCENES_DIR "/portraits/braid.json"));
    for (const char* name : {"", "no_such_scene", "portraits", "../scenes/thesis", "/thesis"})
        EXPECT_EQ(scene::sceneNamed(name), name);
    const std::vector<std::string> all = scene::shippedScenes();
    EXPECT_THAT(all, testing::IsSupersetOf({"full", "portraits/braid", "thesis"}));
    for (const std::string& name : all) EXPECT_TRUE(fs::is_regular_file(scene::sceneNamed(name)));
    fs::current_path(before);
}

TEST(ShippedScenes, GiveWayToTheUsersFiles) {
    const TemporaryFolder folder;
    folder.write("thesis", "{}");
    const fs::path before = fs::current_path();
    fs::current_path(folder.path());
    EXPECT_EQ(scene::sceneNamed("thesis"), "thesis");
    EXPECT_NE(scene::sceneNamed("thesis.json"), "thesis.json");
    fs::current_path(before);
}

// A scene anywhere names a shipped one as its base, whose files are found, unless a file of its own
// has the name. A suite does the same.
TEST(ShippedScenes, AreBasesByTheirNames) {
    const TemporaryFolder folder;
    const hair::Settings thesis = scene::loadScene(HAIRBENCH_SCENES_DIR "/thesis.json").settings;
    for (const char* name : {"thesis", "thesis.json", "scenes/thesis"}) {
        const scene::Scene own = scene::loadScene(
            folder.write("own.json", R"({"base": ")" + std::string(name) + R"(", "seed": 7})"));
        EXPECT_EQ(own.settings.seed, 7u);
        EXPECT_EQ(own.settings.strands.density, thesis.strands.density);
    }
    const scene::Scene braid =
        scene::loadScene(folder.write("braid.json", R"({"base": "portraits/layers"})"));
    hair::Settings named = braid.settings;
    std::size_t files = 0;
    scene::forEachFileName(named, [&](const std::string& pointer, const std::string& file) {
        EXPECT_TRUE(fs::is_regular_file(braid.directory / file)) << pointer << ": " << file;
        ++files;
    });
    EXPECT_GT(files, 0u);

    folder.write("smoke.json", R"({"seed": 11})");
    EXPECT_EQ(
        scene::loadScene(folder.write("own.json", R"({"base": "smoke.json"})")).settings.seed, 11u);
    const std::vector<scene::Scene> suite =
        scene::loadScenes(folder.write("suite.json", R"({"suite": ["rest", "own.json"]})"));
    ASSERT_EQ(suite.size(), 2u);
    EXPECT_EQ(suite[0].path, scene::sceneNamed("rest"));
    EXPECT_EQ(suite[1].settings.seed, 11u);
    EXPECT_THAT(
        errorText([&] { scene::loadScene(folder.write("own.json", R"({"base": "no_such"})")); }),
        testing::HasSubstr("/base: " + folder.file("no_such").string()));
}

TEST(ShippedScenes, NameFilesOfTheirFolderAlone) {
    for (const auto& entry : fs::recursive_directory_iterator(HAIRBENCH_SCENES_DIR)) {
        const fs::path& path = entry.path();
        if (path.extension() != ".json" || path.string().ends_with(".schema.json") ||
            path.parent_path().filename() == "assets")
            continue;
        EXPECT_EQ(errorText([&] { scene::loadScenes(path); }), "no error") << path;
    }
}

}  // namespace
}  // namespace benchmarks
