#include "benchmarks/viewer/scene_file.h"

#include <cstdio>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "benchmarks/scene/schema.h"
#include "benchmarks/scene/settings_json.h"
#include "benchmarks/scene/sweep.h"
#include "tests/error_text.h"
#include "tests/temporary_folder.h"
#include "tests/viewer/random_settings.h"

namespace benchmarks::viewer {
namespace {

using testing::HasSubstr;

// Returns the words that a POSIX shell reads from a command line.
std::vector<std::string> words(const TemporaryFolder& folder, const std::string& line) {
    const auto script =
        folder.write("words.sh", "for word in " + line + "; do printf '%s\\0' \"$word\"; done\n");
    FILE* const pipe = popen(("sh '" + script.string() + "'").c_str(), "r");
    std::string output;
    for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) output += static_cast<char>(c);
    EXPECT_EQ(pclose(pipe), 0);
    std::vector<std::string> result;
    for (std::size_t at = 0; at < output.size(); at = output.find('\0', at) + 1)
        result.emplace_back(output.c_str() + at);
    return result;
}

// Sorts arguments like the program.
scene::SceneOptions options(const std::vector<std::string>& words) {
    scene::SceneOptions options;
    for (std::size_t i = 0; i + 1 < words.size(); i += 2) {
        EXPECT_TRUE(words[i] == "-a" || words[i] == "--set") << words[i];
        (words[i] == "-a" ? options.axes : options.sets).push_back(words[i + 1]);
    }
    EXPECT_EQ(words.size() % 2, 0u);
    return options;
}

class CaseArguments : public testing::Test {
protected:
    scene::Scene load(std::string_view text) const {
        return scene::loadScene(folder_.write("s.json", text));
    }

    // Returns the cases that `hairbench run` plays, with every asset read.
    std::vector<scene::CaseSpec> cases(scene::Scene scene, const std::string& arguments) const {
        return scene::selectCases(scene, options(words(folder_, arguments)));
    }

    // Expects exactly one case with these settings.
    void expectThese(const scene::Scene& scene, const hair::Settings& settings) const {
        const std::string arguments = caseArguments(scene, settings);
        const auto played = cases(scene, arguments);
        ASSERT_EQ(played.size(), 1u) << arguments;
        EXPECT_EQ(allOf(played.front().settings), allOf(settings)) << arguments;
    }

    std::string error(const scene::Scene& scene, const hair::Settings& settings) const {
        return folder_.relative(errorText([&] { caseArguments(scene, settings); }));
    }

