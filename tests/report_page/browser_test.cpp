// Tests what readers see and do on a page, in headless Chromium.
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/report_page/page_in_browser.h"
#include "tests/report_page/sample_reports.h"

namespace benchmarks::report {
namespace {

using scene::Json;
using testing::HasSubstr;

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
    // Each median comes from few, evenly spread samples, so it is off by up to 0.01 %.
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
    EXPECT_EQ(said.at("samples"), Json::parse(R"([["scatter",60],["bar",30]])"));
    // Coloured by density. In time and error, (3.25, 1/16) beats all except (47, 1/32).
    EXPECT_EQ(
        said.at("quality"),
        Json::parse(R"([["markers",2],["markers",2],["markers",1],["lines",2]])"));
}

// Two cases have a probe; a third has none, and no line. The axis is in simulated seconds.
TEST_F(PageInBrowser, PlotsProbesOverTime) {
    Report report = knownReport();
    for (std::size_t i = 0; i < 2; ++i) {
        const double depth = 0.001 * static_cast<double>(i + 1);
        report.cases[i].metrics.push_back({metricNamed("probe.time"), {0.0, 0.5, 1.0}});
        report.cases[i].metrics.push_back(
            {metricNamed("probe.penetration"), {0.0, depth, 2.0 * depth}});
    }
    const Json said = open({writeWithPictures(report, folder_.file("a.json"), 200)}, R"(
        say("lines", figure("probes-probe-penetration").map((each) => [[...each.x], [...each.y]]));
        const layout = document.getElementById("probes-probe-penetration").layout;
        say("titles", [layout.title.text, layout.xaxis.title.text, layout.yaxis.title.text]);
        say("note", document.getElementById("probes-note").textContent);
    )");
    EXPECT_EQ(
        said.at("lines"),
        Json::parse("[[[0.0,0.5,1.0],[0.0,0.001,0.002]],[[0.0,0.5,1.0],[0.0,0.002,0.004]]]"));
    EXPECT_EQ(said.at("titles"), Json({"probe.penetration", "simulated time (s)", "m"}));
    EXPECT_THAT(said.at("note").get<std::string>(), HasSubstr("Lines: density"));
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
    // Medians are within 0.1 % and have four digits. The skipped case has none and comes last.
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

// kWarning of the case 16, 1 is one for which it is not to be trusted.
TEST_F(PageInBrowser, SaysHowFarCasesCanBeTrusted) {
    const Json said = one(R"(
        const titles = [...document.querySelectorAll("#cases-table thead button")];
        const at = (title) => titles.findIndex((each) => each.textContent.trim() === title);
        say("head", [...document.querySelectorAll("#reports .badge")].map((each) => each.textContent));
        say("trust", column("cases-table", at("trust")));
        say("reasons", column("cases-table", at("reasons, warnings"))[2]);
        say("findings", [...document.querySelectorAll("#findings summary")].map(
            (each) => each.textContent));
        say("open", figure("scaling-plot").flatMap((each) => each.marker.symbol).filter(
            (symbol) => symbol.endsWith("-open")).length);
        say("rate", titles[at("fps")].title);
        document.querySelector('.chip[data-filter="trust"][data-value="untrusted"]').click();
        await settle();
        say("left", column("cases-table", 0).length);
    )");
    EXPECT_EQ(said.at("head"), Json({"5 ok: 4 trusted, 1 untrusted", "1 skipped"}));
    EXPECT_EQ(
        said.at("trust"), Json({"trusted", "trusted", "untrusted", "trusted", "trusted", ""}));
    EXPECT_THAT(
        said.at("reasons").get<std::string>(),
        HasSubstr("pass times: timestamps differ from the CPU's clock"));
    EXPECT_EQ(said.at("findings")[0], "\u26a0 1 case is not trusted: 1 untrusted");
    EXPECT_EQ(said.at("open"), 1);
    EXPECT_THAT(said.at("rate").get<std::string>(), HasSubstr("mean rate"));
    EXPECT_EQ(said.at("left"), 5);
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
    EXPECT_EQ(said.at("regex"), Json({4, 3, 3, 3}));  // 8, 1; 8, 4; 32, 1; and 32, 4, which was
                                                      // skipped
    EXPECT_EQ(said.at("reason"), Json({1, 0, 0, 0}));
    EXPECT_EQ(said.at("malformed"), Json({0, 0, 0, 0}));  // a text that no case contains
    EXPECT_EQ(said.at("axis"), Json({3, 3, 3, 3}));
    EXPECT_EQ(said.at("count"), "3 of 6 cases");
    EXPECT_EQ(said.at("reset"), Json({6, 5, 5, 5}));
}

// Tied axes change together, so one of them on x gives one line, not one per point.
TEST_F(PageInBrowser, DrawsOneLineOverTiedAxes) {
    Report report = oneCaseReport("0", {});
    report.cases.clear();
    for (const int step : {1, 2, 4})
        for (const int msaa : {1, 4})
            report.cases.push_back(oneCaseReport(
                                       std::to_string(step) + "/" + std::to_string(msaa),
                                       {{"/groom/guides", scene::Document(100 * step)},
                                        {"/groom/grow/vertices", scene::Document(32 / step)},
                                        {"/render/msaa", scene::Document(msaa)}})
                                       .cases[0]);
    const Json said = open({folder_.write("tied.json", reportJson(report).dump())}, R"(
        say("x", figure("scaling-plot").map((each) => [...each.x]));
        say("colour", [...document.getElementById("scaling-color").options].map(
            (each) => each.textContent));
        say("passes", figure("passes-plot").map((each) => each.name));
    )");
    EXPECT_EQ(said.at("x"), Json::parse("[[100,200,400],[100,200,400]]"));
    EXPECT_EQ(said.at("colour"), Json({"none", "msaa"}));
    EXPECT_EQ(said.at("passes"), Json({"strands"}));  // its CPU time is not a pass
}

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
    EXPECT_THAT(said.at("clip").get<std::string>(), HasSubstr("75%"));  // a quarter is visible
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
    // frame.time and three passes of five cases, each 1.5 times as slow.
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
        const spread = async (kind) => {
            await choose("samples-kind", kind);
            return figure("samples-plot")[1];
        };
        say("counts", [...(await spread("histogram")).x]);
        const {x, y} = await spread("cumulative");
        say("cumulative", [x.length, x[29], y[0], x[59], y[59]]);
        const box = (await spread("box")).y.filter((each) => each !== null);
        say("box", [Math.min(...box), Math.max(...box)]);
    )");
    EXPECT_EQ(said.at("name"), "known/density:16/msaa:4");
    EXPECT_NEAR(said.at("least").get<double>(), 0.99 * 3.25, 1e-3 * 3.25);
    // 60 multiples of the golden ratio, from 1 % below to 1 % above 3.25 ms. By the three-gap
    // theorem, gaps are at most 0.0213 of the width, and 0.0131 except in five places, so each of
    // 30 bins has one to three samples.
    int count = 0;
    for (const Json& each : said.at("counts")) {
        EXPECT_NEAR(each.get<int>(), 2, 1);
        count += each.get<int>();
    }
    EXPECT_EQ(count, 60);
    EXPECT_EQ(said.at("cumulative")[0], 60);
    EXPECT_EQ(said.at("cumulative")[1], 50.0);
    EXPECT_NEAR(said.at("cumulative")[2].get<double>(), 0.99 * 3.25, 1e-3 * 3.25);
    EXPECT_EQ(said.at("cumulative")[3], 100.0);
    EXPECT_NEAR(said.at("cumulative")[4].get<double>(), 1.01 * 3.25, 1e-3 * 3.25);
    // From the 5th to the 95th percentile: 90 % of the width, off by at most one gap.
    EXPECT_NEAR(said.at("box")[0].get<double>(), 0.991 * 3.25, 0.0213 * 0.02 * 3.25);
    EXPECT_NEAR(said.at("box")[1].get<double>(), 1.009 * 3.25, 0.0213 * 0.02 * 3.25);
}

