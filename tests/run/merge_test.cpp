#include "benchmarks/run/run.h"

#include <filesystem>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "benchmarks/report/report.h"
#include "tests/benchmarks/sample_report.h"
#include "tests/error_text.h"
#include "tests/temporary_folder.h"

namespace benchmarks::run {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// Reports of parts of a sweep of six cases.
class Merge : public testing::Test {
protected:
    static report::Report
    part(std::initializer_list<std::size_t> indices, std::optional<report::Shard> shard) {
        report::Report report;
        static_cast<report::ReportHeader&>(report) = sampleReport();
        report.shard = shard;
        std::size_t order = 0;
        for (const std::size_t index : indices) {
            report::CaseResult result = sampleReport().cases.front();
            result.name = "s/" + std::to_string(index);
            result.index = index;
            result.order = order++;
            result.picture = "p.pictures/" + std::to_string(index) + ".png";
            report.cases.push_back(result);
        }
        return report;
    }
    void write(const std::string& name, const report::Report& report) {
        report::writeReport(report::reportJson(report), folder_.file(name));
        files_.push_back(folder_.file(name));
    }
    scene::Json merge(bool force = false) {
        notes_.clear();
        scene::Json report =
            mergedReport(files_, {.out = folder_.file("out/whole.json"), .force = force}, notes_);
        for (std::string& note : notes_) note = folder_.relative(note);
        return report;
    }
    std::string error() {
        return folder_.relative(errorText([&] { merge(); }));
    }
    static std::vector<std::size_t> indices(const scene::Json& report) {
        std::vector<std::size_t> found;
        for (const scene::Json& each : report["cases"]) found.push_back(each["index"]);
        return found;
    }

