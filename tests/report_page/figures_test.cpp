// Figures, tables and the filter in headless Chromium.
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/report_page/page_in_browser.h"
#include "tests/report_page/sample_reports.h"

namespace report_page {
namespace {

using benchmarks::scene::Json;

TEST_F(PageInBrowser, PlotsTheReportsFigures) {
    const Json said = one(R"(
        await choose("scaling-x", "/strands/density");
        await choose("scaling-color", "/render/msaa");
        say("lines", figure("scaling-plot").map((each) => [each.name, [...each.x], [...each.y]]));
        say("bars", figure("scaling-plot")[0].error_y.array.every((each) => each > 0));
        say("passes", figure("passes-plot").map((each) => [each.name, each.x.length]));
        say("strands", figure("passes-plot")[1].x[4]);
        say("samples", figure("samples-plot").map((each) => [each.type, each.y.length]));
        say("quality", figure("quality-plot").map((each) => [each.mode, each.x.length]));
    )");
    // Each median is that of evenly spread samples, 0.01 % off at most by their finite number.
    ASSERT_EQ(said.at("lines").size(), 2u);
    EXPECT_EQ(said.at("lines")[0][0], "1");
    EXPECT_EQ(said.at("lines")[0][1], Json({8, 16, 32}));
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(
            said.at("lines")[0][2][i].get<double>(), kKnown[2 * i].frame_ms,
            1e-3 * kKnown[2 * i].frame_ms);
    EXPECT_EQ(said.at("lines")[1][1], Json({8, 16}));
    EXPECT_EQ(said.at("bars"), true);
    EXPECT_EQ(said.at("passes"), Json::parse(R"([["simulate",5],["strands",5],["resolve",5]])"));
    EXPECT_NEAR(said.at("strands").get<double>(), 0.7 * 47.0, 1e-3 * 47.0);
    EXPECT_EQ(said.at("samples"), Json::parse(R"([["scatter",60],["histogram",60]])"));
    // Coloured by density. In time and error (3.25, 1/16) beats all but (47, 1/32).
    EXPECT_EQ(
        said.at("quality"),
        Json::parse(R"([["markers",2],["markers",2],["markers",1],["lines",2]])"));
}

TEST_F(PageInBrowser, SortsByNumberAndByText) {
    const Json said = one(R"(
        const titles = [...document.querySelectorAll("#cases-table thead button")];
        const at = (title) => titles.findIndex((each) => each.textContent.trim() === title);
        const press = async (title) => {
            document.querySelectorAll("#cases-table thead button")[at(title)].click();
            await settle();
            return column("cases-table", at(title));
        };
        say("sweep", column("cases-table", at("frame ms")));
        say("up", await press("frame ms"));
        say("down", await press("frame ms"));
        say("status", await press("status"));
        say("sorted", document.querySelectorAll("#cases-table [aria-sort=ascending]").length);
    )");
    const auto numbers = [&](const char* name) {
        std::vector<double> values;
        for (const Json& each : said.at(name))
            values.push_back(each == "" ? -1.0 : std::stod(each.get<std::string>()));
        return values;
    };
    // Four digits, of medians within 0.1 %; the skipped case has none and comes last.
    const auto about = [](double value) {
        return testing::DoubleNear(value, 2e-3 * std::abs(value));
    };
    using testing::ElementsAre;
    EXPECT_THAT(
        numbers("sweep"),
        ElementsAre(about(9.5), about(100), about(20), about(3.25), about(47), about(-1)));
    EXPECT_THAT(
        numbers("up"),
        ElementsAre(about(3.25), about(9.5), about(20), about(47), about(100), about(-1)));
    EXPECT_THAT(
        numbers("down"),
        ElementsAre(about(100), about(47), about(20), about(9.5), about(3.25), about(-1)));
    EXPECT_EQ(said.at("status"), Json({"ok", "ok", "ok", "ok", "ok", "skipped"}));
    EXPECT_EQ(said.at("sorted"), 1);
}

TEST_F(PageInBrowser, FiltersTablesAndPlots) {
    const Json said = one(R"(
        const look = () => [column("cases-table", 0).length,
            Math.max(0, ...figure("passes-plot").map((each) => each.x.length)),
            figure("scaling-plot").reduce((sum, each) => sum + each.x.length, 0),
            document.querySelectorAll("#thumbnails img").length];
        say("all", look());
        await type("filter-text", "density:(8|32)/");
        say("regex", look());
        await type("filter-text", "4-SAMPLE images");
        say("reason", look());
        await type("filter-text", "*(");
        say("malformed", look());
        document.getElementById("filter-reset").click();
        await settle();
        document.querySelector('.chip[data-filter="/render/msaa"][data-value="4"]').click();
        await settle();
        say("axis", look());
        say("count", document.getElementById("filter-count").textContent);
        document.getElementById("filter-reset").click();
        await settle();
        say("reset", look());
    )");
    EXPECT_EQ(said.at("all"), Json({6, 5, 5, 5}));
    EXPECT_EQ(said.at("regex"), Json({4, 3, 3, 3}));  // 8, 1; 8, 4; 32, 1; and 32, 4 was skipped
    EXPECT_EQ(said.at("reason"), Json({1, 0, 0, 0}));
    EXPECT_EQ(said.at("malformed"), Json({0, 0, 0, 0}));  // a text that no case has
    EXPECT_EQ(said.at("axis"), Json({3, 3, 3, 3}));
    EXPECT_EQ(said.at("count"), "3 of 6 cases");
    EXPECT_EQ(said.at("reset"), Json({6, 5, 5, 5}));
}

// Axes that are tied move together: one of them on x is one line, not one a point.
TEST_F(PageInBrowser, DrawsOneLineOverTiedAxes) {
    benchmarks::report::Report report = oneCaseReport("0", {});
    report.cases.clear();
    for (const int step : {1, 2, 4})
        for (const int msaa : {1, 4})
            report.cases.push_back(
                oneCaseReport(
                    std::to_string(step) + "/" + std::to_string(msaa),
                    {{"/groom/guides", benchmarks::scene::Document(100 * step)},
                     {"/groom/grow/vertices", benchmarks::scene::Document(32 / step)},
                     {"/render/msaa", benchmarks::scene::Document(msaa)}})
                    .cases[0]);
    const Json said = open({folder_.write("tied.json", benchmarks::report::reportText(report))}, R"(
        say("x", figure("scaling-plot").map((each) => [...each.x]));
        say("colour", [...document.getElementById("scaling-color").options].map(
            (each) => each.textContent));
        say("passes", figure("passes-plot").map((each) => each.name));
    )");
    EXPECT_EQ(said.at("x"), Json::parse("[[100,200,400],[100,200,400]]"));
    EXPECT_EQ(said.at("colour"), Json({"none", "msaa"}));
    EXPECT_EQ(said.at("passes"), Json({"strands"}));  // its CPU time is no pass
}

}  // namespace
}  // namespace report_page
