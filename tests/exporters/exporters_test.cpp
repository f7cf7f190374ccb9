#include "benchmarks/report/exporters.h"

#include <functional>
#include <set>

#include <gmock/gmock.h>

#include "tests/error_text.h"
#include "tests/exporters/exported.h"

namespace benchmarks::report {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kName = "thesis/density:64/backend:tessellation";

std::vector<std::string> names(const scene::Json& entries) {
    std::vector<std::string> found;
    for (const scene::Json& entry : entries)
        found.push_back(entry.at("name").get<std::string>().substr(std::string(kName).size() + 1));
    return found;
}

void forEachNumber(const scene::Json& value, const std::function<void(const scene::Json&)>& visit) {
    if (value.is_structured())
        for (const scene::Json& element : value) forEachNumber(element, visit);
    else
        visit(value);
}

TEST(Exporters, WriteWhatParsesAndHoldsNoNull) {
    for (const Exporter& exporter : exporters()) {
        const std::string text = exported(exporter.name);
        EXPECT_TRUE(text.ends_with('\n')) << exporter.name;
        // A bare NaN or Infinity is not JSON, and null is not a number.
        for (const char* bad : {"NaN", "nan", "Infinity", "inf", "null"})
            EXPECT_THAT(text, Not(HasSubstr(bad))) << exporter.name;
        const bool is_json = std::string_view(exporter.extension) == ".json";
        EXPECT_EQ(scene::Json::accept(text), is_json) << exporter.name;
    }
}

TEST(Exporters, TakeEveryMemberOfAReportAsOptionalThatTheSchemaDoes) {
    const scene::Json bare = scene::Json::parse(R"({"schema": "hairbench-report/1.7.0",
        "environment": {"device": {}, "host": {}, "build": {}, "command": [], "seed": 1},
        "scene": {"path": "s.json", "hash": "0123456789abcdef", "document": {}},
        "cases": [{"name": "s", "axes": {}, "status": "ok", "statistics": {}, "counts": {},
                   "trust": {"warnings": []},
                   "metrics": {"frame.time": {"unit": "ms", "median": 1, "mad": 0, "samples": [1]}}},
                  {"name": "t", "axes": {}, "status": "skipped", "reason": "no"}]})");
    for (const Exporter& exporter : exporters())
        EXPECT_FALSE(exportReport(bare, exporter.name).empty()) << exporter.name;
}

TEST(Exporters, RefuseWhatIsNoReport) {
    EXPECT_EQ(
        errorText([] { exported("gbnch"); }),
        "unknown format (did you mean 'gbench'?); known: csv, markdown, gbench, bmf, "
        "customSmallerIsBetter, perfetto");
    scene::Json report = writtenReport();
    report["schema"] = "hairbench-report/2.0.0";
    EXPECT_EQ(
        errorText([&] { exportReport(report, "csv"); }),
        "/schema: hairbench-report/2.0.0 is not hairbench-report/1.9.0");
    EXPECT_THAT(
        errorText([] { exportReport(scene::Json::array(), "csv"); }),
        testing::StartsWith("the report can't be converted: "));
    for (const char* member : {"cases", "scene", "environment"}) {
        report = writtenReport();
        report.erase(member);
        EXPECT_THAT(
            errorText([&] {
                for (const Exporter& each : exporters()) exportReport(report, each.name);
            }),
            HasSubstr(member));
    }
}

TEST(Gbench, KeepsTheFormatsRules) {
    const scene::Json document = exportedJson("gbench");
    const scene::Json& context = document["context"];
    EXPECT_EQ(context["json_schema_version"], 1);
    EXPECT_TRUE(context["caches"].is_array());
    EXPECT_EQ(context["date"], "2030-01-02T03:04:05Z");
    EXPECT_EQ(context["num_cpus"], 2);
    EXPECT_EQ(context["library_build_type"], "release");
    std::set<std::string> seen;
    for (const scene::Json& entry : document["benchmarks"]) {
        EXPECT_TRUE(seen.insert(entry["name"]).second) << entry["name"];
        EXPECT_LE(entry["name"].get<std::string>().size(), 1024u);  // bencher's limit
        EXPECT_EQ(entry["run_type"], "iteration");
        EXPECT_EQ(entry["time_unit"], "us");
        EXPECT_GT(entry["iterations"], 0);
        EXPECT_EQ(entry["threads"], 1);
        EXPECT_FALSE(entry.contains("aggregate_name"));
    }
}

