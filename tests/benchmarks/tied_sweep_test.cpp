#include <gmock/gmock.h>

#include "benchmarks/scene/sweep.h"
#include "tests/error_text.h"
#include "tests/temporary_folder.h"

namespace benchmarks {
namespace {

using testing::ElementsAre;

// Tests sweeps with "zip", "cases" and "exclude".
class TiedSweep : public testing::Test {
protected:
    scene::Scene load(const std::string& sweep) const {
        return scene::loadScene(folder_.write("s.json", R"({"sweep": )" + sweep + "}"));
    }

    std::vector<std::string>
    names(const std::string& sweep, const std::vector<scene::Axis>& overrides = {}) const {
        std::vector<std::string> result;
        for (const scene::CaseSpec& spec : scene::expand(load(sweep), overrides))
            result.push_back(spec.name);
        return result;
    }

    std::string
    error(const std::string& sweep, const std::vector<scene::Axis>& overrides = {}) const {
        return folder_.relative(errorText([&] { scene::expand(load(sweep), overrides); }));
    }

private:
    TemporaryFolder folder_;
};

constexpr const char* kZip =
    R"({"/render/msaa": [1, 4],
        "zip": [{"/groom/guides": [10, 10, 86], "/strands/density": [64, 16, 16.0]}]})";

TEST_F(TiedSweep, ZipsFieldsInStep) {
    EXPECT_THAT(
        names(kZip), ElementsAre(
                         "s/msaa:1/guides:10/density:64", "s/msaa:1/guides:10/density:16",
                         "s/msaa:1/guides:86/density:16", "s/msaa:4/guides:10/density:64",
                         "s/msaa:4/guides:10/density:16", "s/msaa:4/guides:86/density:16"));
    const scene::CaseSpec spec = scene::expand(load(kZip))[2];
    EXPECT_EQ(spec.settings.groom.guides, 86u);
    EXPECT_EQ(spec.settings.strands.density, 16u);
    ASSERT_EQ(spec.axes.size(), 3u);
    EXPECT_EQ(spec.axes[2].pointer, "/strands/density");
    EXPECT_EQ(spec.axes[2].value.text(), "16");
}

TEST_F(TiedSweep, HasAnAxisForEachZip) {
    EXPECT_THAT(
        names(R"({"zip": [{"/seed": [1, 2], "/lod/level": [0, 1]}, {"/render/msaa": [1, 4]}]})"),
        ElementsAre(
            "s/seed:1/level:0/msaa:1", "s/seed:1/level:0/msaa:4", "s/seed:2/level:1/msaa:1",
            "s/seed:2/level:1/msaa:4"));
}

TEST_F(TiedSweep, ListsCasesAndFillsInTheScenesValues) {
    // The default of /render/msaa is 1.
    EXPECT_THAT(
        names(R"({"cases": [{"/strands/density": 16, "/render/msaa": 4}, {"/strands/density": 64}],
                  "/seed": [1, 2]})"),
        ElementsAre(
            "s/density:16/msaa:4/seed:1", "s/density:16/msaa:4/seed:2",
            "s/density:64/msaa:1/seed:1", "s/density:64/msaa:1/seed:2"));
}

TEST_F(TiedSweep, LeavesOutWhatMeetsEveryConditionOfAnExclusion) {
    EXPECT_THAT(
        names(R"({"/strands/density": [16, 64], "/render/msaa": [1, 4, 8],
                  "exclude": [{"/strands/density": [64.0], "/render/msaa": [4, 8]},
                              {"/strands/density": [16], "/render/msaa": [1]}]})"),
        ElementsAre("s/density:16/msaa:4", "s/density:16/msaa:8", "s/density:64/msaa:1"));
}

TEST_F(TiedSweep, ExcludesByWhatAGroupSets) {
    EXPECT_THAT(
        names(R"({"/simulation/wind": [{"strength": 3.0}, {"strength": 5}],
                  "exclude": [{"/simulation/wind/strength": [3]}]})"),
        ElementsAre("s/wind:{\"strength\":5}"));
}

