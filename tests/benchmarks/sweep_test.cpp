#include "benchmarks/scene/sweep.h"

#include <ctime>

#include <gmock/gmock.h>

#include "tests/error_text.h"
#include "tests/temporary_folder.h"

namespace benchmarks {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class Sweep : public testing::Test {
protected:
    scene::Scene load(std::string_view text) const {
        return scene::loadScene(folder_.write("s.json", text));
    }

    std::vector<std::string>
    names(std::string_view text, std::vector<scene::Axis> overrides = {}) const {
        std::vector<std::string> result;
        for (const scene::CaseSpec& spec : scene::expand(load(text), overrides))
            result.push_back(spec.name);
        return result;
    }

    std::string error(std::string_view text, std::vector<scene::Axis> overrides = {}) const {
        return folder_.relative(errorText([&] { scene::expand(load(text), overrides); }));
    }

private:
    TemporaryFolder folder_;
};

TEST_F(Sweep, IsTheProductWithTheLastAxisFastest) {
    EXPECT_THAT(
        names(R"({"sweep": {"/strands/density": [16, 64], "/lod/level": [2, 0, 1.5]}})"),
        ElementsAre(
            "s/density:16/level:2", "s/density:16/level:0", "s/density:16/level:1.5",
            "s/density:64/level:2", "s/density:64/level:0", "s/density:64/level:1.5"));
}

TEST_F(Sweep, OfNothingIsOneCase) { EXPECT_THAT(names("{}"), ElementsAre("s")); }

TEST_F(Sweep, SetsTheFieldsOfEachCase) {
    const scene::Scene scene = load(R"({
        "strands": {"tessellation": 2},
        "simulation": {"colliders": [{"radius": 1}]},
        "sweep": {"/simulation/colliders/0/radius": [2, 3], "/camera/position/2": [1],
                  "/strands/backend": ["pulling_geometry"], "/camera/target": [[1, 2, 3]]}})");
    const auto cases = scene::expand(scene);
    ASSERT_EQ(cases.size(), 2u);
    const scene::CaseSpec& last = cases[1];
    EXPECT_EQ(last.name, "s/radius:3/position.2:1/backend:pulling_geometry/target:[1,2,3]");
    EXPECT_EQ(last.settings.simulation.colliders[0].radius, 3.0f);
    EXPECT_EQ(last.settings.camera.position, glm::vec3(0.0f, 0.0f, 1.0f));
    EXPECT_EQ(last.settings.camera.target, glm::vec3(1.0f, 2.0f, 3.0f));
    EXPECT_EQ(last.settings.strands.backend, hair::Backend::pulling_geometry);
    EXPECT_EQ(last.settings.strands.tessellation, 2u);
    EXPECT_EQ(last.axes[0].pointer, "/simulation/colliders/0/radius");
    EXPECT_EQ(last.axes[0].value.text(), "3");
    EXPECT_EQ(last.axes[2].value.text(), "\"pulling_geometry\"");
}

TEST_F(Sweep, VariesSeveralFieldsTogetherByAGroup) {
    const auto cases = scene::expand(load(R"({
        "simulation": {"wind": {"gust_rate": 1}},
        "sweep": {"/simulation/wind": [{"strength": 3}, {"strength": 15, "gust_rate": 2}]}})"));
    ASSERT_EQ(cases.size(), 2u);
    EXPECT_EQ(cases[0].name, "s/wind:{\"strength\":3}");
    EXPECT_EQ(cases[0].settings.simulation.wind.strength, 3.0f);
    EXPECT_EQ(cases[0].settings.simulation.wind.gust_rate, 1.0f);
    EXPECT_EQ(cases[1].settings.simulation.wind.gust_rate, 2.0f);
}

TEST_F(Sweep, NamesAxesApart) {
    EXPECT_THAT(
        names(
            R"({"sweep": {"/simulation/global/stiffness": [0], "/simulation/local/stiffness": [1]}})"),
        ElementsAre("s/global.stiffness:0/local.stiffness:1"));
}

TEST_F(Sweep, IsReplacedAndExtendedByOverrides) {
    const char* const scene = R"({"sweep": {"/strands/density": [16, 64], "/render/msaa": [1]}})";
    EXPECT_THAT(
        names(scene, {scene::parseAxis("/strands/density=8"), scene::parseAxis("/lod/level=0,1")}),
        ElementsAre("s/density:8/msaa:1/level:0", "s/density:8/msaa:1/level:1"));
    EXPECT_THAT(
        names("{}", {scene::parseAxis("/camera/position=[0,0,1],[0,0,2]")}),
        ElementsAre("s/position:[0,0,1]", "s/position:[0,0,2]"));
    EXPECT_THAT(
        names("{}", {scene::parseAxis("/seed=1,2"), scene::parseAxis("/seed=3")}),
        ElementsAre("s/seed:3"));
}

