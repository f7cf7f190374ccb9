// What holds of the page's text, before any browser reads it.
#include "benchmarks/report/page.h"

#include <cstdlib>
#include <fstream>
#include <regex>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "benchmarks/commands/commands.h"
#include "engine/error.h"
#include "tests/report_page/sample_reports.h"
#include "tests/required.h"
#include "tests/temporary_folder.h"

namespace benchmarks::report {
namespace {

using report_page::knownReport;
using report_page::writeWithPictures;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kHostile = "</script><script>window.pwned = 1</script><!-- \"quoted\" \u00fc";

// The page in place of Plotly, which has the addresses of maps' tiles in it.
std::string pageWithoutPlotly(const scene::Json& data) {
    return assemblePage(readPageParts("/* plotly */"), data);
}

scene::Json knownData() {
    const TemporaryFolder folder;
    return pageData({{writeWithPictures(knownReport(), folder.path() / "a.json", 200)}});
}

TEST(AssemblePage, PutsEveryPartInItsPlaceAndSearchesNoneOfThem) {
    const PageParts parts{
        .page = "<@title@|@style@|@data@|@plotly@|@script@>",
        .style = "@data@",
        .script = "S",
        .plotly = "@script@"};
    EXPECT_EQ(
        assemblePage(parts, {{"title", "@style@"}}),
        "<@style@ - hairbench|@data@|{\"title\":\"@style@\"}|@script@|S>");
}

TEST(AssemblePage, SaysWhichPlaceThePageLacks) {
    const PageParts parts{.page = "@title@ @style@ @data@ @script@"};
    EXPECT_THROW(
        {
            try {
                assemblePage(parts, {{"title", ""}});
            } catch (const engine::Error& error) {
                EXPECT_THAT(error.what(), HasSubstr("@plotly@"));
                throw;
            }
        },
        engine::Error);
}

TEST(AssemblePage, WritesDataThatEndsNoScriptAndIsTheSameData) {
    const scene::Json data = {{"title", kHostile}, {kHostile, {1, 2.5, nullptr, "\u6f22"}}};
    const std::string text = scriptJson(data);
    EXPECT_THAT(text, Not(HasSubstr("<")));
    EXPECT_EQ(scene::Json::parse(text), data);
}

TEST(AssemblePage, ReplacesWhatIsNoUtf8) {
    EXPECT_EQ(scene::Json::parse(scriptJson({{"title", "a\xff"}})).at("title"), "a\ufffd");
}

TEST(AssemblePage, EscapesTheTitle) {
    scene::Json data = knownData();
    data["title"] = kHostile;
    const std::string page = pageWithoutPlotly(data);
    const std::string title = page.substr(page.find("<title>") + 7);
    EXPECT_THAT(title.substr(0, title.find('\n')), HasSubstr("&lt;/script&gt;"));
    EXPECT_THAT(page, Not(HasSubstr("<script>window.pwned")));
}

TEST(ReportPage, RefersToNothingElsewhere) {
    const std::string page = pageWithoutPlotly(knownData());
    // What a browser would fetch: src=, href= (but for places in the page), url(), @import, fetch.
    const std::regex fetched(
        R"re((src|srcset|poster|action|href)\s*=\s*["']?\s*(https?:|//)|@import|url\(\s*["']?(https?:|//)|fetch\(|XMLHttpRequest|WebSocket|import\()re");
    std::smatch match;
    EXPECT_FALSE(std::regex_search(page, match, fetched)) << match.str();
    EXPECT_THAT(page, HasSubstr("default-src 'none'"));
    EXPECT_THAT(page, Not(HasSubstr("<link")));
}

TEST(ReportPage, SaysWhatToRunWherePlotlyIsMissing) {
    const char* const set = std::getenv("HAIRBENCH_PLOTLY");
    const std::string before = set ? set : "";
    setenv("HAIRBENCH_PLOTLY", "/nowhere/plotly.min.js", 1);
    std::string said;
    try {
        commands::writeReportPage({});
    } catch (const engine::Error& error) {
        said = error.what();
    }
    setenv("HAIRBENCH_PLOTLY", before.c_str(), 1);  // empty: as if it were not set
    EXPECT_THAT(said, HasSubstr("scripts/setup --report"));
    EXPECT_THAT(said, Not(HasSubstr("\n")));
}

TEST(ReportPage, IsOneFileWithTheWholeOfPlotly) {
    if (!findPlotly())
        return skipWithout(Need::report, "no Plotly; scripts/setup --report installs it");
    const TemporaryFolder folder;
    const auto report = writeWithPictures(knownReport(), folder.path() / "a.json", 200);
    const auto page = folder.path() / "new/page.html";
    EXPECT_EQ(commands::writeReportPage({.reports = {report}, .out = page}), 0);
    EXPECT_GT(std::filesystem::file_size(page), std::filesystem::file_size(*findPlotly()));
}

}  // namespace
}  // namespace benchmarks::report
