#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/json_fwd.h"
#include "benchmarks/report.h"
#include "benchmarks/run/journal.h"
#include "benchmarks/run/run_plan.h"

namespace benchmarks {

inline constexpr const char* kJournalSchema = "hairbench-journal/1.0.0";

struct RecordOptions {
    std::filesystem::path out;  // the report
    std::string filter;  // that the plan was made with
    bool resume = false;  // go on with the journal that is there
};

// What a run has done and has still to do, kept in "<out>.journal" until its report is written, so
// that a run that was killed can go on. Its first line says whose it is; each other is a case as
// reports have it, in the order in which they ran.
class RunRecord {
public:
    // Throws engine::Error "<journal>: <reason>" where the journal is of another run and `resume`
    // is set, or of this one and it is not; WriteFailed as Journal. Without `resume` another run's
    // is replaced, with a line on stderr. Where `out` is no file (/dev/stdout) there is no journal.
    RunRecord(const RunPlan& plan, const ReportHeader& header, const RecordOptions& options);
    ~RunRecord();
    RunRecord(const RunRecord&) = delete;
    RunRecord& operator=(const RunRecord&) = delete;

    struct Turn {
        std::size_t place = 0;  // of the case in the plan
        std::size_t order = 0;  // in which it runs, from 0
    };
    // Those that are left, in the order that the seed of the run's beginning decides.
    const std::vector<Turn>& remaining() const { return remaining_; }
    std::size_t done() const;
    // False where `out` is no file, beside which nothing can be.
    bool hasJournal() const { return journal_ != nullptr; }

    // Throws WriteFailed "<journal>: <reason>; <what is kept>".
    void add(const CaseResult& result);

    // All cases in the sweep's order.
    Json report(bool interrupted) const;

    // Writes the report; the journal is removed unless it was interrupted. Throws WriteFailed, and
    // keeps the journal.
    void write(const Json& report);

private:
    std::filesystem::path out_;
    std::unique_ptr<Journal> journal_;
    std::unique_ptr<Json> header_;
    std::vector<Json> cases_;
    std::vector<Turn> remaining_;
};

std::filesystem::path journalFile(const std::filesystem::path& report);

// The report at `out` if it is complete and of the same plan on the same build and device, and no
// journal says that a run is under way.
std::unique_ptr<Json>
completeReport(const RunPlan& plan, const ReportHeader& header, const std::filesystem::path& out);

}  // namespace benchmarks
