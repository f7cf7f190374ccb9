// Tests the program as a user runs it: its exit status, its one-line errors, and the files that it
// writes or leaves alone.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <optional>
#include <string>
#include <system_error>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/run_hairbench.h"
#include "tests/required.h"
#include "tests/temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

constexpr int kNothingRan = 14;  // exit status

nlohmann::json reportOf(const fs::path& path) { return nlohmann::json::parse(textOf(path)); }

bool hasDevice() {
    static const bool found = hairbench("devices").status == 0;
    return found;
}

TEST(Cli, HelpShowsExamplesAndExitStatuses) {
    const Outcome outcome = hairbench("--help");
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(outcome.output, HasSubstr("hairbench run scenes/thesis.json"));
    EXPECT_THAT(outcome.output, HasSubstr("77 no suitable device"));
}

TEST(Cli, VersionIsOneLine) {
    const Outcome outcome = hairbench("--version");
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(outcome.output, testing::MatchesRegex("hairbench [0-9]+\\.[0-9]+\\.[0-9]+.*\n"));
}

TEST(Cli, SchemaIsTheCommittedOne) {
    const Outcome outcome = hairbench("schema");
    EXPECT_EQ(outcome.status, 0);
    const std::string committed = textOf(fs::path(HAIRBENCH_SCENES_DIR) / "scene.schema.json");
    EXPECT_TRUE(outcome.output == committed) << "hairbench schema > scenes/scene.schema.json";
}

// A failure to write the output is an error.
TEST(Cli, FailsWhereStandardOutputIsClosedOrFull) {
    const std::string hair = shippedScene("truth/cantilever.obj");
    for (const std::string& command :
         {std::string("--help"), std::string("--version"), std::string("schema"),
          "groom info " + hair, "validate " + shippedScene("smoke.json")}) {
        EXPECT_EQ(hairbench(command).status, 0) << command;
        for (const char* stream : {" >/dev/full", " >&-"}) {
            const Outcome outcome =
                runInShell("'" HAIRBENCH_PROGRAM "' " + command + " 2>&1" + stream);
            EXPECT_EQ(outcome.status, 1) << command << stream;
            EXPECT_EQ(outcome.output, "hairbench: standard output can't be written\n")
                << command << stream;
        }
    }
}

TEST(Cli, TakesFiniteNumbersOnly) {
    for (const char* command :
         {"run @ --max-time nan", "run @ --max-time inf", "run @ --precision NaN",
          "run @ --precision nan%", "groom info @ --scale nan", "groom fix @ x.obj --scale nan",
          "gate @ @ --scene @ --threshold nan", "lod @ --from nan"}) {
        std::string line = command;
        for (std::size_t at; (at = line.find('@')) != std::string::npos;)
            line.replace(at, 1, shippedScene("smoke.json"));
        const Outcome outcome = hairbench(line);
        EXPECT_EQ(outcome.status, 2) << command << outcome.output;
        EXPECT_THAT(
            outcome.output,
            testing::AnyOf(HasSubstr("is not finite"), HasSubstr("is not a percentage")))
            << command;
    }
}

// The error comes before the run, not after it.
TEST(Cli, SaysAtOnceThatANameCannotBeWritten) {
    const TemporaryFolder folder;
    fs::create_symlink("loop.json", folder.file("loop.json"));
    for (const auto& [name, reason] :
         {std::pair{std::string(300, 'a'), "File name too long"},
          {std::string(250, 'a'), "File name too long"},  // once ".journal" is added
          {std::string("loop.json"), "Too many levels of symbolic links"}}) {
        const Outcome outcome = hairbenchErrors(
            "run " + shippedScene("smoke.json") + " -o '" + folder.file(name).string() + "'");
        EXPECT_EQ(outcome.status, 2) << name;
        EXPECT_THAT(outcome.output, HasSubstr(reason)) << name;
        EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
    }
}

