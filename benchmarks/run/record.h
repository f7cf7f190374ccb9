#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/report/report.h"
#include "benchmarks/run/plan.h"
#include "benchmarks/scene/json.h"

// Journal of a run, from which an interrupted run is resumed.
namespace benchmarks::run {

// In what two reports, or their headers (headerJson), differ that one sweep has in common: the
// scene, the number of its cases, the build, the device and its driver, on a software device the
// processor. "driver version: 1.2 is not 1.3", `a` first; nothing where they belong together.
std::optional<std::string> identityDifference(const scene::Json& a, const scene::Json& b);

// A file of JSON values, one a line, that survives the end of its writer at any moment: a line is
// handed over in one piece and on the disk when append() returns, and one that was cut short is not
// there for who reads. A line has the hash of its value's text with it (report::hashText()), so
// that one that was damaged is left out, and no other:
//   {"hash":"ef46db3751d8e999","line":VALUE}
// No two processes have it at a time.
class Journal {
public:
    // Opens it, or makes it with its folder. Throws engine::Error "<path>: <reason>" where another
    // process has it or it can't be opened.
    explicit Journal(std::filesystem::path path);
    // An empty one is removed.
    ~Journal();
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;

    // The values of the whole lines. Throws engine::Error where the first has none: it is some
    // other file.
    std::vector<scene::Json> read();
    // The numbers of the lines, the first is 1, that read() left out.
    const std::vector<std::size_t>& damaged() const { return damaged_; }

    // Appends behind the last whole line. Throws WriteFailed, and leaves those before as
    // they were.
    void append(const scene::Json& line);

    // Forgets all lines: the next append() is the first.
    void clear();

    // Removes the file, once nobody needs it.
    void remove();

private:
    std::filesystem::path path_;
    int file_;
    std::uintmax_t size_ = 0;  // B, of the whole lines
    std::vector<std::size_t> damaged_;
};

inline constexpr const char* kJournalSchema = "hairbench-journal/2.0.0";

struct RecordOptions {
    std::filesystem::path out;  // the report
    std::string filter;  // that the plan was made with
    bool resume = false;  // go on with the journal that is there
};

// What a run has done and has still to do, kept in "<out>.journal" until its report is written, so
// that a run that was killed can go on. Its first line says whose it is; each other is a case as
// reports have it, in the order in which they ran. What is none of the plan's, or there twice, is
// left out with a line on stderr, and so is a damaged line: such a case is played again.
class RunRecord {
public:
    // Throws engine::Error "<journal>: <reason>" where the journal is of another run and `resume`
    // is set, or of this one and it is not; WriteFailed as Journal. Without `resume` another run's
    // is replaced, with a line on stderr. Where `out` is no file (/dev/stdout) there is no journal.
    RunRecord(
        const RunPlan& plan, const report::ReportHeader& header, const RecordOptions& options);
    ~RunRecord();
    RunRecord(const RunRecord&) = delete;
    RunRecord& operator=(const RunRecord&) = delete;

    struct Turn {
        std::size_t place = 0;  // of the case in the plan
        std::size_t order = 0;  // in which it runs, from 0
    };
    // The cases that are left, in the order that the seed of the run's beginning decides.
    const std::vector<Turn>& remaining() const { return remaining_; }
    std::size_t done() const;
    // False where `out` is no file, beside which nothing can be.
    bool hasJournal() const { return journal_ != nullptr; }

    // Throws WriteFailed "<journal>: <reason>; <what is kept>".
    void add(const report::CaseResult& result);

    // All cases in the sweep's order.
    scene::Json report(bool interrupted) const;

    // Writes the report; the journal is removed unless it was interrupted. Throws WriteFailed, and
    // keeps the journal.
    void write(const scene::Json& report);

private:
    std::filesystem::path out_;
    std::unique_ptr<Journal> journal_;
    std::unique_ptr<scene::Json> header_;
    std::vector<scene::Json> cases_;
    std::vector<Turn> remaining_;
};

std::filesystem::path journalFile(const std::filesystem::path& report);

// The report at `out` if it is complete and of the same plan on the same build and device, and no
// journal says that a run is under way.
std::unique_ptr<scene::Json> completeReport(
    const RunPlan& plan, const report::ReportHeader& header, const std::filesystem::path& out);

}  // namespace benchmarks::run
