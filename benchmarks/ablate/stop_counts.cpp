#include "benchmarks/ablate/stop_counts.h"

#include <algorithm>
#include <cassert>

namespace benchmarks {

namespace {

using hair::StrandStage;

class Lines {
public:
    explicit Lines(const StopCounts& counts) : counts_(counts) {}

    void add(std::string_view name, std::optional<std::uint64_t> expected, std::string note = {}) {
        if (!counts_.statistics) return;
        lines_.push_back(
            {.name = std::string(name),
             .measured = countOf(*counts_.statistics, name),
             .expected = expected,
             .note = std::move(note)});
    }

    void
    add(const char* name, std::optional<std::uint64_t> measured,
        std::optional<std::uint64_t> expected) {
        if (measured)
            lines_.push_back(
                {.name = name, .measured = *measured, .expected = expected, .note = {}});
    }

    std::vector<Statistic> take() { return std::move(lines_); }

private:
    const StopCounts& counts_;
    std::vector<Statistic> lines_;
};

std::optional<std::uint64_t>
expectedInvocations(StrandStage stage, const hair::ExpectedCounts& expected) {
    switch (stage) {
    case StrandStage::vertex:
        return expected.tessellation_control_patches;  // a vertex is a patch
    case StrandStage::evaluation:
        return expected.tessellation_evaluation_invocations;
    default:
        return expected.geometry_invocations;
    }
}

}  // namespace

std::uint64_t countOf(const engine::StatisticCounts& counts, std::string_view name) {
    const auto found = std::ranges::find(engine::kStatisticNames, name);
    assert(found != engine::kStatisticNames.end());
    return counts[static_cast<std::size_t>(found - engine::kStatisticNames.begin())];
}

std::vector<Statistic> stopStatistics(
    const StopPlan& stop, const hair::StrandPlan& plan, const StopCounts& counts,
    bool approximate_fragments) {
    const hair::ExpectedCounts expected = hair::expectedCounts(plan);
    const std::optional<StrandStage> last = stop.stages.last;
    Lines lines(counts);
    if (!last) {
        lines.add("input_assembly_vertices", 0);
        lines.add("samples_passed", counts.samples_passed, 0);
        return lines.take();
    }
    lines.add("vertex_invocations", expected.tessellation_control_patches);
    if (last >= StrandStage::evaluation) {
        lines.add("tessellation_control_patches", expected.tessellation_control_patches);
        lines.add(
            "tessellation_evaluation_invocations", expected.tessellation_evaluation_invocations);
    }
    if (last >= StrandStage::geometry) {
        lines.add("geometry_invocations", expected.geometry_invocations);
        lines.add("geometry_primitives", expected.geometry_primitives);
    }
    const bool rasterises = last >= StrandStage::raster && stop.stop != Stop::clipped;
    if (last == StrandStage::fragment) {
        lines.add(
            "fragment_invocations", rasterises ? std::nullopt : std::optional<std::uint64_t>(0),
            approximate_fragments && rasterises ? "approximate: this driver counts too many" : "");
    }
    lines.add(
        "samples_passed", counts.samples_passed,
        rasterises ? std::nullopt : std::optional<std::uint64_t>(0));
    if (stop.stages.watched)
        lines.add("seen", counts.seen, expectedInvocations(*stop.stages.watched, expected));
    return lines.take();
}

std::vector<std::string>
countWarnings(const StopPlan& stop, std::span<const Statistic> statistics) {
    const bool rasterises = stop.stages.last >= StrandStage::raster && stop.stop != Stop::clipped;
    std::vector<std::string> warnings;
    for (const Statistic& each : statistics) {
        const std::string start = std::string(stopName(stop.stop)) + ": " + each.name + ": " +
                                  std::to_string(each.measured) + ", expected ";
        if (each.expected && *each.expected != each.measured)
            warnings.push_back(start + std::to_string(*each.expected));
        const bool covered = each.name == "samples_passed" || each.name == "fragment_invocations";
        if (rasterises && covered && each.measured == 0) warnings.push_back(start + "some");
    }
    return warnings;
}

}  // namespace benchmarks
