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

TEST(Assets, RefusesAFieldOfAnOpenMeshBeforeAnythingRuns) {
    const TemporaryFolder folder;
    folder.write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n");
    const auto scene = folder.write("s.json", "{}");
    const std::string error =
        folder.relative(errorText([&] { scene::checkAssets(withField("open.obj"), scene); }));
    EXPECT_EQ(
        error.substr(0, error.find(", the first")),
        "s.json: /simulation/distance_fields/0: the surface is not closed: edges with one "
        "triangle: 3");
}

TEST(Assets, TakesTheMeshThatHairGrowsOnForAField) {
    const TemporaryFolder folder;
    EXPECT_EQ(
        errorText([&] { scene::checkAssets(withField(""), folder.write("s.json", "{}")); }),
        "no error");
}

TEST(Assets, NamesAMissingMeshOfAField) {
    const TemporaryFolder folder;
    const auto scene = folder.write("s.json", "{}");
    const std::string error =
        folder.relative(errorText([&] { scene::checkAssets(withField("none.obj"), scene); }));
    EXPECT_EQ(error.substr(0, 10), "none.obj: ") << error;
}

}  // namespace
}  // namespace benchmarks