// Names, values, reasons and descriptions are plain text, whatever they contain.
TEST_F(PageInBrowser, RunsNothingThatIsInAReport) {
    const std::string evil = "</script><img src=x onerror=window.pwned=1><b>\"\u6f22\u00fc\"</b>";
    Report report = oneCaseReport(evil, {{"/a<i>/" + evil, scene::Document(evil)}});
    report.cases.push_back(
        oneCaseReport("other", {{"/a<i>/" + evil, scene::Document("plain")}}).cases[0]);
    report.cases[0].trust.warnings = {evil};
    report.scene.document = scene::Document(Json{{"description", evil}});
    const auto file = folder_.write("evil.json", reportJson(report).dump());
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
            500);  // minimum width of headless Chromium
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
    // Plotly's default list also has "Share chart...".
    const std::set<std::string> local{"Download plot", "Zoom",     "Pan",
                                      "Zoom in",       "Zoom out", "Reset axes"};
    ASSERT_FALSE(said.at("buttons").empty());
    for (const Json& each : said.at("buttons"))
        EXPECT_TRUE(local.contains(each.get<std::string>())) << each;
}

// Has five axes and 108 cases.
TEST_F(PageInBrowser, ShowsTheThesisReport) {
    const Json said = open(
        {HAIRBENCH_SOURCE_DIR "/results/thesis-llvmpipe-0cec23f6b53c.json"}, R"(
        say("rows", column("cases-table", 0).length);
        say("lines", figure("scaling-plot").length);
        await choose("scaling-facet", "/lod/level");
        await choose("scaling-held-/render/msaa", "");
        say("faceted", figure("scaling-plot").length);
        await choose("passes-limit", "1000");
        say("bars", figure("passes-plot")[0].x.length);
    )",
        1280);
    EXPECT_EQ(said.at("rows"), 108);
    EXPECT_EQ(said.at("lines"), 3);
    // Density is on x, because no axis has more values.
    EXPECT_EQ(said.at("faceted"), 3 * 3 * 2);  // tessellation factors, levels, sample counts
    EXPECT_EQ(said.at("bars"), 108);
}

}  // namespace
}  // namespace benchmarks::report
