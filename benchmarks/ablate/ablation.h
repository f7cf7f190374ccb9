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

// Report of an ablation: what each stop of each case measured, and what the stages cost.
namespace benchmarks::ablate {

// A stop as it was measured.
struct StopRecord {
    StopTimes times;
    std::uint32_t tessellation = 0;  // drawn segments per guide segment, at most
    std::uint32_t samples = 1;  // of a rendered pixel
    std::vector<report::Statistic> statistics;  // of the strands pass, in untimed frames
};

// What was found out of one case.
struct CaseAblation {
    std::string name;
    std::vector<scene::AxisValue> axes;
    report::Status status = report::Status::ok;
    std::string reason;  // why it was skipped or failed
    std::uint32_t frame = 0;  // whose hair is drawn, from 0
    std::string timing;  // "isolated", or "wall_clock" where timestamps can't be trusted
    std::vector<StopRecord> stops;  // rungs from the bottom up, then the others
    std::optional<Attribution> attribution;  // absent: interrupted before a lap was done
    std::vector<UnitCost> unit_costs;
    std::vector<std::pair<std::string, std::uint64_t>> counts;
    std::string image_hash;  // of the pass as it always is
    std::vector<std::string> warnings;
};

struct AblationReport {
    report::Environment environment;
    report::SceneRecord scene;
    std::uint32_t laps = 0;  // asked for
    std::vector<CaseAblation> cases;
    bool interrupted = false;  // stopped by the user: cases and laps are those that were done
    std::vector<std::string> notes;  // how to read it
};

// What was counted at a stop; absent if there is no such stop or count.
std::optional<std::uint64_t>
measuredCount(std::span<const StopRecord> stops, Stop stop, std::string_view name);

inline constexpr const char* kAblationSchema = "hairbench-ablation/1.0.0";

// Indented JSON: results/ablation.schema.json describes it. What is not known is absent.
std::string ablationText(const AblationReport& report);

// For a terminal: the rungs with their costs, what they leave open, and the warnings.
std::string ablationTable(const CaseAblation& ablation);

}  // namespace benchmarks::ablate
