#include "benchmarks/report/table.h"
#include "benchmarks/report/text.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/benchmarks/sample_report.h"

namespace benchmarks {
namespace {

TEST(ShortNumber, HasThreeSignificantDigits) {
    EXPECT_EQ(report::shortNumber(1234.56), "1235");
    EXPECT_EQ(report::shortNumber(123.4), "123");
    EXPECT_EQ(report::shortNumber(12.34), "12.3");
    EXPECT_EQ(report::shortNumber(1.234), "1.23");
    EXPECT_EQ(report::shortNumber(0.1234), "0.123");
    EXPECT_EQ(report::shortNumber(0.01234), "0.0123");
    EXPECT_EQ(report::shortNumber(0.00012345), "0.000123");
    EXPECT_EQ(report::shortNumber(-2.3456e-9), "-2.35e-09");
    EXPECT_EQ(report::shortNumber(0.0), "0");
    EXPECT_EQ(report::shortNumber(-1.5), "-1.50");
}

TEST(Table, ShowsVaryingAxesMediansAndStatus) {
    EXPECT_EQ(
        report::table(report::reportJson(sampleReport())),
        "Soft (cpu), llvmpipe 22.3.6, Vulkan 1.3.230; scenes/thesis.json\n"
        "fps: frames / all their time; ms: medians; +-: half the 95 % interval of frame ms\n"
        "     backend  fps  frame ms  +-  wind ms  strands ms  strands  trust                      "
        "              status\n"
        "tessellation  333      3.00   -   0.0125        2.50     8704  untrusted (other load 50 "
        "%, steal 25 %)  ok, 1 warning\n"
        "        mesh    -         -   -        -           -        -  -                          "
        "              skipped: the device has no VK_EXT_mesh_shader, which...\n"
        "       lines    -         -   -        -           -        -  -                          "
        "              failed: device lost\n");
}

TEST(Table, IsTheSameOfCasesThatNobodyHolds) {
    const report::Report whole = sampleReport();
    const scene::Json header = report::headerJson(whole);
    report::CaseTable table(header);
    for (const report::CaseResult& each : whole.cases) table.add(report::caseJson(each));
    EXPECT_EQ(table.text(), report::table(report::reportJson(whole)));
}

// As nvbench has it: half the interval over the median, in percent.
TEST(Table, ShowsTheIntervalOfTheFrameTime) {
    scene::Json report = report::reportJson(sampleReport());
    report["cases"][0]["metrics"]["frame.time"]["interval"] = {
        {"lower", 2.7}, {"upper", 3.15}, {"confidence", 0.95}};  // of a median of 3
    const std::string table = report::table(report);
    EXPECT_NE(table.find("frame ms     +-"), std::string::npos) << table;
    EXPECT_NE(table.find("    3.00  7.5 %"), std::string::npos) << table;
}

// Others' load is never worse than doubtful on a device that is not known to be a software one.
TEST(Table, NamesTheCaseWhereNothingVaries) {
    report::Report report = sampleReport();
    report.cases.resize(1);
    report.cases[0].metrics.clear();
    report.environment.device = {};
    report.scene.path.clear();
    EXPECT_EQ(
        report::table(report::reportJson(report)),
        "unknown device\n"
        "fps: frames / all their time; ms: medians; +-: half the 95 % interval of frame ms\n"
        "case                                    fps  frame ms  +-  strands  trust                 "
        "                                              status\n"
        "thesis/density:64/backend:tessellation    -         -   -     8704  doubtful (clock "
        "limited, other load 50 %, steal 25 %, no interval)  ok, 1 warning\n");
}

TEST(Table, SaysWhatDrewAnAutomaticCase) {
    report::Report report = sampleReport();
    report.cases[0].axes[1].value = scene::Document("automatic");
    report.cases[0].backend.name = "software";
    EXPECT_EQ(
        report::table(report::reportJson(report)),
        "Soft (cpu), llvmpipe 22.3.6, Vulkan 1.3.230; scenes/thesis.json\n"
        "fps: frames / all their time; ms: medians; +-: half the 95 % interval of frame ms\n"
        "  backend  drawn by  fps  frame ms  +-  wind ms  strands ms  strands  trust               "
        "                     status\n"
        "automatic  software  333      3.00   -   0.0125        2.50     8704  untrusted (other "
        "load 50 %, steal 25 %)  ok, 1 warning\n"
        "     mesh  -           -         -   -        -           -        -  -                   "
        "                     skipped: the device has no VK_EXT_mesh_shader, which...\n"
        "    lines  -           -         -   -        -           -        -  -                   "
        "                     failed: device lost\n");
}

TEST(Table, HasAColumnForEachPassAlone) {
    report::Report report = sampleReport();
    report.cases[0].metrics.push_back(
        {report::ofPass("strands", report::Measured::cpu_time), {7.25}, report::Mode::wall_clock});
    report.cases[0].metrics.push_back(
        {report::ofPass("strands", report::Measured::instructions),
         {7.0},
         report::Mode::wall_clock});
    EXPECT_EQ(
        report::table(report::reportJson(report)),
        report::table(report::reportJson(sampleReport())));
}

TEST(Table, ShowsHowFarPicturesAreFromTheReference) {
    report::Report report = sampleReport();
    report.cases.resize(1);
    report.cases[0].metrics = {{report::ofImage(report::Measured::flip), {0.12345}}};
    report.environment.device = {};
    report.scene.path.clear();
    EXPECT_EQ(
        report::table(report::reportJson(report)),
        "unknown device\n"
        "fps: frames / all their time; ms: medians; +-: half the 95 % interval of frame ms\n"
        "case                                    fps  frame ms  +-   FLIP  strands  trust          "
        "                                                     status\n"
        "thesis/density:64/backend:tessellation    -         -   -  0.123     8704  doubtful "
        "(clock limited, other load 50 %, steal 25 %, no interval)  ok, 1 warning\n");
}

// Axes of one scene in a suite are absent in another.
TEST(Table, NamesTheCasesOfASuite) {
    report::Report report = sampleReport();
    report.scene.document =
        scene::Document(scene::Json{{"suite", {{"thesis", scene::Json::object()}}}});
    EXPECT_NE(
        report::table(report::reportJson(report)).find("\nthesis/density:64/backend:mesh "),
        std::string::npos);
}

TEST(Table, OfNoCasesIsItsHeader) {
    EXPECT_EQ(
        report::table(scene::Json::object()),
        "unknown device\n"
        "fps: frames / all their time; ms: medians; +-: half the 95 % interval of frame ms\n"
        "case  fps  frame ms  +-  strands  trust  status\n");
}

}  // namespace
}  // namespace benchmarks
