// Tests the comparison of a report's back ends: the computed figures, and what the page shows.
#include "benchmarks/report/table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/report_page/page_in_browser.h"
#include "tests/report_page/sample_reports.h"

namespace benchmarks::report {
namespace {

using scene::Json;

const Json& caseNamed(const Json& report, const std::string& name) {
    for (const Json& each : report.at("cases"))
        if (each.at("name") == name) return each;
    throw std::runtime_error(name);
}

TEST(BackendFigures, HaveTheExponentsOfTheReport) {
    const auto figures = compareBackends(reportJson(backendReport()));
    ASSERT_TRUE(figures);
    ASSERT_EQ(figures->lines.size(), 4u);  // two back ends with 1 and 4 samples; 8 samples were
                                           // skipped
    for (const BackendLine& line : figures->lines) {
        const KnownLaw& known = line.backend == "software" ? kSoftwareLaw : kTessellationLaw;
        ASSERT_EQ(line.held.size(), 1u);
        EXPECT_EQ(line.held[0].first, "/render/msaa");
        const double slower = line.held[0].second.json() == 4 ? 2.0 : 1.0;
        ASSERT_EQ(line.points.size(), 3u);
        EXPECT_EQ(line.points[0].strands, 640.0);
        EXPECT_EQ(line.points[2].strands, 64000.0);
        ASSERT_TRUE(line.law);
        EXPECT_NEAR(line.law->exponent, known.exponent, 1e-9);
        EXPECT_NEAR(line.law->lower, known.exponent, 1e-6);
        EXPECT_NEAR(line.law->upper, known.exponent, 1e-6);
        // Medians differ by at most 0.1 % from the centre of their samples.
        EXPECT_NEAR(line.law->factor, slower * known.factor, 2e-3 * slower * known.factor);
    }
}

TEST(BackendFigures, HaveRatiosToTessellationWithIntervals) {
    const Json report = reportJson(backendReport());
    const auto figures = compareBackends(report);
    ASSERT_TRUE(figures);
    EXPECT_EQ(figures->ratios.size(), 12u);
    const std::string name = "backends/guides:100/msaa:4/backend:";
    const auto found = std::ranges::find(figures->ratios, name + "software", &BackendRatio::name);
    ASSERT_NE(found, figures->ratios.end());
    const double known = kSoftwareLaw.factor * std::pow(6400.0, kSoftwareLaw.exponent) /
                         (kTessellationLaw.factor * std::pow(6400.0, kTessellationLaw.exponent));
    EXPECT_NEAR(found->ratio, known, 1e-9 * known);
    const auto interval = [&](const char* backend, const char* end) {
        return caseNamed(report, name + backend)
            .at("metrics")
            .at("strands.time")
            .at("interval")
            .at(end)
            .get<double>();
    };
    ASSERT_TRUE(found->lower && found->upper);
    EXPECT_DOUBLE_EQ(
        *found->lower, interval("software", "lower") / interval("tessellation", "upper"));
    EXPECT_DOUBLE_EQ(
        *found->upper, interval("software", "upper") / interval("tessellation", "lower"));
    EXPECT_NEAR(
        found->confidence,
        interval("software", "confidence") + interval("tessellation", "confidence") - 1.0, 1e-12);
    const auto itself =
        std::ranges::find(figures->ratios, name + "tessellation", &BackendRatio::name);
    ASSERT_NE(itself, figures->ratios.end());
    EXPECT_EQ(itself->ratio, 1.0);
}

// Without /run/compare_backends, the two passes' medians are added.
TEST(BackendFigures, AddThePassesWhereTheirSumIsNotThere) {
    Report report = oneCaseReport("a", {{kBackendAxis, scene::Document("software")}});
    report.cases[0].metrics.push_back({ofPass("points", Measured::time), {0.25}, Mode::isolated});
    report.cases[0].counts = {{"strands", 10}};
    report.cases.push_back(
        oneCaseReport("b", {{kBackendAxis, scene::Document("tessellation")}}).cases[0]);
    report.cases[1].counts = {{"strands", 10}};
    const auto figures = compareBackends(reportJson(report));
    ASSERT_TRUE(figures);
    ASSERT_EQ(figures->ratios.size(), 2u);
    EXPECT_NEAR(figures->ratios[0].ratio, (0.5 + 0.25) / 0.5, 1e-3);
    EXPECT_FALSE(figures->ratios[0].lower);
    ASSERT_EQ(figures->lines.size(), 2u);
    EXPECT_FALSE(figures->lines[0].law);  // only one strand count
}

TEST(BackendFigures, AreAbsentOfOneBackend) {
    EXPECT_FALSE(compareBackends(reportJson(knownReport())));
    EXPECT_FALSE(compareBackends(
        reportJson(oneCaseReport("a", {{kBackendAxis, scene::Document("software")}}))));
}

TEST_F(PageInBrowser, ComparesBackends) {
    const Json said = open(
        {folder_.write("backends.json", reportJson(backendReport()).dump())}, R"(
        say("plot", figure("backends-plot").map((each) => [each.name ?? "", each.mode, each.x.length]));
        say("axes", ["xaxis", "yaxis"].map(
            (name) => document.getElementById("backends-plot")._fullLayout[name].type));
        say("slopes", column("backends-slopes", 3));
        const titles = [...document.querySelectorAll("#backends-table thead button")].map(
            (each) => each.textContent.trim());
        const at = (title) => column("backends-table", titles.indexOf(title));
        say("ratios", at("\u00f7 tessellation"));
        say("flips", at("FLIP to tessellation"));
        say("reasons", at("reason"));
        document.querySelector('.chip[data-filter="/render/msaa"][data-value="4"]').click();
        await settle();
        say("filtered", [figure("backends-plot").length, column("backends-table", 0).length,
            column("backends-slopes", 0).length]);
        await choose("backends-y", "linear");
        say("linear", document.getElementById("backends-plot")._fullLayout.yaxis.type);
        say("link", document.querySelector('#contents a[href="#backends"]').textContent);
        say("odd", document.getElementById("backends").textContent.match(/\[object|undefined|NaN/));
    )",
        1280);
    // Each line has points, the law and a legend entry.
    constexpr std::array kCounts{3, 2, 1};
    ASSERT_EQ(said.at("plot").size(), 12u);
    for (std::size_t i = 0; i < 12; ++i)
        EXPECT_EQ(said.at("plot").at(i).at(2), kCounts[i % 3]) << i;
    EXPECT_EQ(said.at("axes"), Json({"log", "log"}));
    EXPECT_EQ(
        said.at("slopes"), Json(
                               {"1.100 (1.100 to 1.100)", "0.800 (0.800 to 0.800)",
                                "1.100 (1.100 to 1.100)", "0.800 (0.800 to 0.800)"}));
    ASSERT_EQ(said.at("ratios").size(), 18u);
    // 5 x 640^-0.3 for 640 strands.
    EXPECT_THAT(said.at("ratios").at(1).get<std::string>(), testing::StartsWith("0.7196 ("));
    EXPECT_EQ(said.at("ratios").at(4), "");
    EXPECT_EQ(said.at("flips").at(0), "0");
    EXPECT_EQ(said.at("flips").at(1), "0.01");
    EXPECT_EQ(said.at("reasons").at(4), kSkipReason);
    EXPECT_EQ(said.at("reasons").at(0), "");
    EXPECT_EQ(said.at("filtered"), Json({6, 12, 2}));
    EXPECT_EQ(said.at("linear"), "linear");
    EXPECT_EQ(said.at("link"), "Back ends");
    EXPECT_EQ(said.at("odd"), nullptr);
}

TEST_F(PageInBrowser, HasNoSectionOfBackendsWithoutThem) {
    const Json said = one(R"(
        say("section", document.getElementById("backends"));
        say("link", document.querySelector('#contents a[href="#backends"]'));
    )");
    EXPECT_EQ(said.at("section"), nullptr);
    EXPECT_EQ(said.at("link"), nullptr);
}

// The worst of all cases, which for waves is the least.
TEST_F(PageInBrowser, ListsShadersWithTheWorstOfCases) {
    Report compiled = oneCaseReport("a", {});
    compiled.cases.front().metrics = {
        {ofShader("b:comp", Measured::registers), {24.0}},
        {ofShader("b:comp", Measured::waves), {8.0}},
        {ofShader("a:frag", Measured::registers), {12.0}}};
    compiled.cases.push_back(compiled.cases.front());
    compiled.cases.back().name = "b";
    compiled.cases.back().metrics = {
        {ofShader("b:comp", Measured::registers), {64.0}},
        {ofShader("b:comp", Measured::waves), {4.0}}};
    const Json said = open(
        {folder_.write("shaders.json", reportJson(compiled).dump())}, R"(
        say("titles", [...document.querySelectorAll("#shaders-table thead button")].map(
            (each) => each.textContent.trim()));
        say("rows", [0, 1, 2].map((place) => column("shaders-table", place)));
        say("doubts", document.getElementById("summary").textContent.match(/doubtful|untrusted/));
    )",
        1280);
    EXPECT_EQ(said.at("titles"), (Json{"shader", "registers", "waves"}));
    EXPECT_EQ(said.at("rows"), Json::parse(R"([["a:frag","b:comp"],["12","64"],["","4"]])"));
    EXPECT_EQ(said.at("doubts"), nullptr);  // nothing was timed
}

}  // namespace
}  // namespace benchmarks::report
