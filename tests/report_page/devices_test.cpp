// Tests reports of several devices and scenes on one page.
#include "benchmarks/report/page.h"

#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/error_text.h"
#include "tests/report_page/page_in_browser.h"
#include "tests/report_page/sample_reports.h"
#include "tests/temporary_folder.h"

namespace benchmarks::report {
namespace {

using scene::Json;
using testing::ElementsAre;
using testing::HasSubstr;

Report onCard(Report report, const std::string& name, const std::string& driver_version) {
    report.environment.device.name = name;
    report.environment.device.driver_version = driver_version;
    return report;
}

// Returns the known cases on three cards. The second takes 1.5 times the first card's time, and the
// third half of it, and a report of another scene.
std::vector<Json> threeCards() {
    return {
        reportJson(onCard(knownReport(), "Card 1", "1.0")),
        reportJson(onCard(backendReport(), "Card 1", "1.0")),
        reportJson(onCard(knownReport(1.5), "Card 2", "2.0")),
        reportJson(onCard(knownReport(0.5), "Card 2", "3.0"))};
}

TEST(Devices, AreComparedWithTheFirstOfTheirScene) {
    const std::vector<OnDevice> devices = compareDevices(threeCards());
    ASSERT_EQ(devices.size(), 4u);
    const auto firsts = [&] {
        std::vector<std::size_t> places;
        for (const OnDevice& each : devices) places.push_back(each.first);
        return places;
    }();
    EXPECT_THAT(firsts, ElementsAre(0, 1, 0, 0));
    EXPECT_FALSE(devices[0].ratio);
    EXPECT_FALSE(devices[1].ratio);
    ASSERT_TRUE(devices[2].ratio && devices[3].ratio);
    EXPECT_EQ(devices[2].ratio->cases, std::size(kKnown));  // the skipped case has no time
    for (const double each :
         {devices[2].ratio->mean, devices[2].ratio->least, devices[2].ratio->greatest})
        EXPECT_NEAR(each, 1.5, 1e-9);
    EXPECT_NEAR(devices[3].ratio->mean, 0.5, 1e-9);
    EXPECT_THAT(devices[2].differences, testing::Contains(HasSubstr("Card 1 and Card 2")));
}

// The geometric mean of the ratios 2 and 8 is 4.
TEST(Devices, HaveTheGeometricMeanOfTheirCasesInCommon) {
    const auto report = [](const std::vector<std::pair<std::string, double>>& cases) {
        Json json = {
            {"scene", {{"path", "scenes/a.json"}}},
            {"environment", {{"device", {{"type", "discrete"}}}}},
            {"cases", Json::array()}};
        for (const auto& [name, time] : cases)
            json["cases"].push_back(
                {{"name", name},
                 {"axes", {{"/x", name}}},
                 {"metrics", {{"frame.time", {{"median", time}}}}}});
        return json;
    };
    const std::vector<Json> reports = {
        report({{"a", 1.0}, {"b", 3.0}, {"only here", 1.0}}),
        report({{"a", 2.0}, {"b", 24.0}, {"only there", 9.0}}), report({{"other", 1.0}})};
    const std::vector<OnDevice> devices = compareDevices(reports);
    ASSERT_TRUE(devices[1].ratio);
    EXPECT_EQ(devices[1].ratio->cases, 2u);
    EXPECT_NEAR(devices[1].ratio->mean, 4.0, 1e-12);
    EXPECT_EQ(devices[1].ratio->least, 2.0);
    EXPECT_EQ(devices[1].ratio->greatest, 8.0);
    EXPECT_FALSE(devices[2].ratio);
}

// Sweeps with different axes are comparable: an absent axis has the scene's value.
TEST(Devices, FillAxesFromTheirScenes) {
    const auto report = [](const Json& axes, double time) {
        return Json{
            {"scene", {{"path", "scenes/a.json"}, {"document", {{"x", 3}, {"y", {{"z", "b"}}}}}}},
            {"environment", {{"device", {{"type", "discrete"}}}}},
            {"cases",
             {{{"name", "a/" + axes.dump()},
               {"axes", axes},
               {"metrics", {{"frame.time", {{"median", time}}}}}}}}};
    };
    const std::vector<Json> reports = {
        report({{"/x", 3}}, 1.0), report({{"/y/z", "b"}}, 2.0), report({{"/y/z", "c"}}, 2.0)};
    const std::vector<OnDevice> devices = compareDevices(reports);
    ASSERT_TRUE(devices[1].ratio);
    EXPECT_EQ(devices[1].ratio->mean, 2.0);
    EXPECT_FALSE(devices[2].ratio);
}

TEST(PageData, LeavesOutOtherKindsOfReportsAndSaysSo) {
    const TemporaryFolder folder;
    const std::string physics = HAIRBENCH_SOURCE_DIR "/results/physics-llvmpipe-536c96d26cbf.json";
    const std::string schema = HAIRBENCH_SOURCE_DIR "/results/lod.schema.json";
    const auto known = folder.write("known.json", reportJson(knownReport()).dump());
    const Json data = pageData({{physics, known, schema}});
    EXPECT_EQ(data.at("reports").size(), 1u);
    EXPECT_EQ(data.at("reports")[0].at("label"), "A");
    EXPECT_EQ(data.at("left_out"), Json::parse(R"([{"file": "physics-llvmpipe-536c96d26cbf.json",
                         "reason": "hairbench-physics/1.0.0"},
                        {"file": "lod.schema.json", "reason": "a JSON Schema"}])"));
    EXPECT_THAT(
        errorText([&] { pageData({{physics, schema}}); }), HasSubstr("hairbench-physics/1.0.0"));
    // A damaged file is not left out silently.
    EXPECT_THAT(
        errorText([&] { pageData({{known, folder.write("bad.json", R"({"schema": 1})")}}); }),
        HasSubstr("bad.json"));
}

TEST_F(PageInBrowser, ComparesDevices) {
    std::vector<std::filesystem::path> files;
    for (Json report : threeCards()) {
        if (files.empty()) report["untrusted"] = "a film ran beside it";
        const std::string name = std::string(1, static_cast<char>('a' + files.size())) + ".json";
        files.push_back(folder_.write(name, report.dump()));
    }
    files.push_back(HAIRBENCH_SOURCE_DIR "/results/physics-llvmpipe-536c96d26cbf.json");
    const Json said = open(files, R"(
        const titles = [...document.querySelectorAll("#devices-table thead button")].map(
            (each) => each.textContent.trim());
        const at = (title) => column("devices-table", titles.indexOf(title));
        const chip = async (filter, value) => {
            document.querySelector(`.chip[data-filter="${filter}"][data-value="${value}"]`).click();
            await settle();
        };
        const lines = () => figure("scaling-plot").map((each) => each.name);
        say("first", [at("report"), at("scene")]);
        say("ratios", at("frame time \u00f7 first"));
        say("plot", [...figure("devices-plot")[0].x]);
        say("lines", lines());
        await chip("device", "Card 2, 2.0");
        say("without", [at("report"), lines()]);
        document.getElementById("filter-reset").click();
        await settle();
        say("all", at("scene"));
        await chip("scene", "known");
        say("other", [at("back ends"), figure("scaling-plot").length > 0,
            [...document.getElementById("scaling-x").options].length > 0]);
        await chip("backend", "software");
        say("cases", document.getElementById("filter-count").textContent);
        say("page", document.querySelector("main").textContent.match(/\[object|undefined|NaN/));
        say("summary", document.getElementById("summary").textContent);
        say("compared", document.querySelectorAll("#comparison-other option").length);
    )");
    EXPECT_EQ(
        said.at("first"),
        Json::parse(R"([["A: a.json", "C: c.json", "D: d.json"], ["known", "known", "known"]])"));
    EXPECT_EQ(said.at("ratios"), Json({"1, the first", "1.5 (1.5 to 1.5)", "0.5 (0.5 to 0.5)"}));
    ASSERT_EQ(said.at("plot").size(), 2u);
    EXPECT_NEAR(said.at("plot")[0].get<double>(), 1.5, 1e-9);
    // Three reports with one and four samples.
    EXPECT_EQ(said.at("lines").size(), 6u);
    EXPECT_EQ(said.at("without")[0], Json({"A: a.json", "D: d.json"}));
    EXPECT_EQ(said.at("without")[1].size(), 4u);
    EXPECT_EQ(said.at("all"), Json({"known", "backends", "known", "known"}));
    EXPECT_EQ(said.at("other"), Json::parse(R"([["tessellation, software"], true, true])"));
    // Half of the other scene's 18 cases use tessellation.
    EXPECT_EQ(said.at("cases"), "9 of 36 cases");
    EXPECT_EQ(said.at("page"), nullptr);
    EXPECT_THAT(said.at("summary").get<std::string>(), HasSubstr("a film ran beside it"));
    EXPECT_THAT(said.at("summary").get<std::string>(), HasSubstr("hairbench-physics/1.0.0"));
    EXPECT_EQ(said.at("compared"), 2);
}

}  // namespace
}  // namespace benchmarks::report