TEST_F(Sweep, RefusesBadOverrides) {
    EXPECT_EQ(
        error("{}", {scene::parseAxis("/strands/density=0")}),
        "-a: /strands/density: 0 is outside [1, 4096] count");
    EXPECT_EQ(
        error("{}", {scene::parseAxis("/strands/density=many")}),
        "-a: /strands/density: expected an integer, found the string \"many\"");
    EXPECT_EQ(
        error("{}", {scene::parseAxis("density=1")}),
        "-a: 'density': a JSON pointer starts with '/', as in /strands/density");
    EXPECT_EQ(
        error("{}", {scene::parseAxis("/run/frame=1")}),
        "-a: /run/frame: unknown key (did you mean 'frames'?); known: warmup, frames, "
        "precision, max_time, case_timeout, warmup_time, round_time, frame_time, interpolate, "
        "frames_in_flight, "
        "overlapped_stamps, async_compute, clocks, busy_pass, busy_work, "
        "reference, compare_backends, probes");
    EXPECT_EQ(error("{}", {scene::parseAxis("/seed=1,1")}), "-a: /seed: 1 appears twice");
}

TEST_F(Sweep, RefusesAxesInsideOneAnother) {
    EXPECT_EQ(
        error(R"({"sweep": {"/camera/up/0": [0], "/camera/up": [[0, 1, 0]]}})"),
        "s.json: /camera/up/0: is inside the axis /camera/up");
}

TEST_F(Sweep, RefusesMoreCasesThanAnyoneRuns) {
    std::string values = "0";
    for (int i = 1; i < 400; ++i) values += ',' + std::to_string(i);
    EXPECT_EQ(
        error(
            "{}", {scene::parseAxis("/seed=" + values),
                   scene::parseAxis("/run/frames=" + values + ",400")}),
        "-a: /run/frames: 0 is outside [1, 1000000] count");
    EXPECT_EQ(
        error(
            "{}", {scene::parseAxis("/seed=" + values),
                   scene::parseAxis("/simulation/settle_steps=" + values)}),
        "s.json: /sweep: has more than 100000 cases");
}

std::string listFrom(int first, int count) {
    std::string list = "[" + std::to_string(first);
    for (int i = 1; i < count; ++i) list += ',' + std::to_string(first + i);
    return list + ']';
}

// 2,000 cases and 100 exclusions of 1,000 values make 200 million pairs; a lookup compares none.
TEST_F(Sweep, LooksUpManyExcludedValues) {
    std::string exclude = R"({"/seed": [1, 2]})";
    for (int i = 0; i < 99; ++i)
        exclude += R"(,{"/seed": )" + listFrom(10000 + 1000 * i, 1000) + "}";
    const std::clock_t start = std::clock();
    const auto found = names(
        R"({"sweep": {"/seed": )" + listFrom(0, 2000) + R"(, "exclude": [)" + exclude + "]}}");
    EXPECT_EQ(found.size(), 1998u);
    EXPECT_EQ(found[1], "s/seed:3");
    // Comparing every pair would take a minute.
    EXPECT_LT(std::clock() - start, 20 * CLOCKS_PER_SEC);
}

TEST_F(Sweep, RefusesMoreExclusionsThanAnyoneNeeds) {
    std::string exclude = R"({"/seed": [1]})";
    for (int i = 0; i < 101; ++i) exclude += R"(,{"/seed": )" + listFrom(0, 1000) + "}";
    EXPECT_EQ(
        error(R"({"sweep": {"/seed": [1, 2], "exclude": [)" + exclude + "]}}"),
        "s.json: /sweep/exclude: has 101001 values; at most 100000 are permitted");
}

// Each case copies the points of all edits.
TEST_F(Sweep, RefusesManyCasesOfALargeScene) {
    std::string path = R"({"position": [0, 0, 0]})";
    for (int i = 1; i < 1000; ++i) path += R"(,{"position": [0, 0, 0]})";
    std::string edits = R"({"path": [)" + path + "]}";
    for (int i = 1; i < 20; ++i) edits += R"(,{"path": [)" + path + "]}";
    EXPECT_THAT(
        error(
            R"({"groom": {"edits": [)" + edits + R"(]}, "sweep": {"/seed": )" + listFrom(0, 1000) +
            "}}"),
        HasSubstr("/sweep: 1000 cases of a scene with "));
}

TEST_F(Sweep, ChecksTheRulesBetweenFieldsOfEveryCase) {
    EXPECT_EQ(
        error(R"({"camera": {"near_plane": 2, "far_plane": 1}})"),
        "s.json: /camera/near_plane: is not below /camera/far_plane");
    EXPECT_EQ(
        error(R"({"sweep": {"/camera/far_plane": [10, 0.001]}})"),
        "s.json: s/far_plane:0.001: /camera/near_plane: is not below /camera/far_plane");
    // Every case is valid, although the document without its axes is not.
    EXPECT_EQ(
        error(
            R"({"camera": {"near_plane": 2, "far_plane": 1}, "sweep": {"/camera/far_plane": [10]}})"),
        "no error");
}

TEST_F(Sweep, VariesHowManyGuidesAreChosenFromAFile) {
    EXPECT_EQ(
        error(R"({"groom": {"file": "a.hgl"}, "sweep": {"/groom/guides": [10, 86]}})"), "no error");
}

}  // namespace
}  // namespace benchmarks
