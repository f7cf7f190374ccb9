// Tests the page's data about its reports, and properties of its text, without a browser.
#include "benchmarks/report/page.h"

#include <array>
#include <cstdlib>
#include <filesystem>
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

using testing::HasSubstr;
using testing::Not;

constexpr const char* kHostile = "</script><script>window.pwned = 1</script><!-- \"quoted\" \u00fc";

// Returns a page with a comment instead of Plotly, which contains addresses of map tiles.
std::string pageWithoutPlotly(const scene::Json& data) {
    return assemblePage(readPageParts("/* plotly */"), data);
}

scene::Json knownData() {
    const TemporaryFolder folder;
    return pageData({{writeWithPictures(knownReport(), folder.path() / "a.json", 200)}});
}

// From RFC 4648, section 10.
TEST(Base64, IsThatOfTheStandardsTestVectors) {
    const std::array<std::pair<const char*, const char*>, 7> vectors{
        {{"", ""},
         {"f", "Zg=="},
         {"fo", "Zm8="},
         {"foo", "Zm9v"},
         {"foob", "Zm9vYg=="},
         {"fooba", "Zm9vYmE="},
         {"foobar", "Zm9vYmFy"}}};
    for (const auto& [bytes, text] : vectors) EXPECT_EQ(base64(bytes), text);
    EXPECT_EQ(base64("\xff\xfe\xfb"), "//77");  // bits 111111 111111 111011 111011
}

TEST(PictureUri, TakesPicturesOnly) {
    const TemporaryFolder folder;
    std::ofstream(folder.path() / "text.png") << "no picture";
    EXPECT_EQ(pictureUri(folder.path() / "text.png"), std::nullopt);
    EXPECT_EQ(pictureUri(folder.path() / "nothing.png"), std::nullopt);
    EXPECT_EQ(pictureUri(folder.path()), std::nullopt);
    std::ofstream(folder.path() / "a.png") << "\x89PNG\r\n";
    EXPECT_EQ(pictureUri(folder.path() / "a.png"), "data:image/png;base64,iVBORw0K");
}

TEST(PageData, KeepsEqualPicturesOnce) {
    const TemporaryFolder folder;
    const std::array files{
        writeWithPictures(knownReport(), folder.path() / "a.json", 200),
        writeWithPictures(knownReport(), folder.path() / "b.json", 100)};
    const scene::Json data = pageData(files);
    EXPECT_EQ(data.at("pictures").size(), 2u);
    const scene::Json& of_a = data.at("reports")[0].at("cases");
    const scene::Json& of_b = data.at("reports")[1].at("cases");
    EXPECT_EQ(of_a[0].at("picture_id"), of_a[1].at("picture_id"));
    EXPECT_NE(of_a[0].at("picture_id"), of_b[0].at("picture_id"));
    EXPECT_FALSE(of_a[5].contains("picture_id"));  // skipped
}

TEST(PageData, SaysWhichPicturesAreMissing) {
    const TemporaryFolder folder;
    const auto file = writeWithPictures(knownReport(), folder.path() / "a.json", 200);
    std::filesystem::remove(folder.path() / "a.pictures/1.png");
    const scene::Json data = pageData({{file}});
    const scene::Json& cases = data.at("reports")[0].at("cases");
    EXPECT_EQ(cases[1].at("picture_missing"), "a.pictures/1.png");
    EXPECT_FALSE(cases[0].contains("picture_missing"));
}

