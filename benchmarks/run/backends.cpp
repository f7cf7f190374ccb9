#include "benchmarks/run/backends.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

#include <nlohmann/json.hpp>

#include "benchmarks/reference/flip.h"
#include "benchmarks/scene/extensions.h"
#include "benchmarks/scene/settings_json.h"
#include "engine/error.h"
#include "engine/frame_loop.h"
#include "engine/target.h"

namespace benchmarks::run {
namespace {

using hair::Backend;
using report::Measured;

// ---- Pictures -----------------------------------------------------------------------------------

// Back ends that draw the quads of `tessellation`, most similar first. The list includes some that
// every device supports.
constexpr std::array kQuadBackends{
    Backend::tessellation, Backend::pulling_geometry, Backend::pulling, Backend::expanded};

// Number of pictures that are kept for other cases.
constexpr std::size_t kMostReferences = 64;

// Replays the simulation up to the last frame of a round.
void replay(const engine::Device& device, measure::Case& test_case, const hair::RunSettings& run) {
    test_case.reset();
    engine::FrameLoop loop(device, engine::Timing::isolated);
    for (std::uint32_t i = 0; i < run.warmup + run.frames + 1; ++i) {
        engine::checkInterrupted();
        loop.frame([&](engine::Passes& passes) { test_case.simulate(passes); });
    }
    loop.finish();
}

std::vector<std::uint8_t> drawn(
    const engine::Device& device, const measure::Case& test_case, const hair::Settings& settings) {
    hair::rendering::Renderer renderer = test_case.rendererOf(settings);
    engine::FrameLoop loop(device, engine::Timing::isolated);
    loop.frame([&](engine::Passes& passes) { renderer.record(passes, test_case.view()); });
    loop.finish();
    return engine::readOutput(device, renderer.target());
}

// 64 samples per pixel. Alpha to coverage covers a share of a rendered pixel's samples, so it needs
// several of them.
hair::Settings withManySamples(hair::Settings settings) {
    const bool covers = settings.render.transparency == hair::Transparency::alpha_to_coverage;
    settings.render.msaa = covers ? 4 : 1;
    settings.render.ssaa = covers ? 4 : 8;
    return settings;
}

// Gives the hair one display colour in every light and makes it opaque. The rest of the picture
// stays as in the case.
hair::Settings withPlainHair(hair::Settings settings, float brightness) {
    settings.strands.opacity = 1.0f;
    settings.shading = {};
    settings.shading.color = glm::vec3(brightness);
    settings.shading.ambient = 1.0f;
    settings.shading.diffuse = 0.0f;
    settings.shading.specular = 0.0f;
    settings.render.coverage = hair::Coverage::sampled;
    settings.render.transparency = hair::Transparency::none;
    settings.render.tone_map = hair::ToneMap::none;
    settings.render.environment.clear();
    settings.render.show = hair::Show::shading;
    settings.render.overlays = {};
    return settings;
}

// ---- Metrics ------------------------------------------------------------------------------------

// Returns the time of each frame in ms; nothing if the passes were not timed.
std::optional<report::Metric> strandsTime(const report::CaseResult& result) {
    const auto* const strands =
        report::findMetric(result.metrics, report::ofPass("strands", Measured::time));
    if (!strands) return std::nullopt;
    report::Metric sum(report::ofStrands(Measured::time), strands->samples, strands->mode);
    const auto* const points =
        report::findMetric(result.metrics, report::ofPass("points", Measured::time));
    if (!points) return sum;
    if (points->samples.size() != sum.samples.size() || points->mode != sum.mode)
        return std::nullopt;
    std::ranges::transform(sum.samples, points->samples, sum.samples.begin(), std::plus());
    return sum;
}

template <class Change>
void addChanged(
    const report::Metric& time, Measured what, Change change, report::CaseResult& result) {
    std::vector<double> samples = time.samples;
    for (double& sample : samples) sample = change(sample);
    result.metrics.push_back({report::ofStrands(what), std::move(samples), time.mode});
}

void addLimits(const measure::DeviceLimits& limits, report::CaseResult& result) {
    result.metrics.push_back({report::ofDevice(Measured::copy_bandwidth), limits.copy_bandwidth});
    for (const auto& [kind, rates] : limits.arithmetic)
        result.metrics.push_back(
            {report::ofDevice(Measured::arithmetic, measure::stageName(kind)), rates});
}

void addWork(
    const measure::StrandWork& work, const measure::DeviceLimits& limits,
    const std::optional<report::Metric>& time, report::CaseResult& result) {
    result.metrics.push_back({report::ofStrands(Measured::bytes), {work.bytes}});
    for (const auto& [kind, operations] : work.operations)
        result.metrics.push_back(
            {report::ofStrands(Measured::operations, measure::stageName(kind)), {operations}});
    const double least = measure::leastTime(work, limits);
    result.metrics.push_back({report::ofStrands(Measured::limit), {least}});
    if (time)
        addChanged(*time, Measured::limit_share, [&](double ms) { return least / ms; }, result);
}

measure::StrandCounts
countsOf(const measure::Case& test_case, const hair::Settings& settings, const Covered& covered) {
    const hair::rendering::StrandPlan& plan = test_case.plan();
    const hair::groom::Groom& groom = test_case.groom();
    return {
        .guide_vertices = std::uint64_t{groom.strand_count} * groom.vertices_per_strand,
        .root_triangles = plan.triangles,
        .strands = plan.strands(),
        .segments = plan.segments,
        .pieces = plan.forced_tessellation,
        .covered_samples = covered.samples,
        .covered_pixels = covered.pixels,
        .lights = settings.shading.lights.size(),
        .color_bytes = settings.render.tone_map == hair::ToneMap::none ? 4u : 8u};
}

}  // namespace

Covered coveredBy(
    std::span<const std::uint8_t> white, std::span<const std::uint8_t> black,
    std::uint32_t samples) {
    if (white.size() != black.size())
        throw engine::Error("covered samples", "the pictures are of different sizes");
    Covered covered;
    for (std::size_t i = 0; i < white.size(); i += 4) {
        const double share = (int{white[i]} - int{black[i]}) / 255.0;
        const long shown = std::lround(share * samples);
        if (shown <= 0) continue;
        covered.samples += static_cast<std::uint64_t>(shown);
        ++covered.pixels;
    }
    return covered;
}

const BackendComparison::Reference& BackendComparison::reference(
    const engine::Device& device, const measure::Case& test_case, hair::Settings settings,
    std::span<const Backend> ways, const std::string& state) {
    settings.strands.backend = ways.front();
    std::string key = state + scene::writeSettings(settings).dump();
    for (const scene::NamedExtension& each : scene::namedExtensions(settings)) key += each.text;
    const auto found = references_.find(key);
    if (found != references_.end()) return found->second;
    if (references_.size() >= kMostReferences) references_.clear();
    Reference& made = references_[key];
    for (const Backend way : ways) {
        settings.strands.backend = way;
        try {
            made.pixels = drawn(device, test_case, settings);
            return made;
        } catch (const engine::DeviceLost&) {
            references_.erase(key);
            throw;
        } catch (const engine::Error& error) {
            made.missing = error.what();
        }
    }
    return made;
}

void BackendComparison::add(
    const engine::Device& device, measure::Case& test_case, hair::Settings settings,
    std::span<const std::uint8_t> picture, report::CaseResult& result) {
    const auto warn = [&](const std::string& text) {
        result.trust.warnings.push_back("/run/compare_backends: " + text);
    };
    const auto drawn_by = test_case.backend();
    if (!drawn_by) return warn("no hair is drawn");
    settings.strands.backend = drawn_by->backend;
    replay(device, test_case, settings.run);
    const std::string state = test_case.stateHash();
    if (state != result.state_hash)
        return warn("the simulation did not reach the same state again");

    const auto compare = [&](Measured what, const Reference& with) {
        if (with.pixels.empty())
            return warn(std::string(report::ofImage(what).name()) + ": " + with.missing);
        const double error = reference::flipError(
            with.pixels, picture, settings.render.width, settings.render.height);
        result.metrics.push_back({report::ofImage(what), {error}});
    };
    compare(
        Measured::flip_tessellation,
        reference(device, test_case, settings, std::span(kQuadBackends).first(1), state));
    compare(
        Measured::flip_many_samples,
        reference(device, test_case, withManySamples(settings), kQuadBackends, state));

    const std::optional<report::Metric> time = strandsTime(result);
    if (time)
        result.metrics.push_back(*time);
    else
        warn("the passes were not timed");
    if (settings.lod.mode == hair::LodMode::distance)
        return warn("only the device knows how many points are drawn");
    if (!settings.strands.texture.empty())
        return warn("samples in the holes of a texture are not counted");
    const std::uint32_t samples =
        settings.render.msaa * settings.render.ssaa * settings.render.ssaa;
    const Covered covered = coveredBy(
        drawn(device, test_case, withPlainHair(settings, 1.0f)),
        drawn(device, test_case, withPlainHair(settings, 0.0f)), samples);
    const measure::StrandCounts counts = countsOf(test_case, settings, covered);
    result.counts.emplace_back("points", counts.points());
    result.counts.emplace_back("covered_samples", covered.samples);
    result.counts.emplace_back("covered_pixels", covered.pixels);
    const auto addPer = [&](Measured what, std::uint64_t count) {
        if (time && count > 0)
            addChanged(
                *time, what, [&](double ms) { return 1e6 * ms / static_cast<double>(count); },
                result);
    };
    addPer(Measured::time_per_point, counts.points());
    addPer(Measured::time_per_sample, covered.samples);

    if (!limits_) limits_ = measure::measureLimits(device);
    addLimits(*limits_, result);
    if (const auto work = measure::strandWork(settings.strands.backend, counts))
        addWork(*work, *limits_, time, result);
    else
        warn("no model gives the least work of this back end");
}

}  // namespace benchmarks::run
