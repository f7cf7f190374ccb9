#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/report/report.h"
#include "benchmarks/run/plan.h"
#include "benchmarks/scene/json.h"
#include "engine/process.h"

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
    // What a line outlives once append() returns.
    enum class Lasts { crash, process };

    // Opens it, or makes it with its folder. Throws engine::Error "<path>: <reason>" where another
    // process has it or it can't be opened.
    explicit Journal(std::filesystem::path path, Lasts lasts = Lasts::crash);
    // An empty one is removed.
    ~Journal();
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;

    // Where a line is in the file, B.
    struct Place {
        std::uintmax_t begin = 0;
        std::size_t size = 0;  // without its end
    };

    // Calls `visit` with the values of the whole lines, one after another. Throws engine::Error
    // where the first has none: it is some other file.
    void read(const std::function<void(scene::Json value, const Place& place)>& visit);
    // The numbers of the lines, the first is 1, that read() left out.
    const std::vector<std::size_t>& damaged() const { return damaged_; }

    // The value of a line that read() or append() has given. Throws engine::Error where it is not
    // there any more as it was.
    scene::Json at(const Place& place) const;

    // Appends behind the last whole line. Throws WriteFailed, and leaves those before as
    // they were.
    Place append(const scene::Json& line);

    // Forgets all lines: the next append() is the first.
    void clear();

    // Removes the file, once nobody needs it.
    void remove();

private:
    std::filesystem::path path_;
    Lasts lasts_;
    int file_;
    std::uintmax_t size_ = 0;  // B, of the whole lines
    bool ends_there_ = false;  // where false, something may be behind them
    std::vector<std::size_t> damaged_;
};

inline constexpr const char* kJournalSchema = "hairbench-journal/2.0.0";

struct RecordOptions {
    std::filesystem::path out;  // the report
    std::string filter;  // that the plan was made with
    bool resume = false;  // go on with the journal that is there
};

enum class RunEnd { complete, interrupted };

// What a run has done and has still to do, kept in "<out>.journal" until its report is written, so
// that a run that was killed can go on. Its first line says whose it is; each other is a case as
// reports have it, in the order in which they ran. What is none of the plan's, or there twice, is
// left out with a line on stderr, and so is a damaged line: such a case is played again. In memory
// is of a case only where its line is.
class RunRecord {
public:
    // Throws engine::Error "<journal>: <reason>" where the journal is of another run and `resume`
    // is set, or of this one and it is not; WriteFailed as Journal. Without `resume` another run's
    // is replaced, with a line on stderr. Where `out` is no file (/dev/stdout) the journal is one
    // that nobody keeps.
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
    std::size_t done() const { return done_.size(); }
    // Of these, cases that were measured: neither skipped nor failed.
    std::size_t measured() const { return measured_; }
    // False where `out` is no file, beside which nothing can be.
    bool hasJournal() const { return !scratch_; }

    // Throws WriteFailed "<journal>: <reason>; <what is kept>".
    void add(const report::CaseResult& result);

    // The report but for its cases.
    const scene::Json& header() const { return *header_; }
    // Calls `visit` with each case, in the sweep's order. Throws engine::Error where the journal
    // was changed by others.
    void eachCase(const std::function<void(scene::Json)>& visit) const;

    // Writes the report, all cases in the sweep's order; where the run is complete the journal is
    // removed, and nothing is left here. Throws WriteFailed, and keeps the journal.
    void write(RunEnd end);

private:
    struct Done {
        std::size_t index = 0;  // in the sweep
        Journal::Place line;
    };
    void keep(std::size_t index, const std::string& status, const Journal::Place& line);

    std::filesystem::path out_;
    std::unique_ptr<engine::ScratchFolder> scratch_;  // of a journal that nobody keeps
    std::unique_ptr<Journal> journal_;
    std::unique_ptr<scene::Json> header_;
    std::vector<Done> done_;
    std::size_t measured_ = 0;
    std::vector<Turn> remaining_;
};

std::filesystem::path journalFile(const std::filesystem::path& report);

// How many cases of the report at `out` were measured, if it is complete and of the same plan on
// the same build and device, and no journal says that a run is under way.
std::optional<std::size_t> measuredInComplete(
    const RunPlan& plan, const report::ReportHeader& header, const std::filesystem::path& out);

}  // namespace benchmarks::run
