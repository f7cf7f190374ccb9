#include "benchmarks/ablate/coverage_check.h"

#include <array>
#include <optional>
#include <utility>

namespace benchmarks {

namespace {

constexpr std::array kAlike{
    std::pair{Stop::raster, Stop::fragment},
    std::pair{Stop::raster_msaa, Stop::msaa},
};

}  // namespace

std::vector<std::string> coverageWarnings(std::span<const StopRecord> stops) {
    std::vector<std::string> warnings;
    for (const auto& [without, with] : kAlike) {
        const std::optional<std::uint64_t> null_count =
            measuredCount(stops, without, "samples_passed");
        const std::optional<std::uint64_t> count = measuredCount(stops, with, "samples_passed");
        if (null_count && count && *null_count != *count)
            warnings.push_back(
                std::string(stopName(without)) + ": covers " + std::to_string(*null_count) +
                " samples, " + stopName(with) + " " + std::to_string(*count));
    }
    return warnings;
}

}  // namespace benchmarks
