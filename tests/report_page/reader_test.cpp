// What else a reader does with the page, in headless Chromium.
#include <set>
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
using testing::HasSubstr;

TEST_F(PageInBrowser, ChangesTheThemeOfPageAndPlots) {
    const Json said = one(R"(
        const look = () => [document.documentElement.dataset.theme,
            getComputedStyle(document.body).backgroundColor,
            document.getElementById("scaling-plot")._fullLayout.paper_bgcolor];
        say("before", look());
        document.getElementById("theme").click();
        await settle();
        say("after", look());
        document.getElementById("theme").click();
        await settle();
        say("again", look());
    )");
    for (int i = 0; i < 3; ++i) EXPECT_NE(said.at("before")[i], said.at("after")[i]) << i;
    EXPECT_EQ(said.at("before"), said.at("again"));
}

TEST_F(PageInBrowser, HoldsTwoPicturesAgainstEachOther) {
    const Json said = two(R"(
        const slider = document.getElementById("picture-slider");
        slider.value = 25;
        slider.dispatchEvent(new Event("input"));
        const [below, over] = document.querySelectorAll(".wipe img");
        await over.decode();
        say("size", [over.naturalWidth, over.naturalHeight]);
        say("differ", below.src !== over.src);
        say("clip", getComputedStyle(over).clipPath);
        await choose("picture-mode", "pair");
        say("pair", document.querySelectorAll("#picture-view img").length);
        await choose("picture-mode", "difference");
        say("difference", document.querySelectorAll("#picture-view .difference img").length);
        say("thumbnails", document.querySelectorAll("#thumbnails img").length);
    )");
    EXPECT_EQ(said.at("size"), Json({4, 2}));
    EXPECT_EQ(said.at("differ"), true);
    EXPECT_THAT(said.at("clip").get<std::string>(), HasSubstr("75%"));  // a quarter is left
    EXPECT_EQ(said.at("pair"), 2);
    EXPECT_EQ(said.at("difference"), 2);
    EXPECT_EQ(said.at("thumbnails"), 10);  // five cases of two reports
}

TEST_F(PageInBrowser, ShowsTheVerdictsOfCompare) {
    const Json said = two(R"(
        const titles = [...document.querySelectorAll("#comparison-table thead button")].map(
            (each) => each.textContent.trim());
        say("verdicts", column("comparison-table", titles.indexOf("verdict")));
        say("changes", column("comparison-table", titles.indexOf("change")));
        say("plot", figure("comparison-plot").map((each) => [each.name, each.x.length]));
        document.querySelector('.chip[data-verdict="regressed"]').click();
        await settle();
        say("hidden", column("comparison-table", 0).length);
        say("lines", figure("scaling-plot").length);
        say("odd", document.querySelector("main").textContent.match(/\[object|undefined|NaN/));
    )");
    EXPECT_EQ(said.at("odd"), nullptr);
    // frame.time and three passes of five cases, each half as slow again.
    EXPECT_EQ(said.at("verdicts"), Json(std::vector<std::string>(20, "\u25b2 regressed")));
    EXPECT_EQ(said.at("changes"), Json(std::vector<std::string>(20, "+50.0 %")));
    EXPECT_EQ(said.at("plot"), Json::parse("[[\"\u25b2 regressed\",20]]"));
    EXPECT_EQ(said.at("hidden"), 0);
    EXPECT_EQ(said.at("lines"), 4);  // A and B, one and four samples
}

TEST_F(PageInBrowser, ShowsTheSamplesOfTheCaseThatIsAskedFor) {
    const Json said = one(R"(
        document.querySelectorAll("#cases-table tbody tr")[3].querySelector("button").click();
        await settle();
        say("name", document.getElementById("samples-name").value);
        say("least", Math.min(...figure("samples-plot")[0].y));
        for (const kind of ["violin", "box"]) {
            await choose("samples-kind", kind);
            say(kind, figure("samples-plot")[1].type);
        }
    )");
    EXPECT_EQ(said.at("name"), "known/density:16/msaa:4");
    EXPECT_NEAR(said.at("least").get<double>(), 0.99 * 3.25, 1e-3 * 3.25);
    EXPECT_EQ(said.at("violin"), "violin");
    EXPECT_EQ(said.at("box"), "box");
}

// Names, values, reasons and descriptions are texts, whatever is in them.
TEST_F(PageInBrowser, RunsNothingThatIsInAReport) {
    const std::string evil = "</script><img src=x onerror=window.pwned=1><b>\"\u6f22\u00fc\"</b>";
    benchmarks::report::Report report =
        oneCaseReport(evil, {{"/a<i>/" + evil, benchmarks::scene::Document(evil)}});
    report.cases.push_back(
        oneCaseReport("other", {{"/a<i>/" + evil, benchmarks::scene::Document("plain")}}).cases[0]);
    report.cases[0].trust.warnings = {evil};
    report.scene.document = benchmarks::scene::Document(Json{{"description", evil}});
    const auto file = folder_.write("evil.json", benchmarks::report::reportText(report));
    const Json said = open(
        {file}, R"(
        await settle();
        say("pwned", window.pwned);
        say("description", document.getElementById("description").textContent);
        say("images", document.querySelectorAll("main img, main b, main i").length);
        say("name", column("cases-table", 1)[0]);
        say("ticks", document.querySelector("#passes-plot") === null);
    )",
        1280);
    EXPECT_EQ(said.at("pwned"), nullptr);
    EXPECT_EQ(said.at("description"), evil);
    EXPECT_EQ(said.at("images"), 0);
    EXPECT_EQ(said.at("name"), evil);
}

