#include "benchmarks/scene/schema.h"

#include <filesystem>

#include <gmock/gmock.h>

#include "benchmarks/doctor/reports.h"
#include "benchmarks/scene/settings_json.h"
#include "benchmarks/scene/sweep.h"
#include "tests/edited_document.h"
#include "tests/error_text.h"
#include "tests/temporary_folder.h"

namespace benchmarks {
namespace {

using testing::IsEmpty;
using testing::Not;

const std::filesystem::path kScenes = HAIRBENCH_SCENES_DIR;

std::vector<std::filesystem::path> committedScenes() {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(kScenes))
        if (entry.path().extension() == ".json" && entry.path().stem().extension() != ".schema")
            paths.push_back(entry.path());
    return paths;
}

TEST(SceneSchema, IsTheCommittedOne) {
    EXPECT_TRUE(textOf(kScenes / "scene.schema.json") == scene::sceneSchema())
        << "write it anew: hairbench schema > scenes/scene.schema.json";
}

TEST(FieldReference, IsTheCommittedOne) {
    EXPECT_TRUE(textOf(HAIRBENCH_SOURCE_DIR "/docs/fields.md") == scene::fieldReference(kScenes))
        << "write it anew: hairbench schema --markdown scenes > docs/fields.md";
}

// By hand, from the tables and scenes.
TEST(FieldReference, SaysWhatAFieldIs) {
    const TemporaryFolder folder;
    folder.write(
        "long.json", R"({"strands": {"density": 8}, "description": "longer than the other"})");
    folder.write("short.json", R"({"sweep": {"/strands/density": [8, 16]}})");
    folder.write("lights.json", R"({"shading": {"lights": [{"power": 3}]}})");
    const std::string page = scene::fieldReference(folder.path());
    EXPECT_THAT(page, testing::HasSubstr("\n## `/strands`: "));
    EXPECT_THAT(
        page, testing::ContainsRegex(
                  "\n\\| `/strands/density` \\| 1 to 4096, whole \\| count \\| `64` \\| [^|]+ \\| "
                  "\\[short.json\\]\\(../scenes/short.json\\) \\|\n"));
    EXPECT_THAT(page, testing::HasSubstr("\n## `/shading/lights/N`: "));
    EXPECT_THAT(page, testing::Not(testing::HasSubstr("`/sweep")));
}

TEST(CommittedScenes, FitTheSchemaAndExpand) {
    EXPECT_THAT(committedScenes(), Not(IsEmpty()));
    for (const auto& path : committedScenes()) {
        EXPECT_THAT(report::schemaErrors(scene::sceneSchema(), textOf(path)), IsEmpty()) << path;
        const auto expand_all = [&] {
            for (const scene::Scene& scene : scene::loadScenes(path)) scene::expand(scene);
        };
        EXPECT_EQ(errorText(expand_all), "no error");
    }
}

// An axis sets its field alone; the reference reads the whole document of the case.
TEST(CommittedScenes, HaveTheCasesOfTheirDocuments) {
    std::size_t cases = 0;
    for (const auto& path : committedScenes())
        for (const scene::Scene& scene : scene::loadScenes(path))
            for (const scene::CaseSpec& each : scene::expand(scene)) {
                scene::Json document = scene.resolved.json();
                for (const scene::AxisValue& axis : each.axes)
                    editDocument(document, axis.pointer, axis.value.json());
                ASSERT_EQ(
                    scene::writeSettings(each.settings).dump(),
                    scene::writeSettings(scene::readSettings(document)).dump())
                    << path << ": " << each.name;
                ++cases;
            }
    EXPECT_GT(cases, 300u);
}

TEST(CommittedScenes, SweepWhatTheThesisCaseNeeds) {
    const auto cases = scene::expand(scene::loadScene(kScenes / "thesis.json"));
    EXPECT_EQ(cases.size(), 243u);  // 3 guide counts x 3 densities x 3 factors x 3 MSAA x 3 levels
    EXPECT_EQ(cases.front().name, "thesis/guides:86/density:16/tessellation:1/msaa:1/level:0");
    EXPECT_EQ(scene::expand(scene::loadScene(kScenes / "smoke.json")).size(), 2u);
    for (const char* name :
         {"rest", "guides_overlay", "other_camera", "weak_wind", "strong_wind",
          "strong_wind_guides"})
        EXPECT_EQ(
            scene::expand(scene::loadScene(kScenes / (std::string(name) + ".json"))).size(), 1u)
            << name;
}

class BadDocument : public testing::TestWithParam<const char*> {};

// The schema also refuses everything that the reader refuses, as far as a schema can express it.
TEST_P(BadDocument, BreaksTheSchema) {
    EXPECT_THAT(report::schemaErrors(scene::sceneSchema(), GetParam()), Not(IsEmpty()));
    const TemporaryFolder folder;
    const auto path = folder.write("s.json", GetParam());
    EXPECT_NE(errorText([&] { scene::loadScene(path); }), "no error");
}

INSTANTIATE_TEST_SUITE_P(
    SceneSchema, BadDocument,
    testing::Values(
        "[]", R"({"densty": 1})", R"({"strands": {"densty": 1}})", R"({"strands": 3})",
        R"({"strands": {"density": "64"}})", R"({"strands": {"density": 0}})",
        R"({"strands": {"density": 4097}})", R"({"strands": {"density": 2.5}})",
        R"({"strands": {"curve": "x"}})", R"({"render": {"msaa": 3}})",
        R"({"render": {"head": 1}})", R"({"groom": {"file": 1}})", R"({"camera": {"up": [0, 1]}})",
        R"({"camera": {"up": [0, 1, 2]}})", R"({"simulation": {"colliders": [{"r": 1}]}})",
        R"({"simulation": {"colliders": [{"radius": null}]}})", R"({"base": 1})",
        R"({"$schema": 1})", R"({"sweep": []})", R"({"sweep": {"strands": [1]}})",
        R"({"sweep": {"/strands/density": 1}})", R"({"sweep": {"/strands/density": []}})",
        R"({"sweep": {"/strands/density": [0]}})", R"({"sweep": {"/render/msaa": [1, 1]}})",
        R"({"sweep": {"zip": {}}})", R"({"sweep": {"zip": [{}]}})",
        R"({"sweep": {"zip": [{"/seed": 1}]}})", R"({"sweep": {"cases": [{"seed": 1}]}})",
        R"({"sweep": {"exclude": [{"/seed": []}]}})", R"({"sweep": {"product": [1]}})"));

TEST(SceneSchema, AcceptsWhatTheReaderAccepts) {
    for (
        const char* text :
        {"{}", R"({"sweep": {"/simulation/wind": [{"strength": 3}], "/camera/up/1": [1]}})",
         R"({"sweep": {"zip": [{"/seed": [1, 2], "/render/msaa": [1, 4]}],
                       "cases": [{"/strands/density": 2}, {"/lod/level": 1}],
                       "exclude": [{"/seed": [1], "/lod/level": [0, 1]}]}})",
         R"({"simulation": {"colliders": [{"a": [0, 0, 0], "radius": 1}, {}]}, "render": {"msaa": 8}})"}) {
        EXPECT_THAT(report::schemaErrors(scene::sceneSchema(), text), IsEmpty()) << text;
        const TemporaryFolder folder;
        EXPECT_EQ(errorText([&] { scene::loadScene(folder.write("s.json", text)); }), "no error");
    }
}

TEST(SceneSchema, AcceptsRemovals) {
    EXPECT_THAT(
        report::schemaErrors(
            scene::sceneSchema(),
            R"({"base": "a.json", "groom": null, "strands": {"curve": null, "density": null},
                                 "render": {"msaa": null}, "camera": {"up": null}, "sweep": null})"),
        IsEmpty());
}

}  // namespace
}  // namespace benchmarks
