#include "benchmarks/report/report.h"

#include <cmath>
#include <filesystem>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "benchmarks/doctor/reports.h"
#include "engine/files.h"
#include "tests/benchmarks/sample_report.h"
#include "tests/error_text.h"
#include "tests/temporary_folder.h"

namespace benchmarks {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::filesystem::path kReportSchemaFile =
    std::filesystem::path(HAIRBENCH_SCENES_DIR) / "../results/report.schema.json";

scene::Json written() { return scene::Json::parse(writtenText(sampleReport())); }

// Writes a case with two isolated passes as an earlier version of the program did.
scene::Json readAs(const char* schema, const scene::Json& trust) {
    scene::Json report = written();
    report["schema"] = schema;
    scene::Json& result = report["cases"][0];
    const auto metric = [](const char* mode, double median, double mean) {
        return scene::Json{
            {"unit", "ms"}, {"mode", mode}, {"median", median}, {"mean", mean}, {"samples", {1}}};
    };
    result["metrics"] = {
        {"frame.time", metric("overlapped", 0.45, 0.47)},
        {"frame.device.time", metric("overlapped", 0.44, 0.452)},
        {"gpu.wait.time", metric("overlapped", 0.01, 0.048)},
        {"pass.wind.time", metric("isolated", 0.2, 0.2)},
        {"pass.strands.time", metric("isolated", 0.3, 0.3)},
        {"pass.strands.cpu.time", metric("isolated", 7.0, 7.0)},
        {"frame.overlap", metric("", 0.05, 0.05)}};
    result["trust"] = trust;
    const TemporaryFolder folder;
    return report::readReport(folder.write("report.json", report.dump()));
}

TEST(Report, CorrectsOverlapAndWaitOfOlderOnes) {
    const scene::Json report = readAs("hairbench-report/1.6.0", {{"empty_pass", 0.01}});
    const scene::Json& metrics = report["cases"][0]["metrics"];
    // (0.2 - 0.01) + (0.3 - 0.01) - 0.45
    EXPECT_NEAR(metrics["frame.overlap"]["median"], 0.03, 1e-12);
    EXPECT_FALSE(metrics["frame.overlap"].contains("interval"));
    EXPECT_NEAR(metrics["gpu.wait.time"]["median"], 0.47 - 0.452, 1e-12);
    EXPECT_THAT(report["corrections"].get<std::string>(), HasSubstr("fps.low_* still"));
}

TEST(Report, LeavesOutWhatItCantCorrect) {
    const scene::Json report = readAs("hairbench-report/1.5.0", scene::Json::object());
    EXPECT_FALSE(report["cases"][0]["metrics"].contains("frame.overlap"));
    EXPECT_TRUE(report["cases"][0]["metrics"].contains("gpu.wait.time"));
}

TEST(Report, CorrectsNothingOfTheNewest) {
    const scene::Json report = readAs(report::kReportSchema, {{"empty_pass", 0.01}});
    EXPECT_EQ(report["cases"][0]["metrics"]["frame.overlap"]["median"], 0.05);
    EXPECT_FALSE(report.contains("corrections"));
}

TEST(Report, KeepsTheContractsNames) {
    const scene::Json report = written();
    EXPECT_EQ(report["schema"], "hairbench-report/1.9.0");
    EXPECT_EQ(
        report["environment"]["device"].dump(),
        R"({"name":"Soft","type":"cpu","driver":"llvmpipe","driver_version":"22.3.6",)"
        R"("api_version":"1.3.230","timestamp_period_ns":1.0,"id":"10005:0000",)"
        R"("timestamp_valid_bits":64,"limits":{"maxTessellationGenerationLevel":64.0,)"
        R"("timestampPeriod":1.0}})");
    EXPECT_EQ(report["environment"]["build"]["flags"], "-O3 -DNDEBUG");
    EXPECT_EQ(report["environment"]["build"]["dirty"], false);
    EXPECT_EQ(report["environment"]["validation"], false);
    EXPECT_EQ(report["environment"]["command"][1], "run");
    EXPECT_EQ(report["environment"]["seed"], 7);
    EXPECT_EQ(
        report["scene"].dump(),
        R"({"path":"scenes/thesis.json","hash":"0123456789abcdef","document":{"seed":7}})");
    EXPECT_EQ(report["case_count"], 6);
    EXPECT_EQ(report["order_seed"], 11);
    EXPECT_EQ(report["shard"].dump(), R"({"index":1,"count":2})");
    const scene::Json& result = report["cases"][0];
    EXPECT_EQ(result["index"], 0);
    EXPECT_EQ(result["order"], 2);
    EXPECT_EQ(
        result["axes"].dump(), R"({"/strands/density":64,"/strands/backend":"tessellation"})");
    EXPECT_EQ(result["status"], "ok");
    EXPECT_EQ(
        result["statistics"]["tessellation_control_patches"].dump(),
        R"({"measured":952,"expected":952})");
    EXPECT_EQ(result["counts"].dump(), R"({"guides":86,"strands":8704})");
    EXPECT_EQ(result["backend"].dump(), R"({"name":"tessellation","reason":"the scene names it"})");
    EXPECT_FALSE(report["cases"][1].contains("backend"));
    EXPECT_EQ(result["memory_need"].dump(), R"({"device":2097152,"host":134217728})");
    EXPECT_FALSE(report["cases"][1].contains("memory_need"));
    EXPECT_EQ(
        result["start"].dump(),
        R"({"from":"relaxed","rest":"balanced","stretch":{"guide":4,"guides":2,"value":1.25},)"
        R"("depth":{"guide":3,"guides":1},"speed":{"guide":0,"guides":0,"value":0.0},)"
        R"("stiffened":5,"stiffest":1.5,"unbalanced":0})");
    EXPECT_FALSE(report["cases"][1].contains("start"));
    EXPECT_EQ(result["trust"].dump(), R"({"pass_sum_over_wall":0.99,"warnings":["clock fell"]})");
    EXPECT_EQ(result["image_hash"], "00000000000000ff");
    EXPECT_EQ(result["picture"], "thesis.pictures/0.png");
}

TEST(Report, SaysHowSamplesCameAbout) {
    const scene::Json result = written()["cases"][0];
    EXPECT_EQ(
        result["sampling"].dump(),
        R"([{"mode":"overlapped","rounds":3,"warmup_rounds":1,"throttled_rounds":2,)"
        R"("seconds":1.5,"steady":true,"precision":0.0078125},)"
        R"({"mode":"isolated","rounds":1,"warmup_rounds":0,"throttled_rounds":0,"seconds":0.0}])");
    EXPECT_EQ(
        result["conditions"].dump(),
        R"({"clock_mhz":1500.0,"base_clock_mhz":1400.0,"memory_clock_mhz":5000.0,)"
        R"("temperature":61.5,"steal":0.25,"other_load":0.5,"throttle_reasons":["power cap"]})");
}

TEST(Report, NamesTheBoardAndTheSourceOfItsEnergy) {
    report::Report report = sampleReport();
    report.environment.device.board = "00000000000000ff";
    report.environment.device.pci_address = "0000:65:00.0";
    report.environment.device.power_limit_w = 262.5;
    report::Conditions& conditions = report.cases[0].conditions;
    conditions.low_clock_mhz = 1450.0;
    conditions.energy_j = conditions.energy_s = 1.0;  // of rounds only
    conditions.energy_source = "counter";
    const std::string text = writtenText(report);
    EXPECT_THAT(report::schemaErrors(engine::readFile(kReportSchemaFile), text), IsEmpty());
    const scene::Json json = scene::Json::parse(text);
    const scene::Json& device = json["environment"]["device"];
    EXPECT_EQ(device["board"], "00000000000000ff");
    EXPECT_EQ(device["pci_address"], "0000:65:00.0");
    EXPECT_EQ(device["power_limit_w"], 262.5);
    const scene::Json& written_conditions = json["cases"][0]["conditions"];
    EXPECT_EQ(written_conditions["low_clock_mhz"], 1450.0);
    EXPECT_EQ(written_conditions["energy_source"], "counter");
    EXPECT_FALSE(written_conditions.contains("energy_j"));
    EXPECT_THAT(
        json["methods"].get<std::string>(),
        HasSubstr("Energies are by the device's energy counter over the rounds that count in 1 "
                  "case."));
}

TEST(Report, SummarizesTheFiniteSamples) {
    const scene::Json frame = written()["cases"][0]["metrics"]["frame.time"];
    EXPECT_EQ(frame["unit"], "ms");
    EXPECT_EQ(frame["mode"], "overlapped");
    EXPECT_EQ(frame["median"], 3.0);
    EXPECT_EQ(frame["mad"], 1.0);
    EXPECT_EQ(frame["samples"].dump(), "[2.0,4.0,3.0]");
    EXPECT_EQ(frame["missing_samples"], 1);
    EXPECT_EQ(frame["hint"], "lower");
    // Type 7 quantiles of 2, 3, 4: 2 + 2 p.
    EXPECT_DOUBLE_EQ(frame["percentile_5"], 2.1);
    EXPECT_DOUBLE_EQ(frame["percentile_95"], 3.9);
    EXPECT_DOUBLE_EQ(frame["percentile_99"], 3.98);
    EXPECT_FALSE(frame.contains("interval"));  // three samples give no 95 % interval
}

// A frame without a number keeps its place among those of the time, in the report, through its file
// and in what is read.
TEST(Report, KeepsTheFramesOfAProbe) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    report::Report report = sampleReport();
    report.cases[0].metrics.push_back(
        {report::metricNamed("probe.speed"), {1.0, kNone, 3.0, kNone}});
    const std::string text = writtenText(report);
    EXPECT_THAT(report::schemaErrors(engine::readFile(kReportSchemaFile), text), IsEmpty());
    const TemporaryFolder folder;
    const scene::Json read = report::readReport(folder.write("probed.json", text));
    const scene::Json& entry = read["cases"][0]["metrics"]["probe.speed"];
    EXPECT_EQ(entry["samples"].dump(), "[1.0,null,3.0,null]");
    EXPECT_EQ(entry["median"], 2.0);
    EXPECT_EQ(entry["missing_samples"], 2);
    const auto reading = report::MetricReading::fromReport("probe.speed", entry);
    ASSERT_EQ(reading.samples.size(), 4u);
    EXPECT_EQ(reading.samples[2], 3.0);
    EXPECT_TRUE(std::isnan(reading.samples[1]) && std::isnan(reading.samples[3]));
    // More samples than a report holds lie beside it.
    std::vector<double> many(3000, 1.0);
    many[1000] = kNone;
    report.cases[0].metrics.back().samples = many;
    report::writeReport(report::reportJson(report), folder.file("many.json"));
    ASSERT_TRUE(std::filesystem::exists(folder.file("many.samples.jsonl")));
    const scene::Json again = report::readReport(folder.file("many.json"));
    const auto long_one = report::MetricReading::fromReport(
        "probe.speed", again["cases"][0]["metrics"]["probe.speed"]);
    ASSERT_EQ(long_one.samples.size(), many.size());
    EXPECT_TRUE(std::isnan(long_one.samples[1000]));
    EXPECT_EQ(long_one.samples[999], 1.0);
}

