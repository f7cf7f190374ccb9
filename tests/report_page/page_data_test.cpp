// What a page knows of its reports.
#include "benchmarks/report/page.h"

#include <array>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "engine/error.h"
#include "tests/report_page/sample_reports.h"
#include "tests/temporary_folder.h"

namespace benchmarks::report {
namespace {

using report_page::knownReport;
using report_page::writeWithPictures;
using testing::HasSubstr;

// RFC 4648, section 10.
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
    EXPECT_FALSE(of_a[5].contains("picture_id"));  // was skipped
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

TEST(PageData, ComparesTheFirstReportWithEachOther) {
    const TemporaryFolder folder;
    const std::array files{
        writeWithPictures(knownReport(), folder.path() / "a.json", 200),
        writeWithPictures(knownReport(1.5), folder.path() / "b.json", 200),
        writeWithPictures(knownReport(), folder.path() / "c.json", 200)};
    const scene::Json data = pageData(files);
    ASSERT_EQ(data.at("comparisons").size(), 2u);
    // Half as slow again, of samples within 1 %.
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
        pageData({{HAIRBENCH_SOURCE_DIR "/results/simulation_scale-llvmpipe-76a39ca40bba.json"}});
    EXPECT_EQ(data.at("reports")[0].at("schema"), "hairbench-report/1.0.0");
    EXPECT_EQ(data.at("title"), "simulation_scale");
}

}  // namespace
}  // namespace benchmarks::report
