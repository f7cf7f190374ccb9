// Tests `hairbench lod --reference` as a user runs it.
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/reference_python.h"
#include "tests/cli/run_hairbench.h"
#include "tests/required.h"
#include "tests/temporary_folder.h"

namespace {

using testing::HasSubstr;

class LodReferenceCli : public testing::Test {
protected:
    void SetUp() override {
        if (hairbench("devices").status != 0) return skipWithout(Need::device, "no Vulkan device");
        folder_.write("small.json", R"({
            "base": ")" HAIRBENCH_SCENES_DIR R"(/smoke.json",
            "strands": {"density": 8},
            "shading": {"model": "marschner"},
            "lod": {"maximum_level": 1, "merged": "hairs"},
            "render": {"width": 96, "height": 72},
            "sweep": null
        })");
    }

    std::string quoted(std::string_view name) const {
        return "'" + folder_.file(name).string() + "' ";
    }

    Outcome lod(const std::string& before = "") const {
        return hairbench(
            "lod " + quoted("small.json") +
                "--from 0.5 --to 1 --steps 2 --reference --samples 2 -o " + quoted("lod.json"),
            before);
    }

    TemporaryFolder folder_;
};

TEST_F(LodReferenceCli, ComparesEachLevelUnderEachLight) {
    if (!hasReferencePython()) GTEST_SKIP() << kNoReference;
    const Outcome outcome = lod();
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("path-traced with 2 samples per pixel"));
    const nlohmann::json reference =
        nlohmann::json::parse(textOf(folder_.file("lod.json"))).at("reference");
    EXPECT_EQ(reference.at("samples"), 2);
    const nlohmann::json& levels = reference.at("levels");
    ASSERT_EQ(levels.size(), 2u);
    EXPECT_EQ(levels.at(0).at("coverage"), levels.at(0).at("full_coverage"));
    EXPECT_FALSE(levels.at(0).contains("popping"));
    EXPECT_EQ(levels.at(1).at("full_coverage"), levels.at(0).at("coverage"));
    EXPECT_GT(levels.at(1).at("popping"), 0.0);
    for (const nlohmann::json& level : levels) {
        ASSERT_EQ(level.at("lights").size(), 4u);
        EXPECT_EQ(level.at("lights").at(3).at("angle"), 180.0);
        for (const nlohmann::json& light : level.at("lights")) {
            EXPECT_GT(light.at("flip"), 0.0);
            EXPECT_GT(light.at("light_ratio"), 0.0);
        }
    }
}

TEST_F(LodReferenceCli, SaysAtOnceWhatIsMissing) {
    const Outcome outcome = lod("HAIRBENCH_REFERENCE_PYTHON=/no/such/python ");
    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(outcome.output, HasSubstr("run scripts/setup --reference"));
}

}  // namespace
