#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/ablate/ablation.h"
#include "benchmarks/ablate/stops.h"
#include "benchmarks/measure/case.h"
#include "benchmarks/measure/hair_cache.h"
#include "benchmarks/scene/sweep.h"
#include "engine/device.h"
#include "engine/frame_loop.h"
#include "hair/rendering/backends.h"
#include "hair/rendering/groom_buffers.h"
#include "hair/rendering/render_assets.h"
#include "hair/rendering/renderer.h"

// Measures the strands pass of a case at every stop of the ladder.
namespace benchmarks::ablate {

// Plays a case up to the last frame that `run` measures, freezes its hair and draws it at every
// stop, `laps` times up and down the ladder. If the device or the case lacks something, the result
// says so. Throws Interrupted if the user stopped the program; `result` then has the complete laps.
void ablateCase(
    const engine::Device& device, const scene::CaseSpec& spec,
    const std::filesystem::path& directory, std::uint32_t laps,
    const std::function<void(const std::string&)>& progress, measure::HairCache& cache,
    CaseAblation& result);

// Warns if a stop without a fragment shader covers other samples than the same stop with one. Does
// not apply to shaders that discard fragments.
std::vector<std::string> coverageWarnings(std::span<const StopRecord> stops);

// The hair of a case at one frame, and the other assets of its pictures.
class StillHair {
public:
    // Simulates up to the frame, counted from 0, without pictures. Throws like Case, and
    // Interrupted.
    StillHair(
        const engine::Device& device, const hair::Settings& settings,
        const std::filesystem::path& directory, std::uint32_t frame, measure::HairCache& cache);

    hair::rendering::StrandView view() const { return case_.view(); }
    const hair::rendering::RenderAssets& assets() const { return assets_; }
    std::vector<std::pair<std::string, std::uint64_t>> counts() const { return case_.counts(); }

private:
    measure::Case case_;
    std::optional<hair::groom::Mesh> mesh_;
    hair::rendering::RenderAssets assets_;
};

// Frozen hair, drawn with the settings of one stop.
class StopView {
public:
    // Throws engine::Unsupported if the device lacks a feature.
    StopView(
        const engine::Device& device, StopPlan stop, const hair::rendering::StrandView& hair,
        const hair::rendering::RenderAssets& assets);

    const StopPlan& stop() const { return stop_; }
    const hair::rendering::StrandPlan& plan() const { return renderer_.plan(); }

    // Throws Interrupted if the user stopped the program.
    void draw(engine::FrameLoop& loop);

    // Times of the strands pass in `frames` frames, after one untimed frame, ms.
    std::vector<double> visit(engine::FrameLoop& loop, std::uint32_t frames);

    // Counts in separate frames. Afterwards `watch` sees almost nothing.
    StopCounts count(hair::rendering::StageWatch& watch);

    // The last frame, [row][column] RGBA, top row first. Waits for the device.
    std::vector<std::uint8_t> picture() const;

private:
    std::optional<engine::StatisticCounts> countStatistics();
    std::optional<std::uint64_t> countSamples();

    const engine::Device& device_;
    StopPlan stop_;
    hair::rendering::StrandView hair_;
    hair::rendering::Renderer renderer_;
};

}  // namespace benchmarks::ablate