// A stranger may have named the files and cases. A line break and a colour in a name could forge a
// line of the program's output.
TEST(Cli, ShowsTextsOfFilesOnOneLine) {
    const TemporaryFolder folder;
    const std::string forged = "a\n\x1b[32mhairbench: ok\u202e";
    const std::string escaped = "a\\n\\u001b[32mhairbench: ok\\u202e";
    folder.write(forged + ".json", R"({"base": ")" HAIRBENCH_SCENES_DIR R"(/smoke.json"})");
    folder.write("wrong.json", R"({"groom": {"file": ")" + escaped + R"(.ply"}})");
    folder.write("base.json", R"({"base": ")" + escaped + R"("})");
    folder.write("suite.json", R"({"suite": [")" + escaped + R"("]})");
    folder.write(
        "axis.json",
        R"({"sweep": {"/shading/model": [")" + escaped + R"("]}, "description": "x"})");
    for (const std::string& name :
         {forged + ".json", std::string("wrong.json"), std::string("base.json"),
          std::string("suite.json"), std::string("axis.json")}) {
        const Outcome outcome = runInShell(
            "'" HAIRBENCH_PROGRAM "' validate '" + folder.file(name).string() + "' 2>&1");
        EXPECT_THAT(outcome.output, HasSubstr("hairbench: ok"));
        EXPECT_EQ(outcome.output.find('\x1b'), std::string::npos) << name;
        EXPECT_EQ(outcome.output.find("\u202e"), std::string::npos) << name;
        EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
    }
}

// A message has at most 500 bytes. A longer one keeps its beginning and its end.
TEST(Cli, MessagesAreShort) {
    const TemporaryFolder folder;
    const std::string text =
        R"({"groom": {"file": ")" + std::string(100000, 'a') + R"(/\u00e9.ply"}})";
    const std::string scene = folder.write("s.json", text).string();
    for (const char* command : {"validate ", "run "}) {
        const Outcome outcome = hairbench(command + scene);
        EXPECT_EQ(outcome.status, 2);
        EXPECT_LE(outcome.output.size(), 500u);
        EXPECT_THAT(outcome.output, HasSubstr("aaa [...] aaa"));
        EXPECT_THAT(outcome.output, HasSubstr("/\u00e9.ply"));
    }
}

TEST(Cli, ListsTheWholeSweep) {
    const Outcome outcome = hairbench("run " + shippedScene("thesis.json") + " --list");
    EXPECT_EQ(outcome.status, 0);
    // 3 guide counts x 3 densities x 3 tessellation factors x 3 sample counts x 3 levels.
    EXPECT_THAT(outcome.output, HasSubstr("243 cases"));
    EXPECT_THAT(
        outcome.output, HasSubstr("thesis/guides:86/density:64/tessellation:4/msaa:1/level:0\n"));
}

TEST(Cli, DryRunEstimatesAndWritesNothing) {
    if (!hasDevice()) return skipWithout(Need::device, "no Vulkan device");
    const TemporaryFolder folder;
    const fs::path out = folder.path() / "report.json";
    const Outcome outcome =
        hairbench("run " + shippedScene("smoke.json") + " --dry-run --out '" + out.string() + "'");
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(outcome.output, HasSubstr("memory"));
    EXPECT_THAT(outcome.output, testing::ContainsRegex("smoke/msaa:4 +[0-9.]+ MB +[0-9.]+ "));
    EXPECT_THAT(outcome.output, testing::ContainsRegex("2 cases, at most [0-9.]+ MB at a time"));
    EXPECT_FALSE(fs::exists(out));
}

TEST(Cli, SkipsCasesThatNeedMoreMemoryThanTheyMayTake) {
    if (!hasDevice()) return skipWithout(Need::device, "no Vulkan device");
    const TemporaryFolder folder;
    const std::string smoke = "run " + shippedScene("smoke.json");
    const Outcome estimated = hairbench(smoke + " --dry-run --max-memory 1M");
    EXPECT_EQ(estimated.status, 0);
    EXPECT_THAT(
        estimated.output,
        testing::ContainsRegex("smoke/msaa:4 +at most [0-9.]+ MB .*needs about [0-9.]+ [MG]B of "
                               "[a-z ]*memory; 1.05 MB are free .--max-memory."));
    const Outcome run =
        hairbench(smoke + " --max-memory 1M -o '" + folder.file("r.json").string() + "'");
    EXPECT_EQ(run.status, 14);
    EXPECT_THAT(run.output, HasSubstr("skipped: needs about "));
    const Outcome wrong = hairbench(smoke + " --max-memory lots");
    EXPECT_EQ(wrong.status, 2);
    EXPECT_THAT(wrong.output, HasSubstr("'lots' is not a size, as in 500M or 2G"));
}