TEST_F(PageInBrowser, FitsANarrowWindow) {
    const Json said =
        one(R"(
        await settle();
        say("wider", document.documentElement.scrollWidth - innerWidth);
        say("width", innerWidth);
        say("plot", document.getElementById("scaling-plot")._fullLayout.width <= innerWidth);
    )",
            500);  // headless Chromium's narrowest
    EXPECT_LE(said.at("width"), 500);
    EXPECT_LE(said.at("wider"), 0);
    EXPECT_EQ(said.at("plot"), true);
}

TEST_F(PageInBrowser, OffersToSendNothingAway) {
    const Json said = one(R"(
        await settle();
        say("buttons", [...document.querySelectorAll(".modebar-btn")].map(
            (each) => each.dataset.title ?? each.getAttribute("aria-label") ?? ""));
    )");
    // Plotly's own list has "Share chart..." too.
    const std::set<std::string> local{"Download plot", "Zoom",     "Pan",
                                      "Zoom in",       "Zoom out", "Reset axes"};
    ASSERT_FALSE(said.at("buttons").empty());
    for (const Json& each : said.at("buttons"))
        EXPECT_TRUE(local.contains(each.get<std::string>())) << each;
}

// Of schema 1.0.0, with five axes, 162 cases and 81 that were skipped.
TEST_F(PageInBrowser, ShowsTheThesisReport) {
    const Json said = open(
        {HAIRBENCH_SOURCE_DIR "/results/thesis-llvmpipe-fd212b702fde.json"}, R"(
        say("rows", column("cases-table", 0).length);
        say("lines", figure("scaling-plot").length);
        await choose("scaling-facet", "/strands/tessellation");
        await choose("scaling-held-/render/msaa", "");
        say("faceted", figure("scaling-plot").length);
        await choose("passes-limit", "1000");
        say("bars", figure("passes-plot")[0].x.length);
    )",
        1280);
    EXPECT_EQ(said.at("rows"), 243);
    EXPECT_EQ(said.at("lines"), 3);
    EXPECT_EQ(said.at("faceted"), 3 * 3 * 2);  // densities, tessellations, samples
    EXPECT_EQ(said.at("bars"), 162);
}

}  // namespace
}  // namespace report_page
