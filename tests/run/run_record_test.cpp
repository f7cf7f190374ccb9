#include "benchmarks/run/record.h"

#include <filesystem>
#include <memory>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "benchmarks/report/report.h"
#include "tests/benchmarks/sample_report.h"
#include "tests/error_text.h"
#include "tests/temporary_folder.h"

namespace benchmarks::run {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// A run of four of a sweep's eight cases, without a device: the second of two shards.
class Record : public testing::Test {
protected:
    Record() {
        plan_.case_count = 8;
        plan_.cases_hash = "0011223344556677";
        for (std::size_t i = 1; i < 8; i += 2)
            plan_.cases.push_back(
                {.spec = {.name = "s/" + std::to_string(i)}, .directory = {}, .index = i});
        header_ = sampleReport();
        header_.case_count = 8;
        header_.shard = {.index = 2, .count = 2};
        header_.order_seed = 1;
    }

    RunRecord open(bool resume) {
        return RunRecord(plan_, header_, {.out = out_, .filter = filter_, .resume = resume});
    }
    std::string error(bool resume) {
        return folder_.relative(errorText([&] { open(resume); }));
    }
    // Runs up to `count` cases.
    void run(RunRecord& record, std::size_t count) {
        for (const auto& [place, order] : record.remaining()) {
            if (count-- == 0) return;
            const PlannedCase& each = plan_.cases[place];
            record.add({.name = each.spec.name, .index = each.index, .order = order});
        }
    }
    std::vector<std::size_t> placesLeft(const RunRecord& record) {
        std::vector<std::size_t> places;
        for (const RunRecord::Turn& turn : record.remaining()) places.push_back(turn.place);
        return places;
    }
    bool hasJournal() { return std::filesystem::exists(journalFile(out_)); }