TEST(Report, SaysWhatIsBetter) {
    const std::pair<report::Metric, const char*> hints[] = {
        {{report::ofFrame(report::Measured::time), {1.0}}, "lower"},
        {{report::ofFrame(report::Measured::overlap), {1.0}}, ""},
        {{report::ofFrame(report::Measured::rate), {1.0}}, "higher"},
        {{report::ofMemory(report::Measured::allocated), {1.0}}, "lower"},
        {{report::ofPass("strands", report::Measured::instructions), {1.0}}, "lower"},
        {{report::ofImage(report::Measured::flip), {1.0}}, "lower"},
        {{report::ofImage(report::Measured::ssim), {1.0}}, "higher"},
        {{report::ofImage(report::Measured::psnr), {1.0}}, "higher"}};
    for (const auto& [metric, hint] : hints) {
        const scene::Json written = report::caseJson({.name = "x", .metrics = {metric}});
        EXPECT_EQ(written["metrics"][metric.name()].value("hint", ""), hint) << metric.name();
    }
}

TEST(Report, HasAnIntervalOfTheMedianWhereThereAreEnoughSamples) {
    const scene::Json frame =
        report::reportJson(manySamples())["cases"][0]["metrics"]["frame.time"];
    const scene::Json& interval = frame["interval"];
    EXPECT_LE(interval["lower"], frame["median"]);
    EXPECT_GE(interval["upper"], frame["median"]);
    EXPECT_GE(interval["confidence"], 0.95);
    EXPECT_LE(interval["confidence"], 1.0);
    EXPECT_GT(frame["effective_samples"], 1.0);
}

