#include "benchmarks/ablate/ablation.h"

#include <algorithm>

namespace benchmarks {

std::optional<std::uint64_t>
measuredCount(std::span<const StopRecord> stops, Stop stop, std::string_view name) {
    for (const StopRecord& record : stops) {
        if (record.times.stop != stop) continue;
        const auto found = std::ranges::find(record.statistics, name, &Statistic::name);
        if (found != record.statistics.end()) return found->measured;
    }
    return std::nullopt;
}

}  // namespace benchmarks
