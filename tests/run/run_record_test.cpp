#include "benchmarks/run/record.h"

#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "benchmarks/report/report.h"
#include "benchmarks/report/verdict.h"
#include "tests/benchmarks/sample_report.h"
#include "tests/error_text.h"
#include "tests/printed_text.h"
#include "tests/temporary_folder.h"

namespace benchmarks::run {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// A run of four of a sweep's eight cases without a device: the second of two shards.
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
    // Returns a running report's text so far.
    static std::string textSoFar(const RunRecord& record) {
        std::string text = record.header().dump();
        record.eachCase([&](const scene::Json& each) { text += '\n' + each.dump(); });
        return text;
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
    record.write(RunEnd::complete);
    EXPECT_FALSE(hasJournal());
    const scene::Json report = report::readReport(out_);
    ASSERT_EQ(report["cases"].size(), 4u);
    for (std::size_t place = 0; place < 4; ++place) {
        const scene::Json& each = report["cases"][place];
        EXPECT_EQ(each["index"], 2 * place + 1);
        EXPECT_EQ(shuffledOrder(4, 1)[each["order"].get<std::size_t>()], place);
    }
}

TEST_F(Record, GoesOnAsIfNothingHadHappened) {
    std::string whole;
    {
        RunRecord record = open(false);
        run(record, 4);
        whole = textSoFar(record);
    }
    for (std::size_t before = 0; before <= 4; ++before) {
        std::filesystem::remove(journalFile(out_));
        {
            RunRecord record = open(false);
            run(record, before);
        }
        header_.order_seed = 77;  // a later start with another seed
        header_.environment.started = "2031-01-01T00:00:00Z";
        RunRecord record = open(true);
        EXPECT_EQ(record.done(), before);
        run(record, 4);
        EXPECT_EQ(textSoFar(record), whole);
        header_.order_seed = 1;
        header_.environment.started = sampleReport().environment.started;
    }
}

// A damaged line loses only its case.
TEST_F(Record, PlaysAgainWhatIsDamaged) {
    std::string whole;
    {
        RunRecord record = open(false);
        run(record, 4);
        whole = textSoFar(record);
    }
    std::string text = textOf(journalFile(out_));
    const std::size_t second = text.find('\n', text.find('\n') + 1) + 1;  // second case
    text.replace(second, 4, "null");
    folder_.write("r.json.journal", text);
    std::unique_ptr<RunRecord> record;
    EXPECT_THAT(
        printedText(Printed::to_stderr, [&] { record.reset(new RunRecord(open(true))); }),
        HasSubstr("r.json.journal: line 3 is damaged and left out\n"));
    EXPECT_EQ(record->done(), 3u);
    ASSERT_THAT(placesLeft(*record), ElementsAre(shuffledOrder(4, 1)[1]));
    run(*record, 1);
    EXPECT_EQ(textSoFar(*record), whole);
}

// Undamaged lines that do not belong to the run.
TEST_F(Record, LeavesOutWhatIsNoCaseOfTheRun) {
    {
        RunRecord record = open(false);
        run(record, 2);
    }
    const std::string before = textOf(journalFile(out_));
    scene::Json twice;
    {
        Journal journal(journalFile(out_));
        std::size_t line = 0;
        journal.read([&](scene::Json value, const Journal::Place&) {
            if (line++ == 1) twice = std::move(value);
        });
    }
    scene::Json foreign = twice;
    foreign["index"] = 2;  // in the other shard
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
            journal.read([](const scene::Json&, const Journal::Place&) {});
            journal.append(line);
        }
        EXPECT_THAT(
            printedText(Printed::to_stderr, [&] { EXPECT_EQ(open(true).done(), 2u) << line; }),
            HasSubstr("a line is not a case of this run, or repeats one, and is left out"))
            << line;
    }
}