TEST(Report, LeavesOutWhatIsNotKnown) {
    const scene::Json report = written();
    EXPECT_FALSE(report["cases"][0].contains("reason"));
    EXPECT_FALSE(report["cases"][0]["metrics"].contains("pass.ui.time"));  // no finite sample
    EXPECT_FALSE(report["cases"][0]["metrics"]["memory.device"].contains("mode"));
    EXPECT_EQ(
        report["cases"][1].dump(),
        R"({"name":"thesis/density:64/backend:mesh","axes":{"/strands/density":64,"/strands/backend":"mesh"},)"
        R"("index":2,"order":0,)"
        R"("status":"skipped","reason":"the device has no VK_EXT_mesh_shader, which the back end needs"})");
    report::Report bare;
    bare.scene.document = scene::Document(scene::Json::object());
    bare.cases.push_back(
        {.name = "x", .trust = {.pass_sum_over_wall = std::nan(""), .warnings = {}}});
    const scene::Json empty = report::reportJson(bare);
    EXPECT_EQ(empty["environment"]["device"].dump(), "{}");
    EXPECT_EQ(empty["environment"]["host"].dump(), "{}");
    EXPECT_EQ(empty["cases"][0]["trust"].dump(), R"({"warnings":[]})");
    EXPECT_THAT(empty.dump(), Not(HasSubstr("null")));
}

