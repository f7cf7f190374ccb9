#include <sstream>

#include <gmock/gmock.h>

#include "tests/exporters/exported.h"

namespace benchmarks::report {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> lines(const std::string& text) {
    std::vector<std::string> found;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) found.push_back(line);
    return found;
}

TEST(Csv, HasARowForEachMetric) {
    const std::string start =
        "thesis/density:64/backend:tessellation,64,tessellation,ok,,1,untrusted,other load: 50.0 % "
        "of all processors' time was used by others; steal: 25.0 % of all processors' time was "
        "given to others by the hypervisor; clocks: the device's clock was held back: power cap; "
        "noise: too few frames for an interval of the frame time,";
    EXPECT_THAT(
        lines(exported("csv")),
        ElementsAre(
            "case,/strands/density,/strands/backend,status,reason,warnings,verdict,reasons,metric,"
            "samples,unit,mode,median,mad,mean,minimum,first_quartile,third_quartile,maximum,lower,"
            "upper,confidence",
            start + "frame.time,3,ms,overlapped,3.0,1.0,3.0,2.0,2.5,3.5,4.0,,,",
            start + "fps,1,1/s,overlapped,333.25,0.0,333.25,333.25,333.25,333.25,333.25,,,",
            start + "pass.wind.time,1,ms,isolated,0.0125,0.0,0.0125,0.0125,0.0125,0.0125,0.0125,,,",
            start + "pass.strands.time,1,ms,isolated,2.5,0.0,2.5,2.5,2.5,2.5,2.5,,,",
            start + "memory.device,1,B,,1048576.0,0.0,1048576.0,1048576.0,1048576.0,1048576.0,"
                    "1048576.0,,,",
            "thesis/density:64/backend:mesh,64,mesh,skipped,\"the device has no "
            "VK_EXT_mesh_shader, which the back end needs\",,,,,,,,,,,,,,,,,",
            "thesis/density:64/backend:lines,64,lines,failed,device lost,,,,,,,,,,,,,,,,,"));
}

TEST(Csv, HasTheBoundsOfAnInterval) {
    scene::Json report = reportJson(sampleReport());
    report["cases"][0]["metrics"]["frame.time"]["interval"] = {
        {"lower", 2.5}, {"upper", 3.25}, {"confidence", 0.96875}};
    EXPECT_THAT(exportReport(report, "csv"), HasSubstr(",4.0,2.5,3.25,0.96875\n"));
    // (3.25 - 2.5) / 2 of a median of 3
    EXPECT_THAT(exportReport(report, "markdown"), HasSubstr("| 2.50 | 12.5 % | 3 |"));
}

TEST(Csv, QuotesWhatWouldBreakARow) {
    Report report = sampleReport();
    report.cases[1].reason = "says \"no\",\nthen stops";
    EXPECT_THAT(
        exportReport(reportJson(report), "csv"),
        HasSubstr(",skipped,\"says \"\"no\"\",\nthen stops\",,"));
}

// Spreadsheets run cells with these beginnings (OWASP, CSV Injection). Numbers keep their signs.
TEST(Csv, HasNoFormulas) {
    const std::pair<const char*, const char*> rows[] = {
        {"=1+1", "'=1+1"},
        {"+1", "'+1"},
        {"-1", "'-1"},
        {"@SUM(A1)", "'@SUM(A1)"},
        {"\t=1", "'\t=1"},
        {"\r=1", "\"'\r=1\""},
        {"=HYPERLINK(\"x\")", "\"'=HYPERLINK(\"\"x\"\")\""},
        {"lost =1", "lost =1"}};
    Report report = sampleReport();
    report.cases[0].metrics[0].samples = {-1.5};
    for (const auto& [text, cell] : rows) {
        report.cases[1].reason = text;
        report.cases[2].name = text;
        const std::string csv = exportReport(reportJson(report), "csv");
        EXPECT_THAT(csv, HasSubstr(std::string(",skipped,") + cell + ",,"));
        EXPECT_THAT(csv, HasSubstr(std::string("\n") + cell + ",64,lines,failed,"));
        EXPECT_THAT(csv, HasSubstr(",-1.5,"));
    }
}

TEST(Markdown, HasARowForEachCase) {
    EXPECT_THAT(
        lines(exported("markdown")),
        ElementsAre(
            "**scenes/thesis.json**, Soft, llvmpipe, 22.3.6, Some CPU, abc. 1 untrusted.", "",
            "Times are medians; FPS is frames / all their time; ± is half the 95 % interval of the "
            "frame's median.",
            "",
            "| density | backend | frame (ms) | mean FPS | wind (ms) | strands (ms) | ± | samples "
            "| "
            "trust | status |",
            "| --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | --- | --- |",
            "| 64 | tessellation | 3.00 | 333 | 0.0125 | 2.50 |  | 3 | untrusted (other load 50 %, "
            "steal 25 %) | ok, 1 warning |",
            "| 64 | mesh |  |  |  |  |  |  |  | skipped: the device has no "
            "VK\\_EXT\\_mesh\\_shader, which the back end needs |",
            "| 64 | lines |  |  |  |  |  |  |  | failed: device lost |"));
}

TEST(Markdown, HasOneColumnForAPass) {
    Report report = sampleReport();
    const std::string before = exportReport(reportJson(report), "markdown");
    report.cases[0].metrics.push_back(
        {ofPass("strands", Measured::cpu_time), {1.5}, Mode::wall_clock});
    report.cases[0].metrics.push_back(
        {ofPass("strands", Measured::instructions), {1e6}, Mode::wall_clock});
    EXPECT_EQ(exportReport(reportJson(report), "markdown"), before);
}

TEST(Markdown, KeepsACellInItsCell) {
    Report report = sampleReport();
    report.cases[1].reason = "a|b\n<script>";
    EXPECT_THAT(
        exportReport(reportJson(report), "markdown"), HasSubstr("skipped: a\\|b \\<script\\> |"));
}

// A table goes into a pull request, so its cells must hold no autolink (GitHub Flavored Markdown,
// section 6.9), no mention "@name" and no issue "#1".
TEST(Markdown, NamesNobodyAndLinksNowhere) {
    Report report = sampleReport();
    report.cases[1].reason = "@me #1 https://a.b www.a.b c@a.b &lt; \x1b[31m";
    EXPECT_THAT(
        exportReport(reportJson(report), "markdown"),
        HasSubstr("skipped: @&#8203;me \\#&#8203;1 https&#8203;://a.b www.&#8203;a.b "
                  "c@&#8203;a.b \\&lt;  \\[31m |"));
}

}  // namespace
}  // namespace benchmarks::report
