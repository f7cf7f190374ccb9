#include "benchmarks/table.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/benchmarks/sample_report.h"

namespace benchmarks {
namespace {

TEST(ShortNumber, HasThreeSignificantDigits) {
    EXPECT_EQ(shortNumber(1234.56), "1235");
    EXPECT_EQ(shortNumber(123.4), "123");
    EXPECT_EQ(shortNumber(12.34), "12.3");
    EXPECT_EQ(shortNumber(1.234), "1.23");
    EXPECT_EQ(shortNumber(0.1234), "0.123");
    EXPECT_EQ(shortNumber(0.01234), "0.0123");
    EXPECT_EQ(shortNumber(0.0), "0");
    EXPECT_EQ(shortNumber(-1.5), "-1.50");
}

TEST(Table, ShowsVaryingAxesMediansAndStatus) {
    EXPECT_EQ(
        table(reportJson(sampleReport())),
        "Soft (cpu), llvmpipe 22.3.6, Vulkan 1.3.230; scenes/thesis.json\n"
        "     backend  fps  frame ms  wind ms  strands ms  strands  status\n"
        "tessellation  333      3.00   0.0125        2.50     8704  ok, 1 warning\n"
        "        mesh    -         -        -           -        -  skipped: the device has "
        "no "
        "VK_EXT_mesh_shader, which...\n"
        "       lines    -         -        -           -        -  failed: device lost\n");
}

TEST(Table, NamesTheCaseWhereNothingVaries) {
    Report report = sampleReport();
    report.cases.resize(1);
    report.cases[0].metrics.clear();
    report.environment.device = {};
    report.scene.path.clear();
    EXPECT_EQ(
        table(reportJson(report)),
        "unknown device\n"
        "case                                    fps  frame ms  strands  status\n"
        "thesis/density:64/backend:tessellation    -         -     8704  ok, 1 warning\n");
}

TEST(Table, HasAColumnForEachPassAlone) {
    Report report = sampleReport();
    report.cases[0].metrics.push_back(
        {ofPass("strands", Measured::cpu_time), {7.25}, Mode::wall_clock});
    report.cases[0].metrics.push_back(
        {ofPass("strands", Measured::instructions), {7.0}, Mode::wall_clock});
    EXPECT_EQ(table(reportJson(report)), table(reportJson(sampleReport())));
}

TEST(Table, ShowsHowFarPicturesAreFromTheReference) {
    Report report = sampleReport();
    report.cases.resize(1);
    report.cases[0].metrics = {{ofImage(Measured::flip), {0.12345}}};
    report.environment.device = {};
    report.scene.path.clear();
    EXPECT_EQ(
        table(reportJson(report)),
        "unknown device\n"
        "case                                    fps  frame ms   FLIP  strands  status\n"
        "thesis/density:64/backend:tessellation    -         -  0.123     8704  ok, 1 warning\n");
}

// What varies in one scene of a suite is not there in another.
TEST(Table, NamesTheCasesOfASuite) {
    Report report = sampleReport();
    report.scene.document = Document(Json{{"suite", {{"thesis", Json::object()}}}});
    EXPECT_NE(
        table(reportJson(report)).find("\nthesis/density:64/backend:mesh "), std::string::npos);
}

TEST(Table, OfNoCasesIsItsHeader) {
    EXPECT_EQ(table(Json::object()), "unknown device\ncase  fps  frame ms  strands  status\n");
}

}  // namespace
}  // namespace benchmarks