TEST(Cli, SetsFieldsWithoutNamingCasesAfterThem) {
    const Outcome outcome =
        hairbench("run " + shippedScene("smoke.json") + " --set /strands/density=8 --list");
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.output, "smoke/msaa:1\nsmoke/msaa:4\n2 cases\n");
    const Outcome unknown =
        hairbench("run " + shippedScene("smoke.json") + " --set /no/such=1 --list");
    EXPECT_EQ(unknown.status, 2);
    EXPECT_THAT(unknown.output, HasSubstr("--set /no/such=1: "));
    EXPECT_EQ(hairbench("run " + shippedScene("smoke.json") + " --set density --list").status, 2);
}

// ---- Refusals: one line, status 2, no file written ----------------------------------------------

struct Refusal {
    const char* name;
    const char* file;  // content of the scene file; null: no file
    const char* reason;
};

class CliRefusal : public testing::TestWithParam<Refusal> {};

TEST_P(CliRefusal, IsOneLineWithStatus2AndWritesNothing) {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "scene.json";
    if (GetParam().file) folder.write("scene.json", GetParam().file);
    folder.write("bald.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl skin\nf 1 2 3\n");
    folder.write("short.hgl", std::string("\2\0\0\0\1\0\0\0\0\0\0\0 cut", 16));
    folder.write("lies.hgl", std::string("\xff\xff\xff\x7f\1\0\0\0\0\0\0\0", 12));
    const fs::path out = folder.path() / "out" / "report.json";
    const Outcome outcome = hairbench("run '" + path.string() + "' --out '" + out.string() + "'");
    EXPECT_EQ(outcome.status, 2) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr(GetParam().reason));
    EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
    EXPECT_FALSE(fs::exists(out.parent_path()));
}

INSTANTIATE_TEST_SUITE_P(
    , CliRefusal,
    testing::Values(
        Refusal{"MissingScene", nullptr, "scene.json: no such file"},
        Refusal{"BrokenJson", "{\"strands\": {", "scene.json:"},
        Refusal{"UnknownKey", R"({"strands": {"densty": 3}})", "/strands/densty: unknown key"},
        Refusal{"OutOfRange", R"({"strands": {"density": 0}})", "/strands/density: 0 is outside"},
        Refusal{"WrongType", R"({"render": {"width": "wide"}})", "/render/width: "},
        Refusal{"MissingMesh", R"({"groom": {"grow": {"mesh": "none.glb"}}})", "none.glb"},
        Refusal{
            "MeshWithoutScalp", R"({"groom": {"grow": {"mesh": "bald.obj"}}})",
            "nothing in the mesh is named 'scalp'"},
        Refusal{"GuideFileCutShort", R"({"groom": {"file": "short.hgl"}})", "short.hgl"},
        Refusal{"GuideFileWithFalseCount", R"({"groom": {"file": "lies.hgl"}})", "lies.hgl"}),
    [](const auto& each) { return each.param.name; });

TEST(Cli, RefusesWhatItDoesNotKnow) {
    EXPECT_EQ(hairbench("").status, 2);
    EXPECT_EQ(hairbench("fly").status, 2);
    EXPECT_EQ(hairbench("run").status, 2);
    EXPECT_EQ(hairbench("run " + shippedScene("smoke.json") + " -a /no/such=1").status, 2);
    EXPECT_EQ(hairbench("run " + shippedScene("smoke.json") + " --filter '['").status, 2);
}

TEST(Cli, ValidateNamesEveryBadScene) {
    const TemporaryFolder folder;
    const fs::path bad = folder.write("bad.json", "[]");
    const Outcome outcome =
        hairbench("validate " + shippedScene("smoke.json") + " '" + bad.string() + "'");
    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(outcome.output, HasSubstr("smoke.json: ok, "));
    EXPECT_THAT(outcome.output, HasSubstr("bad.json: "));
}