// A report may name any file of this machine, and pages are published.
TEST(PageData, TakesPicturesOfTheReportsOwnFolderOnly) {
    const TemporaryFolder folder;
    const std::filesystem::path own = folder.path() / "own";
    const auto file = writeWithPictures(knownReport(), own / "a.json", 200);
    const std::filesystem::path picture = own / "a.pictures/0.png";
    std::filesystem::create_directories(folder.path() / "home.pictures");
    for (const auto& copy :
         {folder.path() / "private.png", folder.path() / "home.pictures/1.png", own / "1.png"})
        std::filesystem::copy_file(picture, copy);
    std::filesystem::create_symlink("../../private.png", own / "a.pictures/90.png");
    std::filesystem::create_directory_symlink("../home.pictures", own / "b.pictures");
    const std::vector<std::string> names{
        "../private.png",
        "../home.pictures/1.png",
        "1.png",
        "a.pictures/90.png",
        "b.pictures/1.png",
        "a.pictures/../1.png",
        "./a.pictures/0.png",
        (folder.path() / "private.png").string()};
    for (const std::string& name : names) {
        Report report = knownReport();
        report.cases[0].picture = name;
        std::ofstream(own / "c.json") << reportJson(report);
        const auto data = pageData({{own / "c.json"}});
        EXPECT_EQ(data.at("reports")[0].at("cases")[0].value("picture_missing", ""), name);
        EXPECT_TRUE(data.at("pictures").empty()) << name;
    }
    EXPECT_FALSE(pageData({{file}}).at("pictures").empty());
}

TEST(Page, MayNeitherSendFormsNorMoveItsBase) {
    const std::string page = pageWithoutPlotly(knownData());
    EXPECT_THAT(page, HasSubstr("base-uri 'none'"));
    EXPECT_THAT(page, HasSubstr("form-action 'none'"));
}

TEST(PageData, ComparesTheFirstReportWithEachOther) {
    const TemporaryFolder folder;
    const std::array files{
        writeWithPictures(knownReport(), folder.path() / "a.json", 200),
        writeWithPictures(knownReport(1.5), folder.path() / "b.json", 200),
        writeWithPictures(knownReport(), folder.path() / "c.json", 200)};
    const scene::Json data = pageData(files);
    ASSERT_EQ(data.at("comparisons").size(), 2u);
    // 1.5 times as slow, with samples within 1 %.
    EXPECT_EQ(data.at("comparisons")[0].at("verdict"), "regressed");
    EXPECT_EQ(data.at("comparisons")[0].at("b"), "b.json");
    EXPECT_EQ(data.at("comparisons")[1].at("verdict"), "same");
    EXPECT_EQ(data.at("reports")[2].at("label"), "C");
    EXPECT_EQ(data.at("title"), "known");
}

TEST(PageData, NamesTheFileThatIsNoReport) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "other.json";
    std::ofstream(file) << "{}";
    try {
        pageData({{file}});
        FAIL() << "was read";
    } catch (const engine::Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("other.json"));
    }
}

TEST(PageData, ReadsReportsOfTheFirstVersion) {
    const scene::Json data =
        pageData({{HAIRBENCH_SOURCE_DIR "/tests/fuzz/seeds/report/simulation_scale_76a3_1.json"}});
    EXPECT_EQ(data.at("reports")[0].at("schema"), "hairbench-report/1.0.0");
    EXPECT_EQ(data.at("title"), "simulation_scale");
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
    // Constructs that make a browser fetch: src=, href= (except within the page), url(), @import,
    // fetch.
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
    setenv("HAIRBENCH_PLOTLY", before.c_str(), 1);  // an empty value counts as unset
    EXPECT_THAT(said, HasSubstr("scripts/setup fetches it"));
    EXPECT_THAT(said, Not(HasSubstr("\n")));
}

TEST(ReportPage, IsOneFileWithTheWholeOfPlotly) {
    if (!findPlotly()) return skipWithout(Need::report, "no Plotly; scripts/setup fetches it");
    const TemporaryFolder folder;
    const auto report = writeWithPictures(knownReport(), folder.path() / "a.json", 200);
    const auto page = folder.path() / "new/page.html";
    EXPECT_EQ(commands::writeReportPage({.reports = {report}, .out = page}), 0);
    EXPECT_GT(std::filesystem::file_size(page), std::filesystem::file_size(*findPlotly()));
}

}  // namespace
}  // namespace benchmarks::report
