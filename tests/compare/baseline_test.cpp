#include "benchmarks/report/compare.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "benchmarks/report/report.h"
#include "tests/compare/made_report.h"
#include "tests/error_text.h"
#include "tests/temporary_folder.h"
#include "tests/variable.h"

namespace benchmarks::report {
namespace {

class Baseline : public testing::Test {
protected:
    Baseline() { setVariable("HAIRBENCH_BASELINES", folder_.path().string()); }
    ~Baseline() override { removeVariable("HAIRBENCH_BASELINES"); }

    TemporaryFolder folder_;
};

TEST_F(Baseline, IsAFileOfNameAndScene) {
    EXPECT_EQ(baselineFile("main", "thesis"), folder_.file("main/thesis.json"));
    removeVariable("HAIRBENCH_BASELINES");
    EXPECT_EQ(baselineFile("main", "thesis"), "results/local/baselines/main/thesis.json");
}

TEST_F(Baseline, RefusesNamesThatAreNoFolders) {
    for (const char* const name : {"", ".", "..", "../up", "a/b", "-x", "a\\b", "new\nline"})
        EXPECT_NE(errorText([&] { baselineFile(name, "thesis"); }), "no error") << name;
    for (const char* const name : {"main", "v1.2", "2030-01-02", "my build"})
        EXPECT_EQ(errorText([&] { baselineFile(name, "thesis"); }), "no error") << name;
}

TEST_F(Baseline, IsOfAReportThatNamesItsScene) {
    EXPECT_EQ(sceneNameOf({{"scene", {{"path", "scenes/thesis.json"}}}}), "thesis");
    for (const scene::Json& report : {scene::Json::object(), scene::Json{{"scene", 5}}})
        EXPECT_EQ(
            errorText([&] { sceneNameOf(report); }), "/scene/path: the report names no scene");
}

TEST_F(Baseline, KeepsAllSamplesInOneFile) {
    scene::Json report = madeReport();
    std::vector<double> samples;  // enough that the report keeps them in a file beside it
    for (int i = 0; i < 5001; ++i) samples.push_back(1.0 + i);
    report["cases"].push_back(madeCase("made", {{"frame.time", samples}}));
    report["cases"][0]["picture"] = "made.png";
    const TemporaryFolder runs;
    const auto path = runs.file("made.json");
    writeReport(report, path);
    saveBaseline("main", path);
    std::filesystem::remove_all(runs.path());

    const scene::Json kept = readReport(baselineFile("main", "made"));
    EXPECT_EQ(kept["cases"][0]["metrics"]["frame.time"]["samples"].size(), 5001u);
    EXPECT_FALSE(kept["cases"][0].contains("picture"));
    EXPECT_EQ(kept["environment"], report["environment"]);
    EXPECT_EQ(sceneNameOf(kept), "made");
    std::size_t files = 0;
    for (const auto& each : std::filesystem::recursive_directory_iterator(folder_.path()))
        files += each.is_regular_file();
    EXPECT_EQ(files, 1u);
}

}  // namespace
}  // namespace benchmarks::report
