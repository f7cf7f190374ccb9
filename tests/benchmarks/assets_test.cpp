#include "benchmarks/measure/case.h"
#include "benchmarks/scene/assets.h"

#include <gtest/gtest.h>

#include "tests/error_text.h"
#include "tests/temporary_folder.h"

namespace benchmarks {
namespace {

hair::Settings withField(const std::string& mesh) {
    hair::Settings settings;
    settings.groom.grow.mesh = HAIRBENCH_SCENES_DIR "/assets/head.glb";
    settings.simulation.distance_fields = {{.mesh = mesh}};
    return settings;
}

TEST(Assets, WarnsOfAFieldOfAnOpenMeshBeforeAnythingRuns) {
    const TemporaryFolder folder;
    folder.write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n");
    const auto warnings = scene::checkAssets(withField("open.obj"), folder.write("s.json", "{}"));
    ASSERT_EQ(warnings.size(), 1u);
    const std::string warning = folder.relative(warnings.front());
    EXPECT_EQ(
        warning.substr(0, warning.find(", the first")),
        "s.json: /simulation/distance_fields/0: the surface is not closed: edges with one "
        "triangle: 3");
}

TEST(Assets, RefusesAFieldOfAMeshThatEnclosesNothing) {
    const TemporaryFolder folder;
    folder.write("plane.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const auto scene = folder.write("s.json", "{}");
    const std::string error =
        folder.relative(errorText([&] { scene::checkAssets(withField("plane.obj"), scene); }));
    EXPECT_EQ(
        error.substr(0, error.find(" 0.")),
        "s.json: /simulation/distance_fields/0: the surface encloses nothing: its winding number "
        "is at most");
}

TEST(Assets, TakesTheMeshThatHairGrowsOnForAField) {
    const TemporaryFolder folder;
    EXPECT_TRUE(scene::checkAssets(withField(""), folder.write("s.json", "{}")).empty());
}

TEST(Assets, NamesAMissingMeshOfAField) {
    const TemporaryFolder folder;
    const auto scene = folder.write("s.json", "{}");
    const std::string error =
        folder.relative(errorText([&] { scene::checkAssets(withField("none.obj"), scene); }));
    EXPECT_EQ(error.substr(0, 10), "none.obj: ") << error;
}

hair::Settings animated(const std::string& clip) {
    hair::Settings settings;
    settings.groom.grow.mesh = HAIRBENCH_SCENES_DIR "/assets/head_talk.glb";
    settings.simulation.animation.clip = clip;
    return settings;
}

TEST(Assets, WarnsOfAnimationsThatNobodyPlays) {
    const TemporaryFolder folder;
    const auto scene = folder.write("s.json", "{}");
    const auto warnings = scene::checkAssets(animated(""), scene);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(
        folder.relative(warnings.front()),
        "s.json: /simulation/animation/clip: is empty, so nothing plays the animations "
        "of " HAIRBENCH_SCENES_DIR "/assets/head_talk.glb: 'talk'");
    EXPECT_TRUE(scene::checkAssets(animated("talk"), scene).empty());
}

TEST(Assets, WarnsOfAFieldThatKeepsItsShape) {
    const TemporaryFolder folder;
    hair::Settings settings = animated("talk");
    settings.simulation.distance_fields.resize(1);
    const auto scene = folder.write("s.json", "{}");
    const auto warnings = scene::checkAssets(settings, scene);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(
        folder.relative(warnings.front())
            .find("s.json: /simulation/distance_fields/0: keeps its shape"),
        0u);
    settings.simulation.distance_fields[0].follows = hair::Follows::world;
    EXPECT_TRUE(scene::checkAssets(settings, scene).empty());
}

TEST(Assets, NamesTheClipsThatThereAre) {
    const TemporaryFolder folder;
    const auto scene = folder.write("s.json", "{}");
    EXPECT_EQ(
        errorText([&] { scene::checkAssets(animated("walk"), scene); }),
        HAIRBENCH_SCENES_DIR "/assets/head_talk.glb: has no animation 'walk'; known: 'talk'");
}

}  // namespace
}  // namespace benchmarks
