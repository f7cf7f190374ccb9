#include "benchmarks/viewer/scene_file.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "benchmarks/scene/json.h"
#include "benchmarks/scene/scene.h"
#include "benchmarks/scene/settings_json.h"
#include "tests/error_text.h"
#include "tests/temporary_folder.h"
#include "tests/viewer/random_settings.h"

namespace benchmarks::viewer {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// Every member is compared. Floats use their shortest decimal, which differs for different bits.

std::size_t longestLine(const std::string& text) {
    std::size_t longest = 0;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = text.find('\n', at);
        longest = std::max(longest, end - at);
        at = end + 1;
    }
    return longest;
}

TEST(SceneText, HasNothingToSayOfDefaults) { EXPECT_EQ(sceneText({}, "a", "a"), "{}\n"); }

TEST(SceneText, HasWhatDiffersInTheOrderOfTheTables) {
    hair::Settings settings;
    settings.run.frames = 7;
    settings.description = "A test.";
    settings.strands.backend = hair::Backend::pulling_geometry;
    settings.camera.position = {0.1f, -0.0f, 1.0f / 3.0f};
    settings.simulation.wind.speed = 2.5f;
    settings.simulation.motion.keyframes = {{}, {.time = 0.25f, .rotation = {0, 60, 0}}};
    EXPECT_EQ(sceneText(settings, "a", "a"), R"({
  "description": "A test.",
  "simulation": {
    "wind": { "speed": 2.5 },
    "motion": { "keyframes": [{}, { "time": 0.25, "rotation": [0, 60, 0] }] }
  },
  "strands": { "backend": "pulling_geometry" },
  "camera": { "position": [0.1, -0.0, 0.33333334] },
  "run": { "frames": 7 }
}
)");
}

TEST(SceneText, NamesTheSchemaThatIsBesideIt) {
    const TemporaryFolder folder;
    EXPECT_EQ(sceneText({}, folder.path(), folder.path()), "{}\n");
    folder.write("scene.schema.json", "{}");
    EXPECT_EQ(
        sceneText({}, folder.path(), folder.path()),
        "{\n  \"$schema\": \"scene.schema.json\"\n}\n");
}

TEST(SceneText, ReadsBackBitEqual) {
    RandomSettings random(1, 0.3);
    for (int i = 0; i < 300; ++i) {
        const hair::Settings settings = random();
        const std::string text = sceneText(settings, "a", "a");
        const hair::Settings read = scene::readSettings(scene::parseJson(text, "scene"));
        ASSERT_EQ(allOf(read), allOf(settings)) << text;
    }
}

TEST(SceneText, HasLinesOfAHundredColumns) {
    RandomSettings random(2, 0.5);
    for (int i = 0; i < 100; ++i) {
        // The longest unbreakable item is a vector of three numbers of 15 characters.
        EXPECT_LE(longestLine(sceneText(random(), "a", "a")), 100u);
    }
}

class MovedFiles : public testing::Test {
protected:
    // Returns settings in which every file name is set.
    static hair::Settings named(const std::string& name) {
        hair::Settings settings;
        settings.groom.file = settings.groom.mesh = settings.groom.grow.mesh = name;
        settings.groom.grow.mask = settings.groom.grow.length_map = name;
        settings.strands.offsets = settings.strands.texture = name;
        settings.render.environment = settings.run.reference = name;
        settings.render.meshes = {{.file = name}, {.file = name}};
        settings.simulation.distance_fields = {{.mesh = name}};
        return settings;
    }

    // Returns the common file name in the settings after a move.
    std::string moved(const std::string& name, const fs::path& from, const fs::path& to) const {
        const hair::Settings result = movedFiles(named(name), from, to);
        EXPECT_EQ(allOf(result), allOf(named(result.groom.file)));
        return result.groom.file;
    }

    TemporaryFolder folder_;
};

TEST_F(MovedFiles, StayTheSameFiles) {
    const fs::path file = folder_.write("scenes/assets/a.hair", "");
    const fs::path from = folder_.file("scenes");
    EXPECT_EQ(moved("assets/a.hair", from, folder_.path()), "scenes/assets/a.hair");
    EXPECT_EQ(moved("assets/a.hair", from, folder_.file("scenes/assets")), "a.hair");
    EXPECT_EQ(moved("assets/a.hair", from, folder_.file("out/new")), "../../scenes/assets/a.hair");
    EXPECT_EQ(moved("./assets/../assets/a.hair", from, folder_.path()), "scenes/assets/a.hair");
    EXPECT_EQ(moved("./assets/a.hair", from, from), "./assets/a.hair");
}

TEST_F(MovedFiles, LeaveAbsoluteAndEmptyNames) {
    EXPECT_EQ(moved("/x/a.hair", folder_.path(), folder_.file("b")), "/x/a.hair");
    EXPECT_EQ(moved("", folder_.path(), folder_.file("b")), "");
}

TEST_F(MovedFiles, AreFoundThroughLinks) {
    const fs::path file = folder_.write("deep/scenes/a.hair", "");
    fs::create_directories(folder_.file("other/place"));
    fs::create_directory_symlink(folder_.file("deep/scenes"), folder_.file("linked"));
    fs::create_directory_symlink(folder_.file("other/place"), folder_.file("target"));
    const std::string name = moved("a.hair", folder_.file("linked"), folder_.file("target"));
    EXPECT_TRUE(fs::equivalent(folder_.file("target") / name, file)) << name;
}

TEST_F(MovedFiles, AreRelativeToTheWorkingFolderWhereAFolderIsEmpty) {
    EXPECT_EQ(moved("a.hair", "", "."), "a.hair");
    EXPECT_EQ(moved("a.hair", "", "x"), "../a.hair");
    EXPECT_EQ(moved("a.hair", "x", ""), "x/a.hair");
}

TEST(SaveScene, IsReadAsTheSettingsWithFilesInTheirPlace) {
    const TemporaryFolder folder;
    folder.write("scenes/hair/a.hair", "");
    hair::Settings settings;
    settings.groom.file = "hair/a.hair";
    settings.groom.guides = 12;
    const fs::path file = folder.file("kept/new/b.json");
    saveScene(settings, folder.file("scenes"), file);
    const scene::Scene scene = scene::loadScene(file, scene::Outside::allowed);
    EXPECT_EQ(scene.settings.groom.guides, 12u);
    EXPECT_EQ(scene.settings.groom.file, "../../scenes/hair/a.hair");
    EXPECT_TRUE(fs::equivalent(
        scene.directory / scene.settings.groom.file, folder.file("scenes/hair/a.hair")));
    EXPECT_TRUE(scene.axes.empty());
    // Defaults are also relative to the scene, so they are written if the move changes them.
    EXPECT_EQ(scene.settings.groom.grow.mesh, "../../scenes/assets/head.glb");
}

TEST(SaveScene, SaysWhatItCannotWrite) {
    const TemporaryFolder folder;
    EXPECT_THAT(
        errorText([&] { saveScene({}, folder.path(), folder.path()); }),
        HasSubstr(folder.path().string() + ": is a folder"));
    folder.write("file", "");
    EXPECT_THAT(
        errorText([&] { saveScene({}, folder.path(), folder.file("file/a.json")); }),
        HasSubstr(folder.file("file").string() + ": "));
}

}  // namespace
}  // namespace benchmarks::viewer
