#include "benchmarks/run/backends.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <limits>
#include <utility>

#include <nlohmann/json.hpp>

#include "benchmarks/measure/gpu_structs.h"
#include "benchmarks/reference/picture_errors.h"
#include "benchmarks/report/statistics.h"
#include "benchmarks/scene/extensions.h"
#include "benchmarks/scene/settings_json.h"
#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "engine/error.h"
#include "engine/frame_loop.h"
#include "engine/pipeline.h"
#include "engine/target.h"

namespace benchmarks::measure {

const char* stageName(StageKind kind) {
    switch (kind) {
    case StageKind::compute:
        return "compute";
    case StageKind::vertex:
        return "vertex";
    case StageKind::fragment:
        return "fragment";
    }
    return "";
}

namespace {

// ---- The strands' work --------------------------------------------------------------------------

// Floating-point operations, counted in shaders/strands/ and shaders/shading/: a product, sum,
// comparison, quotient, root or power is one. Integer operations, offsets, levels of detail,
// shadows and textures are omitted, so these are lower bounds.
constexpr double kMix = 81.0;  // root weights, root lift and four control points of three guides
constexpr double kPoint = 84.0;  // a spline's weights and slopes, position, tangent and width
constexpr double kEnd = 22.0;  // the direction across, at an end of a piece
constexpr double kCorner = 34.0;  // a corner, and its projection
constexpr double kScreenEnd = 100.0;  // an end on the screen: both sides and their projections
constexpr double kPiece = 60.0;  // edges and depth of a piece's quad
constexpr double kSample = 8.0;  // a sample's position and depth
constexpr double kSeenPoint = 60.0;  // the point of a piece that a sample shows
constexpr double kFragment = 75.0;  // normal and direction to the eye
constexpr double kLight = 60.0;  // Phong's terms of a light; other models need more

// Bytes of memory.
constexpr double kGuideBytes = 16.0;  // a guide's vertex
constexpr double kTriangleBytes = 12.0;  // three guides
constexpr double kPointBytes = 16.0;
constexpr double kNumberBytes = 4.0;  // of a strand's pieces, or of a strand in a list
constexpr double kDepthBytes = 4.0;
constexpr double kPairBytes = 8.0;  // a sample of the back end software

double asDouble(std::uint64_t count) { return static_cast<double>(count); }

double shading(const StrandCounts& counts) { return kFragment + kLight * asDouble(counts.lights); }

// For back ends that draw triangles or lines: each covered sample is tested and written once, and
// each covered pixel is shaded once.
StrandWork rasterised(const StrandCounts& counts, double vertex_operations) {
    StrandWork work;
    work.bytes =
        kGuideBytes * asDouble(counts.guide_vertices) +
        kTriangleBytes * asDouble(counts.root_triangles) +
        (asDouble(counts.color_bytes) + 2.0 * kDepthBytes) * asDouble(counts.covered_samples);
    work.operations[StageKind::vertex] = vertex_operations;
    work.operations[StageKind::fragment] = asDouble(counts.covered_pixels) * shading(counts);
    return work;
}

// Number of drawn pieces, and of their points if each segment has its own.
double piecesOf(const StrandCounts& counts) {
    return asDouble(counts.strands * counts.segments * counts.pieces);
}
double segmentPoints(const StrandCounts& counts) {
    return asDouble(counts.strands * counts.segments * (counts.pieces + 1));
}

StrandWork tessellationWork(const StrandCounts& counts) {
    return rasterised(
        counts,
        segmentPoints(counts) * (kMix + kPoint) + 2.0 * piecesOf(counts) * (kEnd + 2.0 * kCorner));
}

StrandWork pullingGeometryWork(const StrandCounts& counts) {
    return rasterised(counts, 2.0 * piecesOf(counts) * (kMix + kPoint + kEnd + 2.0 * kCorner));
}

StrandWork linesWork(const StrandCounts& counts) {
    return rasterised(counts, 2.0 * piecesOf(counts) * (kMix + kPoint + kCorner));
}

StrandWork pullingWork(const StrandCounts& counts) {
    return rasterised(counts, 2.0 * segmentPoints(counts) * (kMix + kPoint + kEnd + kCorner));
}

// The pass `points`: control points are computed once per segment of a strand.
double evaluation(const StrandCounts& counts) {
    return asDouble(counts.strands * counts.segments) * kMix +
           asDouble(counts.points()) * (kPoint + kScreenEnd);
}

StrandWork expandedWork(const StrandCounts& counts) {
    StrandWork work = rasterised(counts, 2.0 * asDouble(counts.points()) * (kEnd + kCorner));
    work.operations[StageKind::compute] = evaluation(counts);
    // Points are written and read once, pieces written once and read twice, and the list written
    // and read.
    work.bytes += 2.0 * kPointBytes * asDouble(counts.points()) +
                  5.0 * kNumberBytes * asDouble(counts.strands);
    return work;
}

// Stages before the rasteriser count as compute.
StrandWork meshWork(const StrandCounts& counts) {
    StrandWork work = rasterised(counts, 0.0);
    work.operations[StageKind::compute] =
        asDouble(counts.strands * counts.segments) * kMix +
        asDouble(counts.points()) * (kPoint + kEnd + 2.0 * kCorner);
    return work;
}

StrandWork softwareWork(const StrandCounts& counts) {
    const double samples = asDouble(counts.covered_samples);
    const double points = asDouble(counts.points());
    StrandWork work;
    work.operations[StageKind::compute] =
        evaluation(counts) + points * kScreenEnd + piecesOf(counts) * kPiece + samples * kSample +
        samples * (2.0 * kScreenEnd + kSeenPoint + shading(counts));
    // Samples are cleared with the scene's depth, covered, shaded and shown.
    work.bytes =
        kGuideBytes * asDouble(counts.guide_vertices) +
        kTriangleBytes * asDouble(counts.root_triangles) + 2.0 * kPointBytes * points +
        2.0 * kNumberBytes * asDouble(counts.strands) +
        samples * (kDepthBytes + 6.0 * kPairBytes + asDouble(counts.color_bytes) + kDepthBytes);
    return work;
}

// Besides the samples' work, the corners of quads are written and read. The driver's work of
// building the acceleration structure and tracing rays is not known. A box has 8 bytes more.
StrandWork raysWork(const StrandCounts& counts) {
    const double samples = asDouble(counts.covered_samples);
    const double points = asDouble(counts.points());
    StrandWork work;
    work.operations[StageKind::compute] =
        evaluation(counts) + points * kEnd +
        samples * (2.0 * kScreenEnd + kSeenPoint + shading(counts));
    constexpr double kCornerBytes = 24.0;  // of a point, for the two quads beside it
    work.bytes =
        kGuideBytes * asDouble(counts.guide_vertices) +
        kTriangleBytes * asDouble(counts.root_triangles) +
        2.0 * (kPointBytes + kCornerBytes) * points +
        2.0 * kNumberBytes * asDouble(counts.strands) +
        samples * (kDepthBytes + 6.0 * kPairBytes + asDouble(counts.color_bytes) + kDepthBytes);
    return work;
}

struct WorkRow {
    hair::Backend backend;
    StrandWork (*work)(const StrandCounts&);
};

constexpr std::array kWorks{
    WorkRow{hair::Backend::tessellation, tessellationWork},
    WorkRow{hair::Backend::pulling_geometry, pullingGeometryWork},
    WorkRow{hair::Backend::lines, linesWork},
    WorkRow{hair::Backend::pulling, pullingWork},
    WorkRow{hair::Backend::expanded, expandedWork},
    WorkRow{hair::Backend::mesh, meshWork},
    WorkRow{hair::Backend::software, softwareWork},
    WorkRow{hair::Backend::rays, raysWork},
};

}  // namespace

std::optional<StrandWork> strandWork(hair::Backend backend, const StrandCounts& counts) {
    const auto row = std::ranges::find(kWorks, backend, &WorkRow::backend);
    if (row == kWorks.end()) return std::nullopt;
    StrandWork work = row->work(counts);
    std::erase_if(work.operations, [](const auto& each) { return each.second == 0.0; });
    return work;
}

namespace {

// ---- The device's limits ------------------------------------------------------------------------

using engine::Access;

constexpr double kLongEnough = 20.0;  // ms, of a measurement
constexpr double kMostAmount = 1 << 20;
constexpr int kMeasurements = 5;
constexpr std::uint32_t kRounds = 256;  // of an invocation
constexpr double kInvocationOperations = double{kRounds} * gpu::kRoundOperations;
constexpr std::size_t kCopied = std::size_t{128} << 20;  // B: exceeds the caches
constexpr std::uint32_t kSide = 512;  // px, of the rendered picture
constexpr std::uint32_t kInvocations = 1 << 14;  // in parallel, in compute and in the vertex stage

// Records work the given number of times.
using LimitLoad = std::function<void(engine::Commands&, std::uint32_t times)>;

// Device time of a load, ms; by the host's clock if there are no timestamps.
double loadTime(
    const engine::Device& device, engine::PassKind kind, const LimitLoad& load,
    std::uint32_t times) {
    engine::FrameLoop loop(device, engine::Timing::isolated);
    loop.frame([&](engine::Passes& passes) {
        passes.pass("limit", kind, [&](engine::Commands& commands) { load(commands, times); });
    });
    const engine::FrameRecord frame = loop.finish().front();
    return frame.passes.empty() ? frame.wall : frame.passes.front().milliseconds;
}

// Rates in giga-units per second of a load with `units` per repetition. The search for a long
// enough load also raises the device's clock.
std::vector<double>
ratesOf(const engine::Device& device, engine::PassKind kind, double units, const LimitLoad& load) {
    std::uint32_t times = 1;
    while (loadTime(device, kind, load, times) < kLongEnough && times < kMostAmount) times *= 2;
    std::vector<double> rates;
    for (int i = 0; i < kMeasurements; ++i) {
        const double milliseconds = loadTime(device, kind, load, times);
        if (milliseconds > 0.0) rates.push_back(units * times / milliseconds * 1e-6);
    }
    return rates;
}

gpu::LimitPush limitPush(std::uint64_t results) {
    return {
        .results = results,
        .rounds = kRounds,
        .factor = 0.999f,
        .addend = 0.01f,
        .never = std::numeric_limits<float>::quiet_NaN()};
}

std::vector<double> copyBandwidth(const engine::Device& device) {
    const engine::Buffer from(
        device, {.size = kCopied, .name = "limits' source", .purpose = "measuring"});
    const engine::Buffer to(
        device, {.size = kCopied, .name = "limits' copy", .purpose = "measuring"});
    // Unwritten pages may share the same physical page.
    loadTime(
        device, engine::PassKind::compute,
        [&](engine::Commands& commands, std::uint32_t) {
            commands.fill(from, 1);
            commands.fill(to, 2);
        },
        1);
    return ratesOf(
        device, engine::PassKind::compute, 2.0 * kCopied,
        [&](engine::Commands& commands, std::uint32_t times) {
            for (std::uint32_t i = 0; i < times; ++i) commands.copy(from, to, kCopied);
        });
}

std::vector<double> computeArithmetic(const engine::Device& device) {
    const engine::ComputePipeline pipeline(
        device, {.shader = "limits/arithmetic.comp", .push_size = sizeof(gpu::LimitPush)});
    const engine::Buffer results(
        device, {.size = sizeof(float), .name = "limits' results", .purpose = "measuring"});
    return ratesOf(
        device, engine::PassKind::compute, kInvocations * kInvocationOperations,
        [&](engine::Commands& commands, std::uint32_t times) {
            commands.bind(pipeline, limitPush(commands.writes(results)));
            commands.dispatchGroups(times * (kInvocations / gpu::kLimitGroup));
        });
}

std::vector<double> graphicsArithmetic(const engine::Device& device, StageKind kind) {
    const bool is_vertex = kind == StageKind::vertex;
    constexpr VkFormat kFormat = VK_FORMAT_R8G8B8A8_UNORM;
    const engine::Image picture(
        device, {.format = kFormat,
                 .width = kSide,
                 .height = kSide,
                 .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,
                 .name = "limits' picture",
                 .purpose = "measuring"});
    engine::GraphicsDescription description{
        .push_size = sizeof(gpu::LimitPush), .colors = {{.format = kFormat}}};
    description.shaders = {
        is_vertex ? "limits/arithmetic.vert" : "composite/screen.vert", "limits/arithmetic.frag"};
    if (is_vertex) description.topology = VK_PRIMITIVE_TOPOLOGY_POINT_LIST;
    const engine::GraphicsPipeline pipeline(device, description);
    const engine::Draw draw{.vertices = is_vertex ? kInvocations : 3};
    const double invocations = is_vertex ? kInvocations : double{kSide} * kSide;
    return ratesOf(
        device, engine::PassKind::graphics, invocations * kInvocationOperations,
        [&](engine::Commands& commands, std::uint32_t times) {
            commands.transition(
                picture, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
            const engine::Attachment color{.image = &picture, .load = engine::Load::clear};
            engine::beginRendering(commands, std::span(&color, 1), std::nullopt);
            commands.bind(pipeline, limitPush(0));
            for (std::uint32_t i = 0; i < times; ++i) commands.draw(draw);
            engine::endRendering(commands);
        });
}

}  // namespace

DeviceLimits measureLimits(const engine::Device& device) {
    DeviceLimits limits;
    limits.copy_bandwidth = copyBandwidth(device);
    limits.arithmetic[StageKind::compute] = computeArithmetic(device);
    for (const StageKind kind : {StageKind::vertex, StageKind::fragment})
        limits.arithmetic[kind] = graphicsArithmetic(device, kind);
    return limits;
}

double leastTime(const StrandWork& work, const DeviceLimits& limits) {
    const auto milliseconds = [](double units, const std::vector<double>& rates) {
        return units / report::summarize(rates).median * 1e-6;
    };
    double least = milliseconds(work.bytes, limits.copy_bandwidth);
    for (const auto& [kind, operations] : work.operations)
        least = std::max(least, milliseconds(operations, limits.arithmetic.at(kind)));
    return least;
}

}  // namespace benchmarks::measure

// ---- Comparison of back ends --------------------------------------------------------------------

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
    loop.frame([&](engine::Passes& passes) { renderer.record(passes, test_case.views()); });
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
    for (const char* pass : report::kBeforeStrands) {
        const auto* const other =
            report::findMetric(result.metrics, report::ofPass(pass, Measured::time));
        if (!other) continue;
        if (other->samples.size() != sum.samples.size() || other->mode != sum.mode)
            return std::nullopt;
        std::ranges::transform(sum.samples, other->samples, sum.samples.begin(), std::plus());
    }
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
    const std::uint32_t heads = settings.copies.count;
    const std::uint64_t vertices = std::uint64_t{groom.strand_count} * groom.vertices_per_strand;
    return {
        .guide_vertices = motions(settings.copies) * vertices,
        .root_triangles = std::uint64_t{heads} * plan.triangles,
        .strands = heads * plan.strands(),
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
    if (settings.lod.mode != hair::LodMode::forced)
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
