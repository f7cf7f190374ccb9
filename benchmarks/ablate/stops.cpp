#include "benchmarks/ablate/stops.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>

#include "benchmarks/measure/metrics.h"
#include "benchmarks/report/statistics.h"
#include "hair/rendering/strand_plan.h"

namespace benchmarks::ablate {
namespace {

// ---- Stops of the ladder ------------------------------------------------------------------------

constexpr std::array kNames{
    std::pair{Stop::empty, "empty"},
    std::pair{Stop::vertex, "vertex"},
    std::pair{Stop::tessellation_1, "tessellation_1"},
    std::pair{Stop::tessellation, "tessellation"},
    std::pair{Stop::geometry, "geometry"},
    std::pair{Stop::raster, "raster"},
    std::pair{Stop::fragment, "fragment"},
    std::pair{Stop::msaa, "msaa"},
    std::pair{Stop::pass, "pass"},
    std::pair{Stop::clipped, "clipped"},
    std::pair{Stop::raster_msaa, "raster_msaa"},
    std::pair{Stop::watched_vertex, "watched_vertex"},
    std::pair{Stop::watched_evaluation, "watched_evaluation"},
    std::pair{Stop::watched_geometry, "watched_geometry"},
};

hair::Settings withPieces(hair::Settings settings, std::uint32_t pieces) {
    settings.strands.tessellation = pieces;
    return settings;
}

// Most drawn segments per guide segment.
std::uint32_t drawnPieces(const hair::Settings& settings) {
    if (settings.lod.mode != hair::LodMode::forced) return settings.strands.tessellation;
    return hair::rendering::drawnPieces(
               settings.strands.tessellation, std::exp2(-settings.lod.level))
        .count;
}

// The camera keeps its position, because quads face it and levels of detail depend on it.
hair::Settings clipped(hair::Settings settings) {
    settings.camera.near_plane = 1e6f;  // m
    settings.camera.far_plane = 2e6f;
    return settings;
}

}  // namespace

const char* stopName(Stop stop) {
    const auto found = std::ranges::find(kNames, stop, [](const auto& row) { return row.first; });
    assert(found != kNames.end());
    return found->second;
}

bool isRung(Stop stop) { return stop <= Stop::msaa; }

std::vector<StopPlan> planStops(const hair::Settings& settings, std::uint64_t watch) {
    hair::Settings single = settings;
    single.render.msaa = 1;
    const bool multisampled = settings.render.msaa > 1;
    const auto upTo = [&](hair::rendering::StrandStage last) {
        return hair::rendering::StrandStages{.last = last, .watched = last, .watch = watch};
    };
    const auto watched = [&](hair::rendering::StrandStage stage) {
        return hair::rendering::StrandStages{.watched = stage, .watch = watch};
    };
    const hair::rendering::StrandStages raster{.last = hair::rendering::StrandStage::raster};

    std::vector<StopPlan> stops{
        {Stop::empty, single, {.last = std::nullopt}},
        {Stop::vertex, single, upTo(hair::rendering::StrandStage::vertex)}};
    if (drawnPieces(settings) > 1)
        stops.push_back(
            {Stop::tessellation_1, withPieces(single, 1),
             upTo(hair::rendering::StrandStage::evaluation)});
    stops.push_back({Stop::tessellation, single, upTo(hair::rendering::StrandStage::evaluation)});
    stops.push_back({Stop::geometry, single, upTo(hair::rendering::StrandStage::geometry)});
    stops.push_back({Stop::raster, single, raster});
    stops.push_back({Stop::fragment, single, {}});
    if (multisampled) stops.push_back({Stop::msaa, settings, {}});

    stops.push_back({Stop::pass, settings, {}});
    stops.push_back({Stop::clipped, clipped(single), {}});
    if (multisampled) stops.push_back({Stop::raster_msaa, settings, raster});
    stops.push_back({Stop::watched_vertex, single, watched(hair::rendering::StrandStage::vertex)});
    stops.push_back(
        {Stop::watched_evaluation, single, watched(hair::rendering::StrandStage::evaluation)});
    stops.push_back(
        {Stop::watched_geometry, single, watched(hair::rendering::StrandStage::geometry)});
    return stops;
}

std::string ablationObstacle(const hair::Settings& settings) {
    if (!settings.render.hair) return "/render/hair: no strands are drawn";
    if (settings.strands.backend != hair::Backend::tessellation &&
        settings.strands.backend != hair::Backend::automatic)
        return "/strands/backend: only the stages of tessellation can be measured";
    if (settings.render.transparency != hair::Transparency::none)
        return "/render/transparency: only the stages of opaque strands can be measured";
    return {};
}

// ---- Times --------------------------------------------------------------------------------------

double lapTime(const Lap& lap) {
    return 0.5 * (report::summarize(lap.up).median + report::summarize(lap.down).median);
}

std::vector<double> lapTimes(std::span<const StopTimes> stops, Stop stop) {
    const auto found = std::ranges::find(stops, stop, &StopTimes::stop);
    assert(found != stops.end());
    std::vector<double> times;
    for (const Lap& lap : found->laps) times.push_back(lapTime(lap));
    return times;
}

bool hasStop(std::span<const StopTimes> stops, Stop stop) {
    return std::ranges::find(stops, stop, &StopTimes::stop) != stops.end();
}

namespace {

// ---- Counts -------------------------------------------------------------------------------------

std::uint64_t countOf(const engine::StatisticCounts& counts, std::string_view name) {
    const auto found = std::ranges::find(engine::kStatisticNames, name);
    assert(found != engine::kStatisticNames.end());
    return counts[static_cast<std::size_t>(found - engine::kStatisticNames.begin())];
}

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
        if (measured) lines_.push_back({.name = name, .measured = *measured, .expected = expected});
    }

