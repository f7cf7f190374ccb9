#include "benchmarks/scene/sweep.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/error_text.h"
#include "tests/temporary_folder.h"

namespace benchmarks {
namespace {

using testing::HasSubstr;

class Suite : public testing::Test {
protected:
    Suite() {
        folder.write("a.json", R"({"seed": 3})");
        folder.write("b.json", R"({"sweep": {"/strands/density": [1, 2]}})");
    }

    std::string error(const std::string& text) {
        return errorText([&] { scene::loadScenes(folder.write("all.json", text)); });
    }

    TemporaryFolder folder;
};

TEST_F(Suite, HasItsScenesInOrder) {
    const auto path = folder.write("all.json", R"({"suite": ["b.json", "a.json"]})");
    EXPECT_TRUE(scene::isSuite(path));
    const std::vector<scene::Scene> scenes = scene::loadScenes(path);
    ASSERT_EQ(scenes.size(), 2u);
    EXPECT_EQ(scenes[0].name, "b");
    EXPECT_EQ(scenes[0].axes.size(), 1u);
    EXPECT_EQ(scenes[1].name, "a");
    EXPECT_EQ(scenes[1].settings.seed, 3u);
    EXPECT_EQ(scenes[1].directory, folder.path());
}

TEST_F(Suite, IsNotOneScene) {
    const auto path = folder.write("all.json", R"({"suite": ["a.json"]})");
    EXPECT_THAT(errorText([&] { scene::loadScene(path); }), HasSubstr("/suite: is a suite"));
}

TEST_F(Suite, OfOneIsAScene) {
    EXPECT_FALSE(scene::isSuite(folder.path() / "a.json"));
    const std::vector<scene::Scene> scenes = scene::loadScenes(folder.path() / "a.json");
    ASSERT_EQ(scenes.size(), 1u);
    EXPECT_EQ(scenes[0].name, "a");
}

TEST_F(Suite, RefusesWhatIsNoListOfScenes) {
    EXPECT_THAT(error(R"({"suite": []})"), HasSubstr("all.json: /suite: expected a list"));
    EXPECT_THAT(error(R"({"suite": "a.json"})"), HasSubstr("/suite: expected a list"));
    EXPECT_THAT(error(R"({"suite": [3]})"), HasSubstr("/suite: expected names"));
    EXPECT_THAT(error(R"({"suite": ["none.json"]})"), HasSubstr("none.json: no such file"));
    EXPECT_THAT(
        error(R"({"suite": ["a.json", "a.json"]})"), HasSubstr("two scenes have the name 'a'"));
    EXPECT_THAT(
        error(R"({"suite": ["a.json"], "seed": 1})"),
        HasSubstr("/seed: unknown key; known: $schema"));
    EXPECT_THAT(error(R"({"suite": ["a.json"], "description": 1})"), HasSubstr("/description: "));
    folder.write("inner.json", R"({"suite": ["a.json"]})");
    EXPECT_THAT(error(R"({"suite": ["inner.json"]})"), HasSubstr("is a suite itself"));
}

}  // namespace
}  // namespace benchmarks
