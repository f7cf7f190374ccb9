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

// Plays a case to the last frame that `run` measures of it and draws its hair, which then stands
// still, `laps` times up and down the ladder. What the device or the case can't do is in the
// result. Throws Interrupted where the user stopped the program; `result` then has the laps that
// were done.
void ablateCase(
    const engine::Device& device, const scene::CaseSpec& spec,
    const std::filesystem::path& directory, std::uint32_t laps,
    const std::function<void(const std::string&)>& progress, measure::HairCache& cache,
    CaseAblation& result);

// Where a stop without a fragment shader does not cover what the same one with it does. Not for
// shaders that discard fragments.
std::vector<std::string> coverageWarnings(std::span<const StopRecord> stops);

// The hair of a case at a frame, and what else its pictures need.
class StillHair {
public:
    // Simulates up to the frame, which is counted from 0, without pictures. Throws as Case does,
    // and Interrupted.
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

// Hair that stands still, drawn as one stop has it.
class StopView {
public:
    // Throws engine::Unsupported for what the device can't do.
    StopView(
        const engine::Device& device, StopPlan stop, const hair::rendering::StrandView& hair,
        const hair::rendering::RenderAssets& assets);

    const StopPlan& stop() const { return stop_; }
    const hair::rendering::StrandPlan& plan() const { return renderer_.plan(); }

    // Throws Interrupted where the user stopped the program.
    void draw(engine::FrameLoop& loop);

    // The strands pass of so many frames, after one that isn't timed, ms.
    std::vector<double> visit(engine::FrameLoop& loop, std::uint32_t frames);

    // Counts in frames of their own. Leaves `watch` seeing next to none.
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
