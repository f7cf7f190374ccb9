#include "benchmarks/report/report.h"

#include <algorithm>
#include <filesystem>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "benchmarks/doctor/reports.h"
#include "tests/benchmarks/sample_report.h"
#include "tests/error_text.h"
#include "tests/temporary_folder.h"

namespace benchmarks {
namespace {

using testing::IsEmpty;

class SamplesFile : public testing::Test {
protected:
    void write(const report::Report& report) {
        report::writeReport(report::reportJson(report), file_);
    }
    scene::Json inFile() { return scene::Json::parse(textOf(file_)); }

    TemporaryFolder folder_;
    std::filesystem::path file_ = folder_.file("r.json");
    std::filesystem::path samples_ = folder_.file("r.samples.jsonl");
};

TEST_F(SamplesFile, HoldsWhatIsLargeAndIsReadBack) {
    write(manySamples());
    const scene::Json metrics = inFile()["cases"][0]["metrics"];
    EXPECT_EQ(metrics["frame.time"]["samples_file"], "r.samples.jsonl");
    EXPECT_EQ(metrics["frame.time"]["sample_count"], 2001);
    EXPECT_FALSE(metrics["frame.time"].contains("samples"));
    EXPECT_TRUE(metrics["fps"].contains("samples"));
    const std::string text = textOf(samples_);
    EXPECT_EQ(std::ranges::count(text, '\n'), 1);
    const scene::Json line = scene::Json::parse(text);
    EXPECT_EQ(line["case"], "thesis/density:64/backend:tessellation");
    EXPECT_EQ(line["metric"], "frame.time");
    EXPECT_EQ(line["samples"].size(), 2001u);
    EXPECT_EQ(report::readReport(file_).dump(), report::reportJson(manySamples()).dump());
}

TEST_F(SamplesFile, FitsTheSchema) {
    write(manySamples());
    const auto schema =
        std::filesystem::path(HAIRBENCH_SCENES_DIR) / "../results/report.schema.json";
    EXPECT_THAT(report::schemaErrors(textOf(schema), textOf(file_)), IsEmpty());
    scene::Json neither = inFile();
    neither["cases"][0]["metrics"]["frame.time"].erase("samples_file");
    EXPECT_THAT(report::schemaErrors(textOf(schema), neither.dump()), testing::Not(IsEmpty()));
}

TEST_F(SamplesFile, IsNotThereWhereNothingIsLarge) {
    write(sampleReport());
    EXPECT_FALSE(std::filesystem::exists(samples_));
    write(manySamples());
    EXPECT_TRUE(std::filesystem::exists(samples_));
    write(sampleReport());
    EXPECT_FALSE(std::filesystem::exists(samples_));
    report::Report few = manySamples();
    few.cases[0].metrics[0].samples.resize(2000);
    write(few);
    EXPECT_FALSE(std::filesystem::exists(samples_));
}

TEST_F(SamplesFile, LiesBesideWhatALinkPointsTo) {
    write(sampleReport());
    std::filesystem::create_directories(folder_.file("links"));
    const auto link = folder_.file("links/l.json");
    std::filesystem::create_symlink(file_, link);
    report::writeReport(report::reportJson(manySamples()), link);
    EXPECT_TRUE(std::filesystem::exists(samples_));
    EXPECT_EQ(report::readReport(link).dump(), report::readReport(file_).dump());
}

TEST_F(SamplesFile, IsMissedAndMustBeOfTheReport) {
    const auto error = [&] {
        return folder_.relative(errorText([&] { report::readReport(file_); }));
    };
    write(manySamples());
    const std::string right = textOf(samples_);
    std::filesystem::remove(samples_);
    EXPECT_EQ(error(), "r.json: its samples are missing: r.samples.jsonl");
    scene::Json line = scene::Json::parse(right);
    for (scene::Json& sample : line["samples"]) sample = sample.get<double>() * 2.0;
    const std::string doubled = line.dump() + '\n';
    line["samples"].erase(line["samples"].begin());
    for (const std::string& wrong : {doubled, line.dump(), std::string()}) {
        folder_.write("r.samples.jsonl", wrong);
        EXPECT_EQ(
            error(), "r.json: r.samples.jsonl belongs to another report: "
                     "thesis/density:64/backend:tessellation, frame.time");
    }
    folder_.write("r.samples.jsonl", right.substr(0, right.size() / 2));
    EXPECT_THAT(error(), testing::StartsWith("r.samples.jsonl:1:"));
}

}  // namespace
}  // namespace benchmarks