TEST_F(Record, KeepsTheJournalOfAnInterruptedRun) {
    {
        RunRecord record = open(false);
        run(record, 1);
        record.write(RunEnd::interrupted);
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
                      "--resume continues it; remove the file to start anew");
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
        EXPECT_EQ(error(true), std::string("r.json.journal: can't be resumed: ") + difference);
        header_ = header;
        plan_ = plan;
        filter_.clear();
        EXPECT_EQ(open(true).done(), 3u);  // nothing has changed
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
    header_.environment.host.processor = "Other CPU";  // a software device runs on it
    expect("processor: Some CPU is not Other CPU");
    header_.environment.validation = true;
    expect("validation layer: false is not true");
    header_.shard = {.index = 1, .count = 2};
    expect("its --shard differs");
    header_.shard.reset();
    expect("its --shard differs");
    filter_ = "s";
    expect("its --filter differs");
    plan_.cases_hash = "8899aabbccddeeff";
    expect("its cases differ");
}

TEST_F(Record, ReplacesTheJournalOfAnotherRun) {
    {
        RunRecord record = open(false);
        run(record, 3);
    }
    header_.environment.build.commit = "def";
    EXPECT_THAT(
        printedText(Printed::to_stderr, [&] { EXPECT_EQ(open(false).done(), 0u); }),
        HasSubstr("r.json.journal: replaces 3 of 4 cases of another run: commit of the build: abc "
                  "is not def\n"));
}

TEST_F(Record, IsNotMisledByOtherFiles) {
    folder_.write("r.json.journal", "{\"some\": \"json\"}\n");
    EXPECT_THAT(error(true), HasSubstr("r.json.journal: is not a journal of 'hairbench run'"));
    EXPECT_THAT(error(false), HasSubstr("r.json.journal: is not a journal of 'hairbench run'"));
}

TEST_F(Record, HasNoJournalBesideWhatIsNoFile) {
    out_ = "/dev/null";
    EXPECT_EQ(error(true), "--resume: /dev/null is not a file");
    RunRecord record = open(false);
    EXPECT_FALSE(record.hasJournal());
    run(record, 4);
    std::vector<std::size_t> indices;
    record.eachCase([&](const scene::Json& each) { indices.push_back(each["index"]); });
    EXPECT_THAT(indices, ElementsAre(1, 3, 5, 7));
    record.write(RunEnd::complete);
    EXPECT_FALSE(std::filesystem::exists("/dev/null.journal"));
}

// Writes the same bytes as for a report with all cases in memory.
TEST_F(Record, WritesWhatIsWrittenOfCasesInMemory) {
    report::Report report = manySamples();  // in a separate file
    report.interrupted = true;
    static_cast<report::ReportHeader&>(report) = header_;
    plan_.cases.clear();
    report.cases[1].reason = "\xff is no UTF-8";
    for (const report::CaseResult& each : report.cases)
        plan_.cases.push_back({.spec = {.name = each.name}, .directory = {}, .index = *each.index});
    {
        RunRecord record = open(false);
        for (const std::size_t i : {2, 0, 1}) record.add(report.cases[i]);
        EXPECT_EQ(record.measured(), 1u);
        record.write(RunEnd::interrupted);
    }
    const std::string written = textOf(out_);
    const std::string samples = textOf(folder_.file("r.samples.jsonl"));
    scene::Json in_memory = report::reportJson(report);
    for (scene::Json& each : in_memory["cases"]) report::putVerdict(in_memory["environment"], each);
    report::writeReport(in_memory, out_);
    EXPECT_EQ(written, textOf(out_));
    EXPECT_EQ(samples, textOf(folder_.file("r.samples.jsonl")));
    EXPECT_EQ(written, [&] {
        scene::Json whole = scene::Json::parse(textOf(out_));
        return whole.dump(2) + '\n';
    }());
}

// Returns how many bytes this process has read so far, by any system call.
std::uintmax_t bytesRead() {
    std::istringstream counts(textOf("/proc/self/io"));
    std::string name;
    std::uintmax_t count = 0;
    while (counts >> name >> count)
        if (name == "rchar:") return count;
    return 0;
}