    TemporaryFolder folder_;
};

TEST_F(CaseArguments, AreNoneForTheSceneItself) {
    const scene::Scene scene = load(R"({"strands": {"density": 16}})");
    EXPECT_EQ(caseArguments(scene, scene.settings), "");
}

TEST_F(CaseArguments, NameEveryChangedField) {
    const scene::Scene scene = load("{}");
    hair::Settings settings = scene.settings;
    settings.description = "It's mine";
    settings.groom.file = "a b.hair";
    settings.strands.density = 16;
    settings.strands.backend = hair::Backend::pulling_geometry;
    settings.camera.position = {0.25f, 0.0f, 2.0f};
    settings.simulation.colliders = {{.radius = 0.2f}, {}};
    EXPECT_EQ(
        caseArguments(scene, settings),
        R"(--set '/description="It'\''s mine"' -a '/groom/file="a b.hair"' )"
        R"(--set '/simulation/colliders=[{"radius":0.2},{}]' )"
        R"(-a /strands/backend=pulling_geometry -a /strands/density=16 )"
        R"(-a '/camera/position=[0.25,0,2]')");
}

TEST_F(CaseArguments, GiveTheSettingsBackWhateverTheyAre) {
    const scene::Scene scene = load(R"({"strands": {"density": 16}, "render": {"width": 640}})");
    RandomSettings random(3, 0.02);
    int tried = 0;
    for (int i = 0; i < 400; ++i) {
        const hair::Settings settings = random();
        if (errorText([&] { scene::checkSettings(settings); }) != "no error") continue;
        ++tried;
        const std::string arguments = caseArguments(scene, settings);
        // Does not use selectCases(), because the files in these settings do not exist.
        scene::Scene changed = scene;
        const scene::SceneOptions given = options(words(folder_, arguments));
        for (const std::string& set : given.sets) {
            const scene::Axis field = scene::parseAxis(set);
            ASSERT_EQ(field.values.size(), 1u) << set;
            scene::setField(changed, field.pointer, field.values.front().json());
        }
        std::vector<scene::Axis> axes;
        for (const std::string& axis : given.axes) axes.push_back(scene::parseAxis(axis));
        const auto played = scene::expand(changed, axes);
        ASSERT_EQ(played.size(), 1u) << arguments;
        ASSERT_EQ(allOf(played.front().settings), allOf(settings)) << arguments;
    }
    EXPECT_GT(tried, 100);
}

TEST_F(CaseArguments, AreWhatTheProgramTakes) {
    const scene::Scene scene = scene::loadScene(HAIRBENCH_SCENES_DIR "/rest.json");
    hair::Settings settings = scene.settings;
    expectThese(scene, settings);
    settings.description = "\"Rest\", 50 % of it: $HOME\n[a,b";
    settings.groom.grow.mask = "assets/hairline_mask.png";
    settings.simulation.colliders.pop_back();
    settings.simulation.motion.keyframes = {{}, {.time = 1.0f / 3.0f}};
    settings.shading.lights.clear();
    settings.camera.up = {-0.0f, 1.0f, 0.1f};
    settings.render.background = {0.1f, 0.2f, 0.3f};
    settings.render.hair = false;
    settings.seed = 4294967295u;
    expectThese(scene, settings);
}

TEST_F(CaseArguments, LeaveOneCaseOfASweep) {
    const scene::Scene scene = scene::loadScene(HAIRBENCH_SCENES_DIR "/smoke.json");
    ASSERT_FALSE(scene.axes.empty());
    EXPECT_EQ(caseArguments(scene, scene.settings), "-a /render/msaa=1");
    hair::Settings settings = scene.settings;
    settings.render.msaa = 2;
    settings.strands.density = 8;
    EXPECT_EQ(caseArguments(scene, settings), "-a /render/msaa=2 -a /strands/density=8");
    expectThese(scene, settings);
}

TEST_F(CaseArguments, KnowAxesOfGroupsAndOfListElements) {
    const scene::Scene scene = load(R"({
        "groom": {"grow": {"mesh": ")" HAIRBENCH_SCENES_DIR R"(/assets/head.glb"}},
        "simulation": {"colliders": [{"radius": 1}]},
        "sweep": {"/lod": [{"level": 1}, {"level": 2}],
                  "/simulation/colliders/0/radius": [2, 3]}})");
    hair::Settings settings = scene.settings;
    settings.lod.near_distance = 0.75f;
    settings.simulation.colliders[0].radius = 4.0f;
    settings.simulation.colliders.push_back({});
    expectThese(scene, settings);
}

TEST_F(CaseArguments, AreRefusedWhereTheyWouldSaySomethingElse) {
    const scene::Scene tied = load(R"({"sweep": {"zip": [{"/groom/guides": [10, 86],
                                                   "/strands/tessellation": [8, 4]}]}})");
    EXPECT_THAT(
        error(tied, tied.settings),
        HasSubstr("s.json: the sweep changes /groom/guides together with"));
    const scene::Scene excluding = load(R"({"sweep": {
        "/strands/density": [16, 64], "exclude": [{"/strands/density": [64]}]}})");
    EXPECT_EQ(error(excluding, excluding.settings), "s.json: /sweep/exclude: leaves no case");
    hair::Settings impossible;
    impossible.camera.target = impossible.camera.position;
    EXPECT_THAT(error(load("{}"), impossible), HasSubstr("/camera/target: equals"));
}

}  // namespace
}  // namespace benchmarks::viewer