TEST(Report, SurvivesTextThatIsNotUtf8) {
    report::Report report = sampleReport();
    report.environment.device.name = "GPU \xff";
    EXPECT_EQ(
        scene::Json::parse(writtenText(report))["environment"]["device"]["name"],
        "GPU \xef\xbf\xbd");
}

TEST(ReportSchema, DescribesTheReport) {
    EXPECT_THAT(
        report::schemaErrors(textOf(kReportSchemaFile), writtenText(sampleReport())), IsEmpty());
}

TEST(ReportSchema, FindsWhatIsWrong) {
    const std::string schema = textOf(kReportSchemaFile);
    const char* const removed[] = {"/schema",          "/environment/device",
                                   "/scene/hash",      "/cases/0/status",
                                   "/cases/0/metrics", "/cases/0/metrics/frame.time/samples",
                                   "/cases/1/reason"};
    for (const char* pointer : removed) {
        scene::Json report = written();
        const scene::Json::json_pointer place(pointer);
        report[place.parent_pointer()].erase(place.back());
        EXPECT_THAT(report::schemaErrors(schema, report.dump()), Not(IsEmpty())) << pointer;
    }
    const std::pair<const char*, scene::Json> replaced[] = {
        {"/schema", "hairbench-report/2"},
        {"/cases/0/image_hash", "FF"},
        {"/cases/0/status", "great"},
        {"/cases/0/counts/strands", -1},
        {"/cases/0/metrics/fps/median", "fast"},
        {"/cases/0/metrics/fps/median", nullptr},
        {"/cases/0/metrics/fps/hint", "bigger"},
        {"/cases/0/metrics/frame.time/samples_file", 3},
        {"/cases/0/sampling/0/mode", "fast"},
        {"/cases/0/sampling/0/rounds", -1},
        {"/cases/0/conditions/steal", 1.5},
        {"/cases/0/conditions/throttle_reasons", scene::Json::array()},
        {"/cases/0/index", 0.5},
        {"/environment/device/id", "llvmpipe"},
        {"/environment/build/dirty", "no"},
        {"/shard/index", 0},
        {"/case_count", -1},
        {"/order_seed", "random"}};
    for (const auto& [pointer, value] : replaced) {
        scene::Json report = written();
        report[scene::Json::json_pointer(pointer)] = value;
        EXPECT_THAT(report::schemaErrors(schema, report.dump()), Not(IsEmpty())) << pointer;
    }
}