    std::vector<report::Statistic> take() { return std::move(lines_); }

private:
    const StopCounts& counts_;
    std::vector<report::Statistic> lines_;
};

std::optional<std::uint64_t> expectedInvocations(
    hair::rendering::StrandStage stage, const hair::rendering::ExpectedCounts& expected) {
    switch (stage) {
    case hair::rendering::StrandStage::vertex:
        return expected.tessellation_control_patches;  // a vertex is a patch
    case hair::rendering::StrandStage::evaluation:
        return expected.tessellation_evaluation_invocations;
    default:
        return expected.geometry_invocations;
    }
}

// The statistic with the same count as a watched stage.
std::string_view countOf(hair::rendering::StrandStage stage) {
    switch (stage) {
    case hair::rendering::StrandStage::vertex:
        return "vertex_invocations";
    case hair::rendering::StrandStage::evaluation:
        return "tessellation_evaluation_invocations";
    default:
        return "geometry_invocations";
    }
}

}  // namespace

std::vector<report::Statistic> stopStatistics(
    const StopPlan& stop, const hair::rendering::StrandPlan& plan, const StopCounts& counts,
    bool approximate_fragments) {
    const hair::rendering::ExpectedCounts expected = hair::rendering::expectedCounts(plan);
    const std::optional<hair::rendering::StrandStage> last = stop.stages.last;
    Lines lines(counts);
    if (!last) {
        lines.add("input_assembly_vertices", 0);
        lines.add("samples_passed", counts.samples_passed, 0);
        return lines.take();
    }
    lines.add("vertex_invocations", expected.tessellation_control_patches);
    if (last >= hair::rendering::StrandStage::evaluation) {
        lines.add("tessellation_control_patches", expected.tessellation_control_patches);
        lines.add(
            "tessellation_evaluation_invocations", expected.tessellation_evaluation_invocations);
    }
    if (last >= hair::rendering::StrandStage::geometry) {
        lines.add("geometry_invocations", expected.geometry_invocations);
        lines.add("geometry_primitives", expected.geometry_primitives);
    }
    const bool rasterises =
        last >= hair::rendering::StrandStage::raster && stop.stop != Stop::clipped;
    if (last == hair::rendering::StrandStage::fragment) {
        lines.add(
            "fragment_invocations", rasterises ? std::nullopt : std::optional<std::uint64_t>(0),
            approximate_fragments && rasterises ? "approximate: this driver counts too many" : "");
    }
    lines.add(
        "samples_passed", counts.samples_passed,
        rasterises ? std::nullopt : std::optional<std::uint64_t>(0));
    if (stop.stages.watched)
        lines.add(
            "seen", counts.watched_invocations,
            expectedInvocations(*stop.stages.watched, expected));
    return lines.take();
}

std::vector<std::string> countWarnings(
    const StopPlan& stop, std::span<const report::Statistic> statistics,
    const engine::DeviceInfo& device) {
    const bool rasterises =
        stop.stages.last >= hair::rendering::StrandStage::raster && stop.stop != Stop::clipped;
    std::vector<std::string> warnings;
    for (const report::Statistic& each : statistics) {
        const std::string start = std::string(stopName(stop.stop)) + ": " + each.name + ": " +
                                  std::to_string(each.measured) + ", ";
        const bool is_own = each.name == "seen" && stop.stages.watched;
        const std::string_view counted = is_own ? countOf(*stop.stages.watched) : each.name;
        if (auto missed = measure::missedCount(counted, each.measured, each.expected, device))
            warnings.push_back(start + *missed);
        const bool covered = each.name == "samples_passed" || each.name == "fragment_invocations";
        if (rasterises && covered && each.measured == 0)
            warnings.push_back(start + "expected some");
    }
    return warnings;
}

}  // namespace benchmarks::ablate