// All hair starts inside a ball as large as the head.
TEST(Cli, ValidateSaysWhatIsWrongWithTheHairAtTheStart) {
    const TemporaryFolder folder;
    const fs::path scene = folder.write(
        "inside.json", R"({"base": ")" HAIRBENCH_SCENES_DIR R"(/rest.json", "groom": {"guides": 24},
            "simulation": {"solver": "none", "colliders": [
                {"a": [0, 0, 0], "b": [0, 0, 0], "radius": 0.5, "follows": "world"}]}})");
    const Outcome silent = hairbench("validate '" + scene.string() + "'");
    EXPECT_EQ(silent.status, 0);
    EXPECT_THAT(silent.output, Not(HasSubstr("warning")));
    const Outcome outcome = hairbench("validate --start '" + scene.string() + "'");
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_THAT(
        outcome.output, HasSubstr("inside: grown, longest segment 1 of its rest length, deepest"));
    EXPECT_THAT(outcome.output, HasSubstr("warning: hair starts inside a body: guide "));
    EXPECT_THAT(outcome.output, HasSubstr("; 24 guides deeper than 0.1 mm"));
}

// A tetrahedron without a face.
constexpr const char* kOpenObj =
    "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n";

TEST(Cli, ValidateWarnsOfABodyThatIsNotClosed) {
    const TemporaryFolder folder;
    folder.write("open.obj", kOpenObj);
    const fs::path scene = folder.write(
        "open.json", R"({"groom": {"grow": {"mesh": ")" HAIRBENCH_SCENES_DIR
                     R"(/assets/head.glb"}}, "simulation": {"distance_fields": [)"
                     R"({"mesh": "open.obj"}]}, "sweep": {"/strands/density": [2, 3]}})");
    const Outcome outcome = hairbench("validate '" + scene.string() + "'");
    EXPECT_EQ(outcome.status, 0);
    const std::string warning = "/simulation/distance_fields/0: the surface is not closed: edges "
                                "with one triangle: 3, the first";
    const std::size_t at = outcome.output.find(warning);
    ASSERT_NE(at, std::string::npos) << outcome.output;
    EXPECT_EQ(outcome.output.find(warning, at + 1), std::string::npos);  // once
    EXPECT_THAT(outcome.output, HasSubstr("open.json: ok, 2 cases"));
}

// A new folder's README can be followed from the folder, and its editor's schema is the program's.
TEST(Cli, MakesAFolderForAScene) {
    const TemporaryFolder folder;
    const std::string made = "'" + folder.file("my_hair").string() + "'";
    const Outcome outcome = hairbench("new " + made + " --from rest");
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_EQ(outcome.output, folder.file("my_hair/my_hair.json").string() + '\n');
    const std::string readme = textOf(folder.file("my_hair/README.md"));
    const std::string in = "cd " + made + " && ";
    for (const char* command : {"validate my_hair.json", "render my_hair.json", "run my_hair.json"})
        EXPECT_THAT(readme, HasSubstr(std::string("\nhairbench ") + command + ' '));
    EXPECT_THAT(hairbench("validate my_hair.json", in).output, HasSubstr("my_hair.json: ok, "));
    const Outcome drawn = hairbench(
        "render my_hair.json -o out.png --set /render/width=32 --set /render/height=32"
        " --set /strands/density=1",
        in);
    EXPECT_EQ(drawn.status, 0) << drawn.output;
    EXPECT_EQ(textOf(folder.file("my_hair/scene.schema.json")), hairbench("schema").output);

    EXPECT_THAT(hairbench("new " + made).output, HasSubstr("my_hair: exists"));
    const std::string other = "new '" + folder.file("other").string() + "' --from ";
    for (const char* from : {"no_such", "full", "../scenes/thesis"}) {
        EXPECT_EQ(hairbench(other + from).status, 2) << from;
        EXPECT_FALSE(fs::exists(folder.file("other"))) << from;
    }
}