TEST(Gbench, HasTimesOnly) {
    const scene::Json benchmarks = exportedJson("gbench")["benchmarks"];
    EXPECT_THAT(
        names(benchmarks), ElementsAre("frame.time", "pass.wind.time", "pass.strands.time"));
    EXPECT_EQ(benchmarks[0]["real_time"], 3000.0);  // 3 ms
    EXPECT_EQ(benchmarks[0]["iterations"], 3);
}

// A frame of a software device takes the processors' time, of others only the host's.
TEST(Gbench, HasTheCpuTimeOfTheSameWork) {
    const auto times = [](std::vector<Metric> metrics) {
        Report report = sampleReport();
        report.cases[0].metrics = std::move(metrics);
        const scene::Json entry =
            scene::Json::parse(exportReport(reportJson(report), "gbench"))["benchmarks"][0];
        return std::pair(entry["real_time"].get<double>(), entry["cpu_time"].get<double>());
    };
    const Metric frame(ofFrame(Measured::time), {3.0}, Mode::overlapped);
    const Metric of_host(ofCpu(Measured::host_time), {0.25}, Mode::overlapped);
    const Metric of_frame(ofFrame(Measured::cpu_time), {5.5}, Mode::isolated);
    EXPECT_EQ(times({frame, of_host}), std::pair(3000.0, 250.0));
    EXPECT_EQ(times({frame, of_host, of_frame}), std::pair(3000.0, 5500.0));
    EXPECT_EQ(times({frame}), std::pair(3000.0, 3000.0));  // unknown
    const Metric pass(ofPass("wind", Measured::time), {0.5}, Mode::isolated);
    const Metric of_pass(ofPass("wind", Measured::cpu_time), {0.75}, Mode::wall_clock);
    EXPECT_EQ(times({pass, of_pass}), std::pair(500.0, 750.0));
}

TEST(Gbench, LeavesOutADifferenceOfTimes) {
    Report report = sampleReport();
    report.cases[0].metrics.push_back({ofFrame(Measured::overlap), {-1.5}});
    EXPECT_THAT(exportReport(reportJson(report), "gbench"), Not(HasSubstr("overlap")));
}

TEST(Bmf, HasAValueWithBoundsPerMeasure) {
    const scene::Json document = exportedJson("bmf");
    const std::string prefix = std::string(kName) + '/';
    EXPECT_EQ(
        document[prefix + "frame.time"].dump(),
        R"({"latency":{"value":3000000.0,"lower_value":2500000.0,"upper_value":3500000.0}})");
    EXPECT_EQ(document[prefix + "fps"]["throughput"]["value"], 333.25);
    EXPECT_EQ(document[prefix + "memory.device"]["bytes"]["value"], 1048576.0);
    EXPECT_EQ(document.size(), 6u);  // every metric with a sample, and the verdict
}

// Bencher's latency is in ns, and so is every other time.
TEST(Bmf, HasAllTimesInNanoseconds) {
    Report report = sampleReport();
    report.cases[0].metrics = {
        {ofFrame(Measured::time), {3.0}, Mode::overlapped},
        {ofFrame(Measured::overlap), {-1.5}},
        {ofStrands(Measured::time_per_point), {2.5}},
        {ofStrands(Measured::limit), {0.25}}};
    const scene::Json document = scene::Json::parse(exportReport(reportJson(report), "bmf"));
    const auto value = [&](const std::string& metric, const std::string& measure) {
        return document[kName + ('/' + metric)][measure]["value"];
    };
    EXPECT_EQ(value("frame.time", "latency"), 3e6);
    EXPECT_EQ(value("frame.overlap", "frame.overlap"), -1.5e6);
    EXPECT_EQ(value("strands.time_per_point", "latency"), 2.5);
    EXPECT_EQ(value("strands.limit", "strands.limit"), 0.25e6);
}

TEST(CustomSmallerIsBetter, HasWhatIsBetterWhenSmaller) {
    const scene::Json entries = exportedJson("customSmallerIsBetter");
    EXPECT_THAT(
        names(entries),
        ElementsAre("frame.time", "pass.wind.time", "pass.strands.time", "memory.device"));
    EXPECT_EQ(entries[0]["unit"], "ms");
    EXPECT_EQ(entries[0]["value"], 3.0);
    EXPECT_EQ(entries[0]["range"], "± 1.0");
    EXPECT_FALSE(entries[1].contains("range"));  // one sample
}

}  // namespace
}  // namespace benchmarks::report
