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
#include "engine/system/files.h"

// Journal of a run, from which an interrupted run is resumed.
namespace benchmarks::run {

// Returns a difference between two reports, or their headers (headerJson), in what the parts of one
// sweep share: the scene, its number of cases, the build, the device and its driver, and the
// processor for a software device. "driver version: 1.2 is not 1.3", `a` first; nothing if they
// belong together.
std::optional<std::string> identityDifference(const scene::Json& a, const scene::Json& b);

// A file of JSON values, one per line, that survives the death of its writer at any moment.
// append() writes a line in one piece and returns once it is on disk. Readers ignore a line that
// was cut short. Each line contains the hash of its value's text (report::hashText()), so that
// readers leave out damaged lines only:
//   {"hash":"ef46db3751d8e999","line":VALUE}
// Only one process can have it open at a time.
class Journal {
public:
    // The kind of failure that a line survives once append() has returned.
    enum class Lasts { crash, process };

    // Opens the file, or creates it and its folder. Throws engine::Error "<path>: <reason>" if
    // another process has it open or opening fails.
    explicit Journal(std::filesystem::path path, Lasts lasts = Lasts::crash);
    // Removes an empty file.
    ~Journal();
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;

    // Position of a line in the file, B.
    struct Place {
        std::uintmax_t begin = 0;
        std::size_t size = 0;  // without the line break
    };

    // Calls `visit` with the value of each whole line. Throws engine::Error if the first line is
    // not valid, because the file is then not a journal.
    void read(const std::function<void(scene::Json value, const Place& place)>& visit);
    // Numbers, from 1, of the lines that read() left out.
    const std::vector<std::size_t>& damaged() const { return damaged_; }

    // Returns the value of a line from read() or append(). Throws engine::Error if the line has
    // changed.
    scene::Json at(const Place& place) const;

    // Appends after the last whole line. Throws WriteFailed, and then leaves the earlier lines
    // unchanged.
    Place append(const scene::Json& line);

    // Forgets all lines: the next append() writes the first one.
    void clear();

    // Removes the file when it is no longer needed.
    void remove();

private:
    std::filesystem::path path_;
    Lasts lasts_;
    engine::system::File file_;
    std::uintmax_t size_ = 0;  // B of whole lines
    bool ends_there_ = false;  // false: the file may have more bytes after them
    std::vector<std::size_t> damaged_;
};

inline constexpr const char* kJournalSchema = "hairbench-journal/2.0.0";

struct RecordOptions {
    std::filesystem::path out;  // path of the report
    std::string filter;  // of the plan
    bool resume = false;  // continue an existing journal
};

enum class RunEnd { complete, interrupted };

// The finished and remaining cases of a run. They are kept in "<out>.journal" until the report is
// written, so that a run that was killed can continue. The journal's first line identifies the run.
// Each other line is a case as in reports, in order of execution. Lines that are not a case of the
// plan, repeat one or are damaged are left out with a message on stderr; such a case is played
// again. Memory holds only the position of each case's line.
class RunRecord {
public:
    // Throws engine::Error "<journal>: <reason>" if `resume` is set and the journal belongs to
    // another run, or if it is not set and the journal belongs to this run; throws WriteFailed like
    // Journal. Without `resume`, replaces the journal of another run, with a message on stderr. If
    // `out` is not a file (/dev/stdout), the journal is temporary.
    RunRecord(
        const RunPlan& plan, const report::ReportHeader& header, const RecordOptions& options);
    ~RunRecord();
    RunRecord(const RunRecord&) = delete;
    RunRecord& operator=(const RunRecord&) = delete;

    struct Turn {
        std::size_t place = 0;  // index of the case in the plan
        std::size_t order = 0;  // position in the order of execution, from 0
    };
    // The remaining cases, in the order from the run's original seed.
    const std::vector<Turn>& remaining() const { return remaining_; }
    std::size_t done() const { return done_.size(); }
    // Number of finished cases that were measured, neither skipped nor failed.
    std::size_t measured() const { return measured_; }
    // False if `out` is not a file, so that no journal can lie beside it.
    bool hasJournal() const { return !scratch_; }

    // Records the case with its verdict. Throws WriteFailed "<journal>: <reason>; <kept cases>".
    void add(const report::CaseResult& result);

    // The report without its cases.
    const scene::Json& header() const { return *header_; }
    // Calls `visit` with each case, in the sweep's order. Throws engine::Error if the journal was
    // changed from outside.
    void eachCase(const std::function<void(scene::Json)>& visit) const;

    // Writes the report with all cases in the sweep's order, and calls `visit` with each. For a
    // complete run, then removes the journal and forgets the cases. Reads each case once. Throws
    // WriteFailed, and then keeps the journal.
    void write(RunEnd end, const std::function<void(const scene::Json& result)>& visit = {});

private:
    struct Done {
        std::size_t index = 0;  // in the sweep
        Journal::Place line;
    };
    void keep(std::size_t index, const scene::Json& result, const Journal::Place& line);

    std::filesystem::path out_;
    std::unique_ptr<engine::ScratchFolder> scratch_;  // for a temporary journal
    std::unique_ptr<Journal> journal_;
    std::unique_ptr<scene::Json> header_;
    std::vector<Done> done_;
    std::size_t measured_ = 0;
    report::LargeSamples large_samples_ = report::LargeSamples::none;
    std::vector<Turn> remaining_;
};

std::filesystem::path journalFile(const std::filesystem::path& report);

// The finished cases of a sweep whose results are files of their own. They are in a journal until
// all are finished, so that a sweep that was interrupted or killed can continue.
class SweepRecord {
public:
    // `identity` tells sweeps apart that write other files of equal cases. With `resume`, takes the
    // cases of an existing journal; without it, forgets them. Throws engine::Error "<journal>:
    // <reason>" if `resume` is set and the journal belongs to another sweep, and like Journal.
    SweepRecord(std::filesystem::path journal, scene::Json identity, bool resume);
    ~SweepRecord();
    SweepRecord(const SweepRecord&) = delete;
    SweepRecord& operator=(const SweepRecord&) = delete;

    // Returns what add() got for a case with this name and these settings; null: none is finished.
    scene::Json finished(const scene::CaseSpec& spec) const;

    // Throws WriteFailed like Journal.
    void add(const scene::CaseSpec& spec, const scene::Json& written);

    // Ends the sweep: removes the journal.
    void complete();

private:
    std::unique_ptr<Journal> journal_;
    std::unique_ptr<scene::Json> finished_;  // name -> {settings, written}
};

// Returns how many cases of the report at `out` were measured. Returns nothing unless it is
// complete, of the same plan, build and device, and without a journal of a run in progress.
std::optional<std::size_t> measuredInComplete(
    const RunPlan& plan, const report::ReportHeader& header, const std::filesystem::path& out);

}  // namespace benchmarks::run
