#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "benchmarks/ablate/stops.h"
#include "benchmarks/report/report.h"

// Derives costs from times; docs/measuring.md defines the costs.

namespace benchmarks::ablate {

// A difference of times, ms: the Hodges-Lehmann estimate over the laps' differences and its exact
// signed-rank interval.
struct Cost {
    double estimate = 0.0;
    struct Interval {
        double lower;
        double upper;
        double confidence;  // achieved level, at least 95 %
    };
    std::optional<Interval> interval;  // absent: fewer than 6 laps
};
Cost costOf(std::span<const double> differences);

struct RungCost {
    Stop stop = Stop::empty;
    double time = 0.0;  // ms, median of the laps
    Cost marginal;  // less the rung below; the lowest rung has its whole time
    double share = 0.0;  // of the whole pass
};

// Differences that the marginal costs do not explain. All are sums of times of the same lap.
struct Residual {
    Cost closure;  // the renderer's own pass less all marginal costs
    Cost discard;  // clipped less geometry: two ways to stop before the rasteriser
    std::optional<Cost> multisampling;  // the samples' cost with a fragment shader, less that
                                        // without
    Cost interaction;  // the sum of these: the pass less the costs measured in another order
};

struct Attribution {
    std::vector<RungCost> rungs;  // from the bottom up
    double pass_time = 0.0;  // ms, median of the renderer's own pass
    double clipped_time = 0.0;
    Residual residual;
    std::vector<std::pair<Stop, Cost>> watching;  // cost of watching a stage
};

// `stops` are those of planStops(), each with the same number of laps, at least one.
Attribution attribute(std::span<const StopTimes> stops);

// Warnings that an attribution cannot be trusted.
std::vector<std::string> attributionWarnings(const Attribution& attribution);

// Counts of work in one picture. Unknown counts are absent.
struct WorkCounts {
    std::optional<std::uint64_t> patches;
    std::optional<std::uint64_t> strands;
    std::optional<std::uint64_t> segments;  // drawn
    std::optional<std::uint64_t> evaluations_1;  // with one drawn segment per guide segment
    std::optional<std::uint64_t> evaluations;
    std::optional<std::uint64_t> fragments;  // with one sample
    std::optional<std::uint64_t> samples;  // with the case's sample count, if above 1
    std::string fragments_note;  // empty: exact
};

// A rung's marginal cost per item of work: per item that it adds to the rung below, or per item
// over which it is spread.
struct UnitCost {
    Stop rung = Stop::empty;
    std::string unit;  // "strand", "segment", "patch", "evaluation", "fragment", "sample"
    std::uint64_t count = 0;
    double nanoseconds = 0.0;
    std::string note;  // empty: the count is exact
};

// Per strand and segment for all except the empty rung, and per item of the stage's own kind.
std::vector<UnitCost> unitCosts(const std::vector<RungCost>& rungs, const WorkCounts& work);

// Report of an ablation: the measurements at each stop of each case, and the costs of the stages.

// A measured stop.
struct StopRecord {
    StopTimes times;
    std::uint32_t tessellation = 0;  // most drawn segments per guide segment
    std::uint32_t samples = 1;  // per rendered pixel
    std::vector<report::Statistic> statistics;  // counts in the strands pass, in untimed frames
};

// The results of one case.
struct CaseAblation {
    std::string name;
    std::vector<scene::AxisValue> axes;
    report::Status status = report::Status::ok;
    std::string reason;  // why it was skipped or failed
    std::uint32_t frame = 0;  // index of the drawn frame, from 0
    std::string timing;  // "isolated", or "wall_clock" if timestamps can't be trusted
    std::vector<StopRecord> stops;  // rungs from the bottom up, then the others
    std::optional<Attribution> attribution;  // absent: interrupted before the first lap was
                                             // complete
    std::vector<UnitCost> unit_costs;
    std::vector<std::pair<std::string, std::uint64_t>> counts;
    std::string image_hash;  // of the picture that the unmodified pass draws
    std::vector<std::string> warnings;
};

struct AblationReport {
    report::Environment environment;
    report::SceneRecord scene;
    std::uint32_t laps = 0;  // requested
    std::vector<CaseAblation> cases;
    bool interrupted = false;  // stopped by the user: `cases` and laps hold what was complete
    std::vector<std::string> notes;  // explanations for readers
};

// A count measured at a stop; absent if there is no such stop or count.
std::optional<std::uint64_t>
measuredCount(std::span<const StopRecord> stops, Stop stop, std::string_view name);

inline constexpr const char* kAblationSchema = "hairbench-ablation/1.0.0";

// Indented JSON, described by results/ablation.schema.json. Unknown values are absent.
std::string ablationText(const AblationReport& report);

// Text for a terminal: the rungs with their costs, the residuals, and the warnings.
std::string ablationTable(const CaseAblation& ablation);

}  // namespace benchmarks::ablate