TEST(Cli, PhysicsRefusesWhatItDoesNotKnow) {
    const Outcome solver = hairbench("physics --solver jelly");
    EXPECT_EQ(solver.status, 2);
    EXPECT_THAT(solver.output, HasSubstr("unknown solver"));
    EXPECT_THAT(
        solver.output, HasSubstr("known: shape, ftl, rod, stable_cosserat, position_based_rod, "
                                 "augmented_mass_spring"));
    EXPECT_EQ(hairbench("physics --check '['").status, 2);
    EXPECT_EQ(hairbench("physics --check none_at_all").status, 14);
    for (const char* const both : {"--invariance --check slide", "--invariance --work-precision"})
        EXPECT_EQ(hairbench(std::string("physics ") + both).status, 2) << both;
}

TEST(Cli, NothingMatchesTheFilter) {
    const Outcome outcome =
        hairbench("run " + shippedScene("smoke.json") + " --filter none_at_all");
    EXPECT_EQ(outcome.status, 14);
}

TEST(Cli, UnknownDeviceIsStatus77) {
    const TemporaryFolder folder;
    const Outcome outcome = hairbench(
        "run " + shippedScene("smoke.json") + " --device 'no such' --out '" +
        (folder.path() / "r.json").string() + "'");
    EXPECT_EQ(outcome.status, 77);
}

TEST(Cli, NoDriverIsStatus77) {
    const Outcome outcome = hairbench(
        "devices", "VK_DRIVER_FILES=/nonexistent.json VK_ICD_FILENAMES=/nonexistent.json ");
    EXPECT_EQ(outcome.status, 77);
    EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
}

// ---- The main job -------------------------------------------------------------------------------

class CliRun : public testing::Test {
protected:
    void SetUp() override {
        if (!hasDevice()) return skipWithout(Need::device, "no Vulkan device");
    }

    nlohmann::json run(const std::string& name, const std::string& options, int status = 0) {
        const fs::path out = folder_.path() / (name + ".json");
        const Outcome outcome = hairbench(
            "run " + shippedScene("smoke.json") + " " + options + " --out '" + out.string() + "'");
        EXPECT_EQ(outcome.status, status) << outcome.output;
        EXPECT_THAT(outcome.output, HasSubstr("report: " + out.string()));
        return reportOf(out);
    }

    TemporaryFolder folder_;
};

TEST_F(CliRun, GivesEveryFigureOfACase) {
    const nlohmann::json report = run("figures", "--validate");
    ASSERT_FALSE(report["cases"].empty());
    for (const nlohmann::json& each : report["cases"]) {
        if (each["status"] == "skipped") continue;
        ASSERT_EQ(each["status"], "ok") << each["reason"];
        for (const char* metric :
             {"frame.time", "fps", "cpu.host.time", "pass.wind.time", "pass.simulate.time",
              "pass.scene.time", "pass.strands.time", "memory.device"}) {
            ASSERT_TRUE(each["metrics"].contains(metric)) << metric;
            EXPECT_GT(each["metrics"][metric]["median"], 0.0) << metric;
        }
        for (const auto& [name, statistic] : each["statistics"].items()) {
            if (statistic.contains("expected")) {
                EXPECT_EQ(statistic["measured"], statistic["expected"]) << name;
            }
        }
        EXPECT_EQ(each["image_hash"].get<std::string>().size(), 16u);
        EXPECT_EQ(each["state_hash"].get<std::string>().size(), 16u);
        for (const nlohmann::json& warning : each["trust"]["warnings"]) {
            EXPECT_THAT(warning.get<std::string>(), Not(HasSubstr("validation"))) << warning;
            EXPECT_THAT(warning.get<std::string>(), Not(HasSubstr("expected"))) << warning;
            EXPECT_THAT(warning.get<std::string>(), Not(HasSubstr("different"))) << warning;
        }
    }
}

TEST_F(CliRun, GivesEqualHashesTwice) {
    const nlohmann::json first = run("first", "");
    const nlohmann::json second = run("second", "");
    ASSERT_EQ(first["cases"].size(), second["cases"].size());
    for (std::size_t i = 0; i < first["cases"].size(); ++i) {
        EXPECT_EQ(first["cases"][i]["image_hash"], second["cases"][i]["image_hash"]);
        EXPECT_EQ(first["cases"][i]["state_hash"], second["cases"][i]["state_hash"]);
    }
}