TEST_F(Record, ReadsEachCaseOnceForTheReport) {
    report::CaseResult result = sampleReport().cases[0];
    result.trust.warnings = {std::string(1u << 20, 'x')};
    RunRecord record = open(false);
    for (const auto& [place, order] : record.remaining()) {
        result.name = plan_.cases[place].spec.name;
        result.index = plan_.cases[place].index;
        record.add(result);
    }
    const auto size = static_cast<double>(std::filesystem::file_size(journalFile(out_)));
    std::vector<std::string> names;
    const std::uintmax_t before = bytesRead();
    record.write(RunEnd::complete, [&](const scene::Json& each) { names.push_back(each["name"]); });
    const auto read = static_cast<double>(bytesRead() - before);
    std::cout << "the report reads " << read / size << " times the journal\n";
    EXPECT_THAT(names, ElementsAre("s/1", "s/3", "s/5", "s/7"));
    EXPECT_GT(before, 0u);
    EXPECT_NEAR(read / size, 1.0, 0.05);
}

// Returns the peak memory of a process that runs `play`, kB.
long peakMemoryOf(const std::function<void()>& play) {
    int ends[2];
    if (pipe(ends) != 0) return -1;
    const pid_t child = fork();
    if (child == 0) {
        play();
        if (testing::Test::HasFailure()) _exit(1);
        rusage use{};
        getrusage(RUSAGE_SELF, &use);
        _exit(::write(ends[1], &use.ru_maxrss, sizeof use.ru_maxrss) > 0 ? 0 : 1);
    }
    long peak = -1;
    close(ends[1]);
    if (read(ends[0], &peak, sizeof peak) != sizeof peak) peak = -1;
    close(ends[0]);
    waitpid(child, nullptr, 0);
    return peak;
}

// 10,000 cases take no more memory than a few, because each keeps only the place of its line.
TEST_F(Record, IsFlatInMemory) {
    constexpr std::size_t kFew = 100;
    constexpr std::size_t kMany = 10'000;
    report::CaseResult result = sampleReport().cases[0];
    result.metrics.clear();
    result.trust.warnings = {std::string(3000, 'x')};
    plan_.cases.clear();
    plan_.case_count = kMany;
    for (std::size_t i = 0; i < kMany; ++i)
        plan_.cases.push_back(
            {.spec = {.name = "s/" + std::to_string(i)}, .directory = {}, .index = i});
    out_ = "/dev/null";  // avoids a slow write to disk after each line
    const auto play = [&](std::size_t count) {
        RunRecord record = open(false);
        for (const auto& [place, order] : record.remaining()) {
            if (count-- == 0) break;
            result.name = plan_.cases[place].spec.name;
            result.index = plan_.cases[place].index;
            result.order = order;
            record.add(result);
        }
        std::size_t found = 0;
        record.eachCase([&](const scene::Json& each) { found += each.contains("metrics"); });
        EXPECT_EQ(found, record.done());
        record.write(RunEnd::complete);
    };
    const long few = peakMemoryOf([&] { play(kFew); });
    const long many = peakMemoryOf([&] { play(kMany); });
    ASSERT_GT(few, 0);
    ASSERT_GT(many, 0);
    EXPECT_LT((many - few) * 1024.0 / (kMany - kFew), 1000.0) << few << " kB, " << many << " kB";
}

TEST_F(Record, FindsTheCompleteReport) {
    {
        RunRecord record = open(false);
        run(record, 4);
        record.write(RunEnd::complete);
    }
    header_.order_seed = 99;
    EXPECT_EQ(measuredInComplete(plan_, header_, out_), 4u);
    const auto is_other = [&](auto change) {
        const RunPlan plan = plan_;
        const report::ReportHeader header = header_;
        change();
        EXPECT_FALSE(measuredInComplete(plan_, header_, out_));
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
    EXPECT_EQ(measuredInComplete(plan_, header_, out_), 4u);
    scene::Json interrupted = report::readReport(out_);
    interrupted["interrupted"] = true;
    report::writeReport(interrupted, out_);
    EXPECT_FALSE(measuredInComplete(plan_, header_, out_));
    folder_.write("r.json", "no report");
    EXPECT_FALSE(measuredInComplete(plan_, header_, out_));
}

}  // namespace
}  // namespace benchmarks::run
