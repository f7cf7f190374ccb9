// Tests that an installed tree runs in place and after a move, without files of the source tree or
// the build tree.
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/run_hairbench.h"
#include "tests/python.h"
#include "tests/required.h"
#include "tests/temporary_folder.h"

namespace {

namespace fs = std::filesystem;

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

class InstalledTree : public testing::Test {
protected:
    // Installs once for all tests.
    static void SetUpTestSuite() {
        folder.emplace();
        const Outcome installed = runInShell(
            "'" HAIRBENCH_CMAKE "' --install '" HAIRBENCH_BUILD_DIR "' --prefix '" +
            folder->file("first").string() + "' 2>&1");
        ASSERT_EQ(installed.status, 0) << installed.output;
        fs::create_directories(folder->file("moved"));
        fs::rename(folder->file("first"), folder->file("moved/there"));
    }
    static void TearDownTestSuite() { folder.reset(); }

    InstalledTree() { fs::create_directories(own.file("work")); }

    static fs::path tree() { return folder->file("moved/there"); }

    // Runs the installed program in a folder of the test's own, with an empty home folder. `before`
    // sets environment variables.
    Outcome run(const std::string& arguments, const std::string& before = "") const {
        return runInShell(
            "cd '" + own.file("work").string() + "' && unset HAIRBENCH_PYTHON HAIRBENCH_PLOTLY " +
            "XDG_DATA_HOME; export HOME='" + own.path().string() + "'; " + before + " '" +
            (tree() / "bin/hairbench").string() + "' " + arguments + " 2>&1");
    }

    bool hasDevice() const { return run("devices").status == 0; }