// The cache is in a folder that belongs to the test.
TEST_F(CliRun, TakesSettledHairFromDiskOrNotAndHasTheSameHashes) {
    const fs::path folder = folder_.path() / "cache";
    const auto entries = [&] {
        std::error_code none;
        const fs::directory_iterator found(folder / "hairbench" / "hair", none);
        return std::distance(begin(found), end(found));
    };
    const std::optional<std::string> old =
        std::getenv("XDG_CACHE_HOME") ? std::optional(std::getenv("XDG_CACHE_HOME")) : std::nullopt;
    setenv("XDG_CACHE_HOME", folder.c_str(), 1);
    const std::string options =
        "-a /strands/density=2,3 -a /render/msaa=1 --set /simulation/settle_steps=9 "
        "--set /simulation/distance_fields='[{\"resolution\":10}]' --frames 1 --warmup 2 "
        "--max-time 0 ";
    const nlohmann::json without = run("without", options + "--no-cache");
    EXPECT_EQ(entries(), 0);
    const nlohmann::json first = run("first", options);
    EXPECT_EQ(entries(), 2);  // a distance field and a state, which both cases share
    const nlohmann::json second = run("second", options);
    EXPECT_EQ(entries(), 2);
    if (old)
        setenv("XDG_CACHE_HOME", old->c_str(), 1);
    else
        unsetenv("XDG_CACHE_HOME");
    ASSERT_EQ(without["cases"].size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        const nlohmann::json& expected = without["cases"][i];
        ASSERT_EQ(expected["status"], "ok");
        for (const nlohmann::json* report : {&first, &second}) {
            EXPECT_EQ((*report)["cases"][i]["image_hash"], expected["image_hash"]);
            EXPECT_EQ((*report)["cases"][i]["state_hash"], expected["state_hash"]);
        }
    }
}

TEST_F(CliRun, ReportsThatABodyIsNotClosed) {
    const fs::path mesh = folder_.write("open.obj", kOpenObj);
    const nlohmann::json report =
        run("open", "--set /simulation/distance_fields='[{\"resolution\":8,\"mesh\":\"" +
                        mesh.string() + "\"}]' --frames 1 --warmup 2 --max-time 0");
    for (const nlohmann::json& each : report["cases"]) {
        ASSERT_EQ(each["status"], "ok");
        EXPECT_THAT(
            each["trust"]["warnings"].dump(),
            HasSubstr("/simulation/distance_fields/0: the surface is not closed: edges with one"));
    }
}

// Every device supports one sample a pixel. Some support neither two nor eight, e.g. lavapipe.
TEST_F(CliRun, SaysWhyACaseIsSkippedAndGoesOn) {
    const nlohmann::json report = run("skipped", "-a /render/msaa=2,8,1 --frames 1 --warmup 2");
    ASSERT_EQ(report["cases"].size(), 3u);
    EXPECT_EQ(report["cases"][2]["status"], "ok");
    for (const nlohmann::json& each : report["cases"]) {
        if (each["status"] == "ok") continue;
        EXPECT_EQ(each["status"], "skipped");
        EXPECT_THAT(each["reason"].get<std::string>(), HasSubstr("-sample images"));
        EXPECT_FALSE(each.contains("metrics"));
    }
}

TEST_F(CliRun, SkipsOnASoftwareDeviceWhatNeedsAGpusClocksOrQueues) {
    if (hairbench("devices").output.find("cpu") == std::string::npos)
        GTEST_SKIP() << "of a software device alone";
    const nlohmann::json report =
        run("clocks",
            "--clocks both -a /run/async_compute=false,true -a /render/msaa=1 --frames 1 "
            "--warmup 2 --max-time 0",
            kNothingRan);
    ASSERT_EQ(report["cases"].size(), 4u);
    for (const nlohmann::json& each : report["cases"]) {
        EXPECT_EQ(each["status"], "skipped");
        EXPECT_THAT(
            each["reason"].get<std::string>(),
            HasSubstr(
                "/run/clocks " + each["axes"]["/run/clocks"].get<std::string>() +
                ": a software device has the processors' clocks"));
    }
    const nlohmann::json async =
        run("async",
            "--set /run/async_compute=true -a /render/msaa=1 --frames 1 --warmup 2 "
            "--max-time 0",
            kNothingRan);
    EXPECT_EQ(
        async["cases"][0]["reason"],
        "/run/async_compute: the device has no second queue that computes");
}

