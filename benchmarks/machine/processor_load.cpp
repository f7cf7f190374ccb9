#include "benchmarks/machine/processor_load.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <sstream>
#include <string>

#include <unistd.h>

namespace benchmarks {

std::optional<ProcessorTicks> readProcessorTicks(const std::filesystem::path& path) {
    std::ifstream file(path);
    std::string line;
    if (!std::getline(file, line)) return std::nullopt;
    std::istringstream words(line);
    std::string name;
    words >> name;
    if (name != "cpu") return std::nullopt;
    enum { user, nice, system, idle, waiting, interrupts, soft_interrupts, steal, fields };
    std::array<std::uint64_t, fields> ticks{};
    for (std::uint64_t& each : ticks)
        if (!(words >> each)) return std::nullopt;
    // The guests' time that follows is in user and nice already.
    const std::uint64_t busy =
        ticks[user] + ticks[nice] + ticks[system] + ticks[interrupts] + ticks[soft_interrupts];
    return ProcessorTicks{
        .busy = busy,
        .steal = ticks[steal],
        .total = busy + ticks[idle] + ticks[waiting] + ticks[steal]};
}

std::optional<ProcessorLoad>
loadBetween(const ProcessorTicks& before, const ProcessorTicks& after, double own) {
    // Idle time is known to step back by a tick now and then.
    if (after.total <= before.total) return std::nullopt;
    const auto between = [](std::uint64_t from, std::uint64_t to) {
        return to > from ? static_cast<double>(to - from) : 0.0;
    };
    const double total = between(before.total, after.total);
    const double own_ticks = own * 1e-3 * static_cast<double>(sysconf(_SC_CLK_TCK));
    const double others = between(before.busy, after.busy) - own_ticks;
    return ProcessorLoad{
        .steal = std::min(between(before.steal, after.steal) / total, 1.0),
        .others = std::clamp(others / total, 0.0, 1.0)};
}

}  // namespace benchmarks