    TemporaryFolder folder_;
    std::filesystem::path out_ = folder_.file("r.json");
    std::string filter_;
    RunPlan plan_;
    report::ReportHeader header_;
};

TEST_F(Record, RunsInTheSeedsOrderAndReportsInTheSweeps) {
    RunRecord record = open(false);
    EXPECT_EQ(placesLeft(record), shuffledOrder(4, 1));
    run(record, 4);
    const scene::Json report = record.report(false);
    ASSERT_EQ(report["cases"].size(), 4u);
    for (std::size_t place = 0; place < 4; ++place) {
        const scene::Json& each = report["cases"][place];
        EXPECT_EQ(each["index"], 2 * place + 1);
        EXPECT_EQ(shuffledOrder(4, 1)[each["order"].get<std::size_t>()], place);
    }
    record.write(report);
    EXPECT_FALSE(hasJournal());
    EXPECT_EQ(report::readReport(out_), report);
}

TEST_F(Record, GoesOnAsIfNothingHadHappened) {
    std::string whole;
    {
        RunRecord record = open(false);
        run(record, 4);
        whole = record.report(false).dump();
    }
    for (std::size_t before = 0; before <= 4; ++before) {
        std::filesystem::remove(journalFile(out_));
        {
            RunRecord record = open(false);
            run(record, before);
        }
        header_.order_seed = 77;  // another start, with another seed and later
        header_.environment.started = "2031-01-01T00:00:00Z";
        RunRecord record = open(true);
        EXPECT_EQ(record.done(), before);
        run(record, 4);
        EXPECT_EQ(record.report(false).dump(), whole);
        header_.order_seed = 1;
        header_.environment.started = sampleReport().environment.started;
    }
}

// A line that was damaged costs its case.
TEST_F(Record, PlaysAgainWhatIsDamaged) {
    std::string whole;
    {
        RunRecord record = open(false);
        run(record, 4);
        whole = record.report(false).dump();
    }
    std::string text = textOf(journalFile(out_));
    const std::size_t second = text.find('\n', text.find('\n') + 1) + 1;  // of the cases
    text.replace(second, 4, "null");
    folder_.write("r.json.journal", text);
    testing::internal::CaptureStderr();
    RunRecord record = open(true);
    EXPECT_THAT(
        testing::internal::GetCapturedStderr(),
        HasSubstr("r.json.journal: line 3 is damaged: left out\n"));
    EXPECT_EQ(record.done(), 3u);
    ASSERT_THAT(placesLeft(record), ElementsAre(shuffledOrder(4, 1)[1]));
    run(record, 1);
    EXPECT_EQ(record.report(false).dump(), whole);
}

// Whole lines that are none of the run's.
TEST_F(Record, LeavesOutWhatIsNoCaseOfTheRun) {
    {
        RunRecord record = open(false);
        run(record, 2);
    }
    const std::string before = textOf(journalFile(out_));
    scene::Json twice;
    {
        Journal journal(journalFile(out_));
        twice = journal.read()[1];
    }
    scene::Json foreign = twice;
    foreign["index"] = 2;  // of the other shard
    scene::Json huge = twice;
    huge["index"] = 18446744073709551615u;
    scene::Json negative = twice;
    negative["index"] = -1;
    scene::Json renamed = twice;
    renamed["index"] = shuffledOrder(4, 1)[3] * 2 + 1;
    scene::Json without = twice;
    without.erase("order");
    scene::Json misshapen = twice;
    misshapen["index"] = shuffledOrder(4, 1)[2] * 2 + 1;
    misshapen["name"] = "s/" + misshapen["index"].dump();
    ASSERT_TRUE(misshapen["axes"].is_object());
    misshapen["sampling"] = 5;
    for (const scene::Json& line :
         {twice, foreign, huge, negative, renamed, without, misshapen, scene::Json(),
          scene::Json::object(), scene::Json("text")}) {
        folder_.write("r.json.journal", before);
        {
            Journal journal(journalFile(out_));
            journal.read();
            journal.append(line);
        }
        testing::internal::CaptureStderr();
        EXPECT_EQ(open(true).done(), 2u) << line;
        EXPECT_THAT(
            testing::internal::GetCapturedStderr(),
            HasSubstr("a line is no case of this run, or there twice: left out"))
            << line;
    }
}

TEST_F(Record, KeepsTheJournalOfAnInterruptedRun) {
    {
        RunRecord record = open(false);
        run(record, 1);
        record.write(record.report(true));
    }
    EXPECT_EQ(report::readReport(out_)["interrupted"], true);
    EXPECT_TRUE(hasJournal());
    EXPECT_EQ(open(true).done(), 1u);
}

TEST_F(Record, ResumesFromNothing) { EXPECT_EQ(open(true).done(), 0u); }

TEST_F(Record, DoesNotThrowAwayWhatIsUnfinished) {
    {
        RunRecord record = open(false);
        run(record, 3);
    }
    EXPECT_EQ(
        error(false), "r.json.journal: there are 3 of 4 cases of a run that was not finished: "
                      "--resume goes on with it, removing the file starts anew");
    EXPECT_EQ(open(true).done(), 3u);
}

TEST_F(Record, ReplacesAJournalWithoutACase) {
    {
        open(false);
    }
    EXPECT_EQ(open(false).done(), 0u);
}

TEST_F(Record, SaysInWhatTheJournalIsOfAnotherRun) {
    {
        RunRecord record = open(false);
        run(record, 3);
    }
    const report::ReportHeader header = header_;
    const RunPlan plan = plan_;
    const auto expect = [&](const char* difference) {
        EXPECT_EQ(error(true), std::string("r.json.journal: can't go on: ") + difference);
        header_ = header;
        plan_ = plan;
        filter_.clear();
        EXPECT_EQ(open(true).done(), 3u);  // and it is as it was
    };
    header_.scene.hash = "ffffffffffffffff";
    expect("hash of the scene: 0123456789abcdef is not ffffffffffffffff");
    header_.case_count = 9;
    expect("number of the sweep's cases: 8 is not 9");
    header_.environment.build.commit = "def";
    expect("commit of the build: abc is not def");
    header_.environment.build.type = "Debug";
    expect("type of the build: Release is not Debug");
    header_.environment.device.name = "Hard";
    expect("device: Soft is not Hard");
    header_.environment.device.driver_version = "25.0";
    expect("driver version: 22.3.6 is not 25.0");
    header_.environment.host.processor = "Other CPU";  // on which a software device runs
    expect("processor: Some CPU is not Other CPU");
    header_.environment.validation = true;
    expect("validation layer: false is not true");
    header_.shard = {.index = 1, .count = 2};
    expect("it is of another --shard");
    header_.shard.reset();
    expect("it is of another --shard");
    filter_ = "s";
    expect("it is of another --filter");
    plan_.cases_hash = "8899aabbccddeeff";
    expect("its cases are others");
}

TEST_F(Record, ReplacesTheJournalOfAnotherRun) {
    {
        RunRecord record = open(false);
        run(record, 3);
    }
    header_.environment.build.commit = "def";
    testing::internal::CaptureStderr();
    EXPECT_EQ(open(false).done(), 0u);
    EXPECT_THAT(
        testing::internal::GetCapturedStderr(),
        HasSubstr("r.json.journal: replaces 3 of 4 cases of another run: commit of the build: abc "
                  "is not def\n"));
}

TEST_F(Record, IsNotMisledByOtherFiles) {
    folder_.write("r.json.journal", "{\"some\": \"json\"}\n");
    EXPECT_THAT(error(true), HasSubstr("r.json.journal: is no journal of hairbench run"));
    EXPECT_THAT(error(false), HasSubstr("r.json.journal: is no journal of hairbench run"));
}

TEST_F(Record, HasNoJournalBesideWhatIsNoFile) {
    out_ = "/dev/null";
    EXPECT_FALSE(open(false).hasJournal());
    EXPECT_EQ(error(true), "--resume: /dev/null is no file");
}

TEST_F(Record, FindsTheCompleteReport) {
    {
        RunRecord record = open(false);
        run(record, 4);
        record.write(record.report(false));
    }
    header_.order_seed = 99;
    EXPECT_TRUE(completeReport(plan_, header_, out_));
    const auto is_other = [&](auto change) {
        const RunPlan plan = plan_;
        const report::ReportHeader header = header_;
        change();
        EXPECT_FALSE(completeReport(plan_, header_, out_));
        plan_ = plan;
        header_ = header;
    };
    is_other([&] { header_.environment.build.commit = "def"; });
    is_other([&] { header_.shard.reset(); });
    is_other([&] { plan_.cases.pop_back(); });
    is_other([&] { plan_.cases.front().spec.name = "s/other"; });
    is_other([&] { plan_.cases.front().index = 0; });
    is_other([&] { folder_.write("r.json.journal", ""); });
    std::filesystem::remove(journalFile(out_));
    EXPECT_TRUE(completeReport(plan_, header_, out_));
    scene::Json interrupted = report::readReport(out_);
    interrupted["interrupted"] = true;
    report::writeReport(interrupted, out_);
    EXPECT_FALSE(completeReport(plan_, header_, out_));
    folder_.write("r.json", "no report");
    EXPECT_FALSE(completeReport(plan_, header_, out_));
}

}  // namespace
}  // namespace benchmarks::run