    TemporaryFolder folder_;
    std::vector<std::filesystem::path> files_;
    std::vector<std::string> notes_;
};

TEST_F(Merge, OfAllShardsIsTheWholeReport) {
    write("b.json", part({1, 4}, report::Shard{2, 3}));
    write("a.json", part({0, 3}, report::Shard{1, 3}));
    write("c.json", part({5, 2}, report::Shard{3, 3}));
    const scene::Json merged = merge();
    EXPECT_THAT(notes_, IsEmpty());
    scene::Json whole = report::reportJson(part({0, 1, 2, 3, 4, 5}, {}));
    for (std::size_t i = 0; i < 6; ++i) {
        whole["cases"][i]["picture"] = "../p.pictures/" + std::to_string(i) + ".png";
        whole["cases"][i]["order"] = merged["cases"][i]["order"];
        report::putVerdict(whole["environment"], whole["cases"][i]);
    }
    EXPECT_EQ(merged.dump(), whole.dump());
}

TEST_F(Merge, PutsSamplesBackAndMovesPictures) {
    report::Report large = part({0, 3}, report::Shard{1, 2});
    large.cases[0].metrics = manySamples().cases[0].metrics;
    write("shards/1/r.json", large);
    ASSERT_TRUE(std::filesystem::exists(folder_.file("shards/1/r.samples.jsonl")));
    const scene::Json merged = merge();
    EXPECT_EQ(merged["cases"][0]["metrics"]["frame.time"]["samples"].size(), 2001u);
    EXPECT_EQ(merged["cases"][0]["picture"], "../shards/1/p.pictures/0.png");
}

TEST_F(Merge, SaysWhichCasesAreMissing) {
    write("a.json", part({0, 3}, report::Shard{1, 3}));
    write("c.json", part({2, 5}, report::Shard{3, 3}));
    const scene::Json merged = merge();
    EXPECT_EQ(merged["interrupted"], true);
    EXPECT_FALSE(merged.contains("shard"));
    EXPECT_THAT(indices(merged), ElementsAre(0, 2, 3, 5));
    EXPECT_THAT(
        notes_, ElementsAre("2 of 6 cases are missing: number 1, 4 of the sweep, counted from 0"));
}

TEST_F(Merge, NamesOnlyTheFirstOfManyMissing) {
    report::Report few = part({0}, report::Shard{1, 2});
    few.case_count = 100;
    write("a.json", few);
    merge();
    EXPECT_THAT(
        notes_, ElementsAre("99 of 100 cases are missing: number 1, 2, 3, 4, 5, 6, 7, 8 ... of the "
                            "sweep, counted from 0"));
}

TEST_F(Merge, TakesWhatAFilterLeft) {
    write("a.json", part({3}, report::Shard{1, 2}));
    write("b.json", part({4}, report::Shard{2, 2}));
    EXPECT_EQ(merge()["interrupted"], false);
    EXPECT_THAT(notes_, IsEmpty());
    // The cases that an interrupted shard lacks are unknown.
    report::Report stopped = part({4}, report::Shard{2, 2});
    stopped.interrupted = true;
    report::writeReport(report::reportJson(stopped), folder_.file("b.json"));
    EXPECT_EQ(merge()["interrupted"], true);
}

TEST_F(Merge, TakesPartsThatFiltersMade) {
    write("a.json", part({0, 1, 2}, {}));
    write("b.json", part({3, 4, 5}, {}));
    EXPECT_EQ(merge()["interrupted"], false);
    EXPECT_THAT(notes_, IsEmpty());
}

TEST_F(Merge, HasAnOrderSeedWhereAllHadTheSame) {
    write("a.json", part({0, 2, 4}, report::Shard{1, 2}));
    report::Report other = part({1, 3, 5}, report::Shard{2, 2});
    write("b.json", other);
    EXPECT_EQ(merge()["order_seed"], 11);
    other.order_seed = 12;
    report::writeReport(report::reportJson(other), folder_.file("b.json"));
    EXPECT_FALSE(merge().contains("order_seed"));
}

TEST_F(Merge, RefusesWhatDoesNotBelongTogether) {
    const report::Report b = part({1}, report::Shard{2, 2});
    write("a.json", part({0}, report::Shard{1, 2}));
    write("b.json", b);
    const auto expect = [&](const report::Report& changed, const char* difference) {
        report::writeReport(report::reportJson(changed), folder_.file("b.json"));
        const std::string expected = std::string("b.json: ") + difference + ", as in a.json";
        EXPECT_EQ(error(), expected);
        EXPECT_THAT(indices(merge(true)), ElementsAre(0, 1));
        ASSERT_FALSE(notes_.empty());
        EXPECT_EQ(notes_.front(), expected);
    };
    report::Report changed = b;
    changed.scene.hash = "ffffffffffffffff";
    expect(changed, "hash of the scene: ffffffffffffffff is not 0123456789abcdef");
    changed = b;
    changed.case_count = 7;
    expect(changed, "number of the sweep's cases: 7 is not 6");
    changed = b;
    changed.environment.build.commit = "def";
    expect(changed, "commit of the build: def is not abc");
    changed = b;
    changed.environment.device.name = "Hard";
    expect(changed, "device: Hard is not Soft");
    changed = b;
    changed.environment.device.driver_version.clear();
    expect(changed, "driver version: unknown is not 22.3.6");
}

TEST_F(Merge, RefusesACaseThatIsThereTwice) {
    write("a.json", part({0, 1}, report::Shard{1, 2}));
    report::Report again = part({1, 2}, report::Shard{2, 2});
    again.cases[0].image_hash = "1111111111111111";
    write("b.json", again);
    EXPECT_EQ(error(), "b.json: s/1 is also in a.json");
    const scene::Json forced = merge(true);
    EXPECT_THAT(indices(forced), ElementsAre(0, 1, 2));
    EXPECT_EQ(forced["cases"][1]["image_hash"], "00000000000000ff");  // from the first report
    again.cases[0].name = "s/other";  // belongs to a sweep with other axes
    report::writeReport(report::reportJson(again), folder_.file("b.json"));
    EXPECT_EQ(error(), "b.json: s/other has the number 1 of another case of a.json");
}

TEST_F(Merge, TakesReportsThatDoNotNumberTheirCases) {
    for (const char* name : {"a", "b"}) {
        report::Report old = part({0}, {});
        old.case_count.reset();
        old.cases[0].index.reset();
        old.cases[0].name = name;
        write(std::string(name) + ".json", old);
    }
    const scene::Json merged = merge();
    ASSERT_EQ(merged["cases"].size(), 2u);
    EXPECT_EQ(merged["cases"][0]["name"], "a");
    EXPECT_EQ(merged["interrupted"], false);
}

}  // namespace
}  // namespace benchmarks::run