    static std::optional<TemporaryFolder> folder;
    TemporaryFolder own;
};
std::optional<TemporaryFolder> InstalledTree::folder;

// Returns the files that contain the path of this folder.
std::string filesThatName(const std::string& folder, const std::string& files) {
    return runInShell("grep -rlaF '" + folder + "' " + files).output;
}

TEST_F(InstalledTree, DoesNotNameTheMachineThatBuiltIt) {
    std::string files = "'" + (tree() / "share").string() + "'";
#ifdef NDEBUG  // otherwise asserts contain the paths of their files
    files = "'" + tree().string() + "'";
#endif
    EXPECT_EQ(filesThatName(HAIRBENCH_SOURCE_DIR, files), "");
    EXPECT_EQ(filesThatName(HAIRBENCH_BUILD_DIR, files), "");
    EXPECT_EQ(filesThatName(folder->file("first").string(), "'" + tree().string() + "'"), "");
    // The search finds names.
    EXPECT_THAT(filesThatName("scene.schema.json", files), HasSubstr("thesis.json"));
}

TEST_F(InstalledTree, KnowsItsScenesFromAnywhere) {
    EXPECT_EQ(run("schema").output, textOf(HAIRBENCH_SCENES_DIR "/scene.schema.json"));
    EXPECT_THAT(
        run("scenes --names").output, AllOf(HasSubstr("thesis\n"), HasSubstr("portraits/braid\n")));
    const Outcome checked = run("validate thesis scenes/rest.json truth/cantilever");
    EXPECT_EQ(checked.status, 0) << checked.output;
    EXPECT_THAT(
        checked.output, HasSubstr((tree() / "share/hairbench/scenes/thesis.json").string()));
    // A scene of the user's own has a shipped scene as its base, and may use the base's files.
    own.write(
        "work/mine.json",
        R"({"base": ")" + (tree() / "share/hairbench/scenes/rest.json").string() + R"("})");
    EXPECT_EQ(run("validate mine.json").output, "mine.json: ok, 1 case\n");
}

TEST_F(InstalledTree, RunsAShippedScene) {
    if (!hasDevice()) return skipWithout(Need::device, "no Vulkan device");
    const Outcome outcome = run("run smoke --filter msaa:1 --frames 2 --warmup 2 --max-time 0");
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    const fs::path report = own.file("work/results/local/smoke.json");
    const nlohmann::json written = nlohmann::json::parse(textOf(report));
    EXPECT_EQ(written.at("cases").size(), 1u);
    const nlohmann::json& build = written.at("environment").at("build");
    EXPECT_THAT(
        run("--version").output, StartsWith("hairbench " + build.at("version").get<std::string>()));
    EXPECT_THAT(  // validates with the installed schema; the findings depend on this machine
        run("doctor --reports results/local/smoke.json").output,
        HasSubstr("results/local/smoke.json: "));

    if (!fs::exists(HAIRBENCH_SOURCE_DIR "/.deps/plotly/plotly.min.js.gz"))
        return skipWithout(Need::report, "no Plotly; scripts/setup fetches it");
    const Outcome page = run("report results/local/smoke.json -o page.html");
    EXPECT_EQ(page.status, 0) << page.output;
    EXPECT_THAT(textOf(own.file("work/page.html")), HasSubstr("smoke/msaa:1"));
}

TEST_F(InstalledTree, ReadsMeshesByItsOwnReader) {
    own.write(
        "work/m.obj",
        "o scalp\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    own.write(
        "work/s.json",
        R"({"render": {"meshes": [{"file": "m.obj"}]}, "groom": {"grow": {"mesh": "m.obj"}}})");
    EXPECT_EQ(run("validate s.json").output, "s.json: ok, 1 case\n");
    const fs::path reader = tree() / "libexec/hairbench/hairbench_mesh_reader";
    fs::rename(reader, reader.string() + ".away");
    EXPECT_THAT(run("validate s.json").output, HasSubstr("is missing: " + reader.string()));
    fs::rename(reader.string() + ".away", reader);
}

TEST_F(InstalledTree, ReadsUsdByItsOwnTools) {
    own.write("work/hair.usda", R"(#usda 1.0
(
    metersPerUnit = 1
    upAxis = "Y"
)
def BasisCurves "hair"
{
    uniform token type = "linear"
    int[] curveVertexCounts = [2, 3]
    point3f[] points = [(0, 0, 0), (0, 0.1, 0), (0.1, 0, 0), (0.1, 0.1, 0), (0.1, 0.2, 0)]
}
)");
    const Outcome without = run("groom info hair.usda --json");
    EXPECT_NE(without.status, 0);
    EXPECT_THAT(
        without.output,
        HasSubstr("run " + (tree() / "libexec/hairbench/python-environment python").string()));
    if (pythonInterpreter().empty()) return skipWithout(Need::python, kNoPython);
    const Outcome read =
        run("groom info hair.usda --json", "HAIRBENCH_PYTHON='" + pythonInterpreter() + "'");
    ASSERT_EQ(read.status, 0) << read.output;
    EXPECT_THAT(read.output, HasSubstr("\"strands\": 2"));
}

// Tests that the files named in its messages exist, without making an environment.
TEST_F(InstalledTree, HasWhatMakesPythonEnvironments) {
    const std::string maker =
        "'" + (tree() / "libexec/hairbench/python-environment").string() + "'";
    EXPECT_EQ(runInShell(maker + " --help").status, 0);
    for (const char* name : {"python", "reference"})
        EXPECT_EQ(
            runInShell("HOME='" + own.path().string() + "' " + maker + " --check " + name).status %
                2,
            1)
            << name;  // status 1 or 3
}

TEST_F(InstalledTree, HasCompletionsAndAManual) {
    for (const char* file :
         {"share/bash-completion/completions/hairbench", "share/zsh/site-functions/_hairbench",
          "share/fish/vendor_completions.d/hairbench.fish", "share/man/man1/hairbench.1",
          "share/man/man1/hairbench-groom-info.1"})
        EXPECT_THAT(textOf(tree() / file), HasSubstr("hairbench")) << file;
    EXPECT_EQ(textOf(tree() / "share/man/man1/hairbench-run.1"), run("man run").output);
}

}  // namespace