TEST_F(CliRun, SavesWhatWasDoneWhenItIsInterrupted) {
    const fs::path out = folder_.path() / "interrupted.json";
    // Without job control the shell's children would ignore the interrupt. The long case has frames
    // for minutes. The interrupt comes once the first case is in the journal, or after a minute.
    // With this seed the short case is the first.
    const fs::path script = folder_.write(
        "interrupt.sh", "set -m\n'" HAIRBENCH_PROGRAM "' run " + shippedScene("smoke.json") +
                            " -a /render/msaa=1 -a /run/frames=1,1000000 --order-seed 1 --out '" +
                            out.string() + "' &\nfor i in $(seq 600); do grep -q frames:1 '" +
                            out.string() + ".journal' 2>/dev/null && break; sleep 0.1; done\n" +
                            "kill -INT $!\nwait $!\n");
    const int status = std::system(("bash '" + script.string() + "'").c_str());
    EXPECT_EQ(WEXITSTATUS(status), 130);
    const nlohmann::json report = reportOf(out);
    EXPECT_EQ(report["interrupted"], true);
    ASSERT_EQ(report["cases"].size(), 1u);
    EXPECT_EQ(report["cases"][0]["status"], "ok");
}

TEST_F(CliRun, ChecksThePhysicsAndSaysWhatItSkipped) {
    const fs::path out = folder_.path() / "physics.json";
    const Outcome outcome = hairbench("physics --check projectile --out '" + out.string() + "'");
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("1 pass, 0 fail, 0 reported, 5 skipped"));
    const nlohmann::json report = reportOf(out);
    EXPECT_EQ(report["schema"], "hairbench-physics/1.0.0");
    ASSERT_EQ(report["outcomes"].size(), 6u);
    EXPECT_EQ(report["outcomes"][0]["solver"], "shape");
    EXPECT_EQ(report["outcomes"][0]["verdict"], "pass");
    const std::string only = "physics --check projectile --solver ftl --out '" + out.string() + "'";
    EXPECT_EQ(hairbench(only).status, 14);  // all skipped
}

TEST_F(CliRun, RendersThePictureThatItMeasures) {
    const fs::path picture = folder_.path() / "picture.png";
    const Outcome outcome = hairbench(
        "render " + shippedScene("smoke.json") + " --frame 3 -o '" + picture.string() + "'");
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_GT(fs::file_size(picture), 1000u);
}

// See docs/extending.md. sha256sum computed the hash of the file.
TEST(Cli, ReportsSayWhichFilesOfGlslCasesWerePlayedWith) {
    if (!hasDevice()) return skipWithout(Need::device, "no Vulkan device");
    const TemporaryFolder folder;
    folder.write("own.glsl", "vec3 shadeHair(HairPoint point) { return point.color; }\n");
    const fs::path scene = folder.write("own.json", R"({
        "base": ")" HAIRBENCH_SCENES_DIR R"(/smoke.json",
        "render": {"width": 64, "height": 48},
        "strands": {"density": 4},
        "run": {"warmup": 2, "frames": 1, "frame_time": 0, "max_time": 0},
        "sweep": {"/render/msaa": null,
                  "/shading/model": ["own.glsl", "phong"]}
    })");
    const fs::path report = folder.file("report.json");
    const Outcome outcome =
        hairbench("run '" + scene.string() + "' --no-pictures --out '" + report.string() + "'");
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    const nlohmann::json cases = reportOf(report).at("cases");
    ASSERT_EQ(cases.size(), 2u);
    const nlohmann::json expected = {
        {{"pointer", "/shading/model"},
         {"file", "own.glsl"},
         {"sha256", "77c2ab07d3d57418d191e707720170786107e50769b11d404f6e54b716f08b5b"}}};
    EXPECT_EQ(cases.at(0).at("axes").at("/shading/model"), "own.glsl");
    EXPECT_EQ(cases.at(0).at("extensions"), expected);
    EXPECT_FALSE(cases.at(1).contains("extensions"));
}

}  // namespace
