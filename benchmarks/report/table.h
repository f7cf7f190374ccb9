#pragma once

#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/report/metric.h"
#include "benchmarks/report/report.h"
#include "benchmarks/report/statistics.h"
#include "benchmarks/report/text.h"
#include "benchmarks/scene/json.h"

// Compares the strand back ends in one report: how their cost grows with the number of strands, and
// how it compares with the cost of `tessellation`.

namespace benchmarks::report {

inline constexpr const char* kBackendAxis = "/strands/backend";

// Time in ms of the passes points and strands: the metric strands.time. Where the report lacks it,
// the sum of the two passes' medians, which has no interval.
struct BackendTime {
    double median;
    std::optional<double> lower;  // bounds of the median's interval
    std::optional<double> upper;
    double confidence = 0.0;
};

struct BackendPoint {
    std::string name;  // of the case
    double strands;  // number of strands drawn
    BackendTime time;
};

// The measured cases of one back end that differ only in the number of strands, which the axes in
// /groom, /strands/density and /lod set.
struct BackendLine {
    std::string backend;
    std::vector<std::pair<std::string, scene::Document>> held;  // the other axes and their values
    std::vector<BackendPoint> points;  // sorted by strands
    // Time over strand count, with an interval at level 0.05. Needs at least two counts.
    std::optional<PowerLaw> law;
};

// A case's time over the time of the same case with the back end `tessellation`.
struct BackendRatio {
    std::string name;  // of the case
    double ratio;
    // From the intervals of both medians. Its confidence is the sum of theirs less 1 (Bonferroni).
    std::optional<double> lower;
    std::optional<double> upper;
    double confidence = 0.0;
};

struct BackendFigures {
    std::vector<BackendLine> lines;  // in the report's order
    std::vector<BackendRatio> ratios;
};

// Returns nothing for a report with fewer than two back ends. nlohmann throws if it is not a
// report.
std::optional<BackendFigures> compareBackends(const scene::Json& report);

scene::Json backendsJson(const BackendFigures& figures);

// A report as a table for a terminal.

// Returns a table of a report (reportJson): a line on the device and the scene, one on what the
// columns are, then a row per case with the axes that vary, FPS, the median times of the frame, its
// interval, the median times of every pass, strands, verdict and status. Unknown values are "-".
std::string table(const scene::Json& report);

// Builds the same table from a report's header (headerJson) and cases that are added one by one and
// not kept.
class CaseTable {
public:
    // `header` must outlive this.
    explicit CaseTable(const scene::Json& header);

    void add(const scene::Json& result);
    std::string text() const;

private:
    struct AxisColumn {
        Column column;
        std::string pointer;
        std::set<std::string> values;  // different ones
    };
    struct PassColumn {
        Column column;
        MetricId time;
    };
    void put(Column& column, std::string cell) const;
    std::vector<Column> columns() const;

    const scene::Json& header_;
    std::size_t rows_ = 0;
    // All that may be shown. A column that a case does not have ends early or has empty cells.
    std::vector<AxisColumn> axes_;
    std::vector<PassColumn> passes_;
    Column names_{.title = "case", .numeric = false};
    Column backends_{.title = "drawn by", .numeric = false};
    Column rates_{.title = "fps"};
    Column frames_{.title = "frame ms"};
    Column widths_{.title = "+-"};
    Column flips_{.title = "FLIP"};
    Column strands_{.title = "strands"};
    Column verdicts_{.title = "trust", .numeric = false};
    Column statuses_{.title = "status", .numeric = false};
    bool drawn_by_another_ = false;  // some case, which its axes do not show
    bool has_flip_ = false;
};

}  // namespace benchmarks::report
