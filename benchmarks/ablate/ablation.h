#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "benchmarks/ablate/attribution.h"
#include "benchmarks/report/report.h"

// Report of an ablation: the measurements at each stop of each case, and the costs of the stages.
namespace benchmarks::ablate {

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
