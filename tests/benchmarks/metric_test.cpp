#include "benchmarks/report/metric.h"

#include <map>
#include <regex>
#include <sstream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "engine/files.h"

namespace benchmarks {
namespace {

using testing::ElementsAre;

// "pass.x.time" for "pass.*.time" and "memory.heap.x" for "memory.heap.<index>".
std::string withPart(const std::string& pattern) {
    return std::regex_replace(pattern, std::regex(R"(\*|<\w+>)"), "x");
}

// Returns name and unit of each metric in the table of results/README.md. ".mean" after
// "fps.low_1.percentile" means "fps.low_1.mean". For passes' times, the table names the first and
// the last.
std::map<std::string, std::string> documented() {
    const std::string text = engine::readFile(HAIRBENCH_SOURCE_DIR "/results/README.md");
    std::istringstream table(
        text.substr(text.find("| metric | unit |"), text.find("## Physics reports")));
    const std::regex row(R"(^\| (`.*`) \| ([^|]+) \| .*)");
    const std::regex code("`([^`]+)`");
    std::map<std::string, std::string> units;
    for (std::string line; std::getline(table, line) && !line.starts_with("## ");) {
        std::smatch cells;
        if (!std::regex_match(line, cells, row)) continue;
        const std::string names = cells[1];
        std::istringstream unit_list(cells[2].str());  // "ms, 1": one unit for each name
        std::string unit, last;
        for (std::sregex_iterator each(names.begin(), names.end(), code), end; each != end;
             ++each) {
            std::string name = (*each)[1];
            if (name.starts_with('.')) name = last.substr(0, last.rfind('.')) + name;
            last = name;
            if (std::string next; std::getline(unit_list >> std::ws, next, ',')) unit = next;
            units[withPart(name)] = unit;
        }
    }
    return units;
}

// Returns one metric of each kind, with the part "x" if it has one.
std::map<std::string, std::string> made() {
    std::map<std::string, std::string> units;
    for (const report::MetricKind& kind : report::metricKinds()) {
        const bool has_part = kind.name.find('*') != kind.name.npos;
        const report::Metric metric({kind.of, kind.what, has_part ? "x" : ""}, {1.0});
        units[metric.name()] = metric.unit;
    }
    return units;
}

TEST(Metric, HasTheNamesAndUnitsThatAreDocumented) {
    std::map<std::string, std::string> expected = documented();
    // The row for all passes.
    EXPECT_EQ(expected.erase("pass.wind.time") + expected.erase("pass.resolve.time"), 2u);
    expected["pass.x.time"] = "ms";
    EXPECT_EQ(made(), expected);
}

TEST(Metric, IsFoundAgainByItsName) {
    for (const report::MetricKind& kind : report::metricKinds()) {
        const bool has_part = kind.name.find('*') != kind.name.npos;
        const report::MetricId id{kind.of, kind.what, has_part ? "mesh_shadow" : ""};
        EXPECT_EQ(report::metricNamed(id.name()), id) << id.name();
    }
    EXPECT_EQ(
        report::metricNamed("pass.strands.time"),
        report::ofPass("strands", report::Measured::time));
    EXPECT_EQ(
        report::metricNamed("pass.strands.cpu.time"),
        report::ofPass("strands", report::Measured::cpu_time));
    EXPECT_EQ(report::metricNamed("pass.cpu.time"), report::ofPass("cpu", report::Measured::time));
    EXPECT_EQ(report::metricNamed("memory.heap.0"), report::ofMemory(report::Measured::heap, "0"));
    EXPECT_EQ(
        report::metricNamed("memory.purpose.targets"),
        report::ofMemory(report::Measured::purpose, "targets"));
}

TEST(Metric, IsAnotherWhereNoKindHasItsName) {
    for (const char* const name :
         {"", "frame", "frame.times", "pass.time", "pass..time", "pass.a.b.time",
          "pass.strands.bytes", "memory.heap.", "fps.low_1"}) {
        const report::MetricId id = report::metricNamed(name);
        EXPECT_EQ(id.of, report::MetricOf::other) << name;
        EXPECT_EQ(id.name(), name);
        EXPECT_EQ(id.pass(), "");
    }
    EXPECT_NE(report::metricNamed("a"), report::metricNamed("b"));
}

TEST(Metric, NamesItsPass) {
    EXPECT_EQ(report::metricNamed("pass.strands.time").pass(), "strands");
    EXPECT_EQ(report::metricNamed("pass.strands.cpu.time").pass(), "strands");
    EXPECT_EQ(report::metricNamed("pass.mesh_shadow.instructions").pass(), "mesh_shadow");
    EXPECT_EQ(report::metricNamed("frame.cpu.time").pass(), "");
    EXPECT_EQ(report::metricNamed("memory.heap.0").pass(), "");
}

// Higher is better for rates, the signal-to-noise ratio, the structural similarity, the share of
// the limit and the waves on a processor. An overlap is a difference of two times, and a wait grows
// when others are faster. Costs by a model belong to the case, and device limits to the device.
TEST(Metric, KnowsWhatIsBetter) {
    for (const report::MetricKind& kind : report::metricKinds()) {
        const std::string name(kind.name);
        report::Better expected = report::Better::lower;
        if (name.starts_with("fps") || name == "image.psnr" || name == "image.ssim" ||
            name == "strands.limit_share" || name == "shader.*.waves")
            expected = report::Better::higher;
        if (name == "frame.overlap" || name.ends_with(".wait.time") || name == "strands.bytes" ||
            name.ends_with(".operations") || name == "strands.limit" || name.starts_with("device."))
            expected = report::Better::neither;
        // A motion of guides is neither good nor bad, except for wrong lengths and hair in bodies.
        if (name.starts_with("probe.") && name != "probe.length_error.*" &&
            name != "probe.penetration" && name != "probe.pass.time")
            expected = report::Better::neither;
        EXPECT_EQ(kind.better, expected) << name;
        EXPECT_EQ(report::Metric(report::metricNamed(name), {}).better, expected) << name;
    }
    EXPECT_EQ(
        report::Metric(report::metricNamed("frame.times"), {}).better, report::Better::neither);
}

TEST(Metric, TellsTimesFromDifferencesAndWaits) {
    for (const char* const name :
         {"frame.time", "frame.first.time", "cpu.record.time", "pass.wind.cpu.time"})
        EXPECT_TRUE(report::Metric(report::metricNamed(name), {}).isTime()) << name;
    for (const char* const name :
         {"frame.overlap", "gpu.wait.time", "fps", "memory.device", "frame.instructions"})
        EXPECT_FALSE(report::Metric(report::metricNamed(name), {}).isTime()) << name;
}

TEST(Metric, FindsTheSameOfAllPasses) {
    const auto is_same = [](const char* name, const char* other) {
        return report::isSameOfFrameOrPass(report::metricNamed(name), report::metricNamed(other));
    };
    EXPECT_TRUE(is_same("pass.wind.cpu.time", "pass.strands.cpu.time"));
    EXPECT_TRUE(is_same("frame.cpu.time", "pass.strands.cpu.time"));
    EXPECT_FALSE(is_same("pass.wind.time", "pass.strands.cpu.time"));
    EXPECT_TRUE(is_same("pass.wind.time", "pass.strands.time"));
    EXPECT_TRUE(is_same("frame.time", "pass.strands.time"));
    EXPECT_FALSE(is_same("pass.wind.cpu.time", "pass.strands.time"));
    EXPECT_FALSE(is_same("frame.first.time", "pass.strands.time"));
}

TEST(Metric, KnowsEveryCost) {
    for (const char* const name :
         {"frame.time", "frame.cpu.time", "frame.instructions", "pass.wind.time",
          "pass.wind.cpu.time", "pass.wind.instructions"})
        EXPECT_TRUE(report::isFrameOrPassCost(report::metricNamed(name))) << name;
    for (const char* const name :
         {"frame.first.time", "frame.overlap", "cpu.record.time", "fps", "memory.device"})
        EXPECT_FALSE(report::isFrameOrPassCost(report::metricNamed(name))) << name;
}

TEST(Metric, IsReadFromAReport) {
    const scene::Json result = scene::Json::parse(R"({"metrics": {
        "pass.wind.time": {"unit": "ms", "hint": "lower", "mode": "wall_clock", "median": 2.0,
                           "mad": 1.0, "samples": [1.0, 2.0, 3.0]},
        "fps": {"unit": "1/s", "median": 60.0, "mad": 0.0, "samples": [60.0]},
        "frame.overlap": {"unit": "ms", "median": 1.0, "mad": 0.0, "samples": [1.0]}}})");
    const std::vector<report::MetricReading> metrics = report::readMetrics(result);
    ASSERT_EQ(metrics.size(), 3u);
    EXPECT_EQ(metrics[0].id, report::ofPass("wind", report::Measured::time));
    EXPECT_EQ(metrics[0].unit, "ms");
    EXPECT_EQ(metrics[0].better, report::Better::lower);
    EXPECT_EQ(metrics[0].mode, report::Mode::wall_clock);
    EXPECT_EQ(metrics[0].median, 2.0);
    EXPECT_THAT(metrics[0].samples, ElementsAre(1.0, 2.0, 3.0));
    // Reports of 1.0 have no direction.
    EXPECT_EQ(metrics[1].better, report::Better::higher);
    EXPECT_EQ(metrics[1].mode, report::Mode::none);
    EXPECT_EQ(metrics[2].better, report::Better::neither);
    EXPECT_EQ(report::findMetric(metrics, report::ofFrame(report::Measured::rate)), &metrics[1]);
    EXPECT_EQ(report::findMetric(metrics, report::ofFrame(report::Measured::time)), nullptr);
}

TEST(Metric, IsAsTheReportSaysWhereItIsNotKnownHere) {
    const scene::Json said = scene::Json::parse(
        R"({"unit": "J", "hint": "lower", "mode": "asleep", "median": 2.0, "samples": [2.0]})");
    const report::MetricReading energy = report::MetricReading::fromReport("frame.energy", said);
    EXPECT_EQ(energy.name(), "frame.energy");
    EXPECT_EQ(energy.unit, "J");
    EXPECT_EQ(energy.better, report::Better::lower);
    EXPECT_EQ(energy.mode, report::Mode::other);
    EXPECT_FALSE(energy.isTimedAs(energy));  // two unknown modes may differ
    const scene::Json silent =
        scene::Json::parse(R"({"unit": "ms", "median": 2.0, "samples": [2.0]})");
    EXPECT_EQ(
        report::MetricReading::fromReport("frame.times", silent).better, report::Better::neither);
}

}  // namespace
}  // namespace benchmarks