TEST(WriteReport, MakesFoldersAndLeavesOnlyTheReport) {
    const TemporaryFolder folder;
    const auto path = folder.path() / "a/b/r.json";
    report::writeReport(report::reportJson(sampleReport()), path);
    report::writeReport(report::reportJson(sampleReport()), path);  // replaces the first
    EXPECT_EQ(textOf(path), report::reportJson(sampleReport()).dump(2) + '\n');
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(path.parent_path()), {}), 1);
}

TEST(WriteReport, SaysWhyItCannot) {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder.path() / "taken");
    folder.write("file", "");
    const std::pair<const char*, const char*> errors[] = {
        {"taken", "taken: is a folder, not a file to write"},
        {"new/", "new/: is a folder, not a file to write"},
        {"file/r.json", "file: cannot be made: Not a directory"}};
    for (const auto& [name, error] : errors) {
        const auto path = folder.path() / name;
        EXPECT_EQ(
            folder.relative(
                errorText([&] { report::writeReport(report::reportJson(sampleReport()), path); })),
            error);
        EXPECT_EQ(folder.relative(errorText([&] { engine::checkWritable(path); })), error);
    }
}

// Readers use these numbers as counts.
TEST(ReadReport, RefusesCountsThatNoSweepHas) {
    const TemporaryFolder folder;
    const auto error = [&](const char* pointer, const scene::Json& value) {
        scene::Json report = written();
        report[scene::Json::json_pointer(pointer)] = value;
        const auto path = folder.write("r.json", report.dump());
        return folder.relative(errorText([&] { report::readReport(path); }));
    };
    EXPECT_EQ(error("/case_count", 1'000'000'000'000'000'000u), "no error");  // not allocated
    for (const scene::Json& wrong :
         {scene::Json(-1), scene::Json(1.5), scene::Json(1e300), scene::Json("6"), scene::Json()})
        EXPECT_EQ(error("/case_count", wrong), "r.json: is damaged: /case_count: is not a count")
            << wrong;
    EXPECT_EQ(
        error("/case_count", 0), "r.json: is damaged: /cases: a case has the number 0, counted "
                                 "from 0, but there are 0 cases");
    EXPECT_EQ(
        error("/cases/1/index", 0), "r.json: is damaged: /cases: two cases have the number 0");
    EXPECT_EQ(error("/cases/1/index", -1), "r.json: is damaged: /index: is not a count");
    EXPECT_EQ(
        error("/shard/index", 3), "r.json: is damaged: /shard: has an index outside [1, count]");
    EXPECT_EQ(
        error("/shard/count", 0), "r.json: is damaged: /shard: has an index outside [1, count]");
}

TEST(CheckWritable, MakesTheFolderButNotTheFile) {
    const TemporaryFolder folder;
    engine::checkWritable(folder.path() / "a/r.json");
    EXPECT_TRUE(std::filesystem::is_empty(folder.path() / "a"));
}

TEST(WriteReport, WritesIntoWhatIsNoFile) {
    EXPECT_NO_THROW(report::writeReport(report::reportJson(manySamples()), "/dev/null"));
    EXPECT_FALSE(std::filesystem::exists("/dev/null.samples.jsonl"));
}

TEST(Report, CommittedOnesFitTheSchema) {
    const std::string schema = textOf(kReportSchemaFile);
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(kReportSchemaFile.parent_path())) {
        if (entry.path().extension() != ".json" ||
            entry.path().filename().string().ends_with(".schema.json") ||
            !scene::Json::parse(textOf(entry.path()))["schema"].get<std::string>().starts_with(
                "hairbench-report/"))  // another kind
            continue;
        EXPECT_THAT(report::schemaErrors(schema, textOf(entry.path())), IsEmpty()) << entry.path();
        ++count;
    }
    EXPECT_GT(count, 0u);
}

}  // namespace
}  // namespace benchmarks