TEST_F(TiedSweep, DoesNotCheckRulesBetweenFieldsOfExcludedCases) {
    const std::string planes = R"("/camera/near_plane": [0.1, 2], "/camera/far_plane": [1, 10])";
    EXPECT_EQ(
        error("{" + planes + "}"),
        "s.json: s/near_plane:2/far_plane:1: /camera/near_plane: is not below /camera/far_plane");
    EXPECT_THAT(
        names(
            "{" + planes +
            R"(, "exclude": [{"/camera/near_plane": [2], "/camera/far_plane": [1]}]})"),
        ElementsAre(
            "s/near_plane:0.1/far_plane:1", "s/near_plane:0.1/far_plane:10",
            "s/near_plane:2/far_plane:10"));
}

TEST_F(TiedSweep, ExcludesNothingWhereNothingIsSwept) {
    EXPECT_THAT(names(R"({"exclude": [{"/render/msaa": [1]}]})"), ElementsAre("s"));
    EXPECT_EQ(
        error(R"({"/seed": [1], "exclude": [{"/render/msaa": [1]}]})"),
        "s.json: /sweep/exclude: leaves no case");
}

TEST_F(TiedSweep, IsChangedFromTheCommandLine) {
    EXPECT_THAT(
        names(kZip, {scene::parseAxis("/render/msaa=8")}),
        ElementsAre(
            "s/msaa:8/guides:10/density:64", "s/msaa:8/guides:10/density:16",
            "s/msaa:8/guides:86/density:16"));
    EXPECT_EQ(
        error(kZip, {scene::parseAxis("/strands/density=8")}),
        "-a: /strands/density: the scene's sweep changes it together with other fields");
}

TEST_F(TiedSweep, RefusesWhatDoesNotFit) {
    const std::pair<const char*, const char*> errors[] = {
        {R"({"zip": {}})", "/sweep/zip: expected an array, found an object"},
        {R"({"zip": [3]})", "/sweep/zip/0: expected an object with fields, found 3"},
        {R"({"zip": [{}]})", "/sweep/zip/0: expected an object with fields, found an object"},
        {R"({"zip": [{"/seed": [1, 2], "/render/msaa": [1]}]})",
         "/sweep/zip/0: /render/msaa: 1 values, but /seed has 2"},
        {R"({"zip": [{"/seed": [1], "/render/msaa": 1}]})",
         "/sweep/zip/0: /render/msaa: expected an array of values, found 1"},
        {R"({"zip": [{"/seed": [1], "/strands/density": [0]}]})",
         "/sweep/zip/0: /strands/density: 0 is outside [1, 4096] count"},
        {R"({"zip": [{"/seed": [1, 1], "/render/msaa": [4, 4]}]})",
         "s/seed:1/msaa:4: two cases have this name"},
        {R"({"/seed": [1], "zip": [{"/seed": [1], "/render/msaa": [4]}]})",
         "/seed: is swept twice"},
        {R"({"/camera/up": [[0, 1, 0]], "zip": [{"/seed": [1], "/camera/up/0": [1]}]})",
         "/camera/up/0: is inside the axis /camera/up"},
        {R"({"cases": []})", "/sweep/cases: a list needs at least one case"},
        {R"({"cases": [{"/seed": 1}, {"/render/msaa": 3}]})",
         "/sweep/cases/1: /render/msaa: 3 is not one of 1, 2, 4, 8 samples"},
        {R"({"exclude": [{"/seed": 1}]})",
         "/sweep/exclude/0: /seed: expected an array of values, found 1"},
        {R"({"exclude": [{"/camera": [{}]}]})",
         "/sweep/exclude/0: /camera: a condition must name a single field, not a group"}};
    for (const auto& [sweep, expected] : errors)
        EXPECT_EQ(error(sweep), std::string("s.json: ") + expected) << sweep;
}

}  // namespace
}  // namespace benchmarks
