#include "benchmarks/ablate/ladder.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>

#include "hair/rendering/strand_plan.h"

namespace benchmarks {

namespace {

using hair::StrandStage;
using hair::StrandStages;

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

// Of a guide segment, most of them.
std::uint32_t drawnPieces(const hair::Settings& settings) {
    if (settings.lod.mode == hair::LodMode::distance) return settings.strands.tessellation;
    return hair::drawnPieces(settings.strands.tessellation, std::exp2(-settings.lod.level)).count;
}

// Where the camera is stays: quads face it and levels of detail go by it.
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
    const auto upTo = [&](StrandStage last) {
        return StrandStages{.last = last, .watched = last, .watch = watch};
    };
    const auto watched = [&](StrandStage stage) {
        return StrandStages{.watched = stage, .watch = watch};
    };
    const StrandStages raster{.last = StrandStage::raster};

    std::vector<StopPlan> stops{
        {Stop::empty, single, {.last = std::nullopt}},
        {Stop::vertex, single, upTo(StrandStage::vertex)}};
    if (drawnPieces(settings) > 1)
        stops.push_back(
            {Stop::tessellation_1, withPieces(single, 1), upTo(StrandStage::evaluation)});
    stops.push_back({Stop::tessellation, single, upTo(StrandStage::evaluation)});
    stops.push_back({Stop::geometry, single, upTo(StrandStage::geometry)});
    stops.push_back({Stop::raster, single, raster});
    stops.push_back({Stop::fragment, single, {}});
    if (multisampled) stops.push_back({Stop::msaa, settings, {}});

    stops.push_back({Stop::pass, settings, {}});
    stops.push_back({Stop::clipped, clipped(single), {}});
    if (multisampled) stops.push_back({Stop::raster_msaa, settings, raster});
    stops.push_back({Stop::watched_vertex, single, watched(StrandStage::vertex)});
    stops.push_back({Stop::watched_evaluation, single, watched(StrandStage::evaluation)});
    stops.push_back({Stop::watched_geometry, single, watched(StrandStage::geometry)});
    return stops;
}

std::string ablationObstacle(const hair::Settings& settings) {
    if (!settings.render.hair) return "/render/hair: no strands are drawn";
    if (settings.strands.backend != hair::Backend::tessellation)
        return "/strands/backend: only tessellation's stages can be taken apart";
    if (settings.render.transparency != hair::Transparency::none)
        return "/render/transparency: only opaque strands' stages can be taken apart";
    return {};
}

}  // namespace benchmarks
