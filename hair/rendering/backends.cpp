#include "hair/rendering/backends.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>

#include "engine/error.h"
#include "hair/gpu_structs.h"
#include "hair/rendering/software_backend.h"
#include "hair/rendering/strand_offsets.h"
#include "hair/shader_codes.h"

namespace hair::rendering {
namespace {

constexpr std::uint32_t pushSize(const StrandStages& stages) {
    return stages.watched ? std::uint32_t{sizeof(gpu::WatchedPush)}
                          : std::uint32_t{sizeof(gpu::StrandPush)};
}

// The pipeline state that all line back ends share; without shaders.
engine::GraphicsDescription strandPipeline(const BackendContext& context) {
    const StrandOutput& output = context.output;
    const StrandStages& stages = context.stages;
    std::vector<engine::ColorTarget> colors = output.colors;
    if (stages.last != StrandStage::fragment)
        for (engine::ColorTarget& color : colors) color.blend = engine::Blend::keep;
    engine::Constants constants = strandConstants(context.strands, context.plan);
    constants.emplace_back(gpu::kPixelSamplesConstant, output.samples);
    constants.insert(constants.end(), output.shading.begin(), output.shading.end());
    return {
        .constants = constants,
        .push_size = pushSize(stages),
        .colors = colors,
        .depth_format = output.depth_format,
        .samples = output.samples,
        .depth_write = output.depth_write,
        .discard = discards(stages),
        .sampled_images = output.sampled_images};
}

// The geometry stage that makes the quads.
std::string geometryShader(QuadKind quads) {
    return quads == QuadKind::camera ? "strands/strand.geom" : "shadows/hair.geom";
}

// Says that what is drawn next evaluates the picture's strands (Commands::uses).
void declareStrands(engine::Commands& commands, const gpu::PictureParameters& picture) {
    using engine::Access;
    commands.uses(
        {{picture.guides, Access::vertex_read},
         {picture.contacts, Access::vertex_read},
         {picture.guide_normals, Access::vertex_read}});
}

// No strand at all.
class EmptyBackend : public StrandBackend {
public:
    void draw(engine::Commands&, const StrandPicture&) const override {}

    std::optional<ExpectedCounts> expected() const override { return std::nullopt; }
};

// Strand points evaluated in the vertex stage of a line list, then the same geometry and fragment
// stages as tessellation.
class PullingGeometryBackend : public StrandBackend {
public:
    explicit PullingGeometryBackend(const BackendContext& context)
        : vertices_(vertexCount(context.plan)), pipeline_(context.device, describe(context)) {}

    void draw(engine::Commands& commands, const StrandPicture& picture) const override {
        declareStrands(commands, picture.parameters);
        commands.bind(pipeline_, gpu::StrandPush{.picture = picture.address});
        commands.images(pipeline_, picture.images);
        commands.draw({.vertices = vertices_});
    }

    std::optional<ExpectedCounts> expected() const override { return std::nullopt; }

private:
    static std::uint32_t vertexCount(const StrandPlan& plan) {
        const std::uint64_t count =
            std::uint64_t{2} * plan.patches() * plan.strands_per_patch * plan.forced_tessellation;
        if (count > std::numeric_limits<std::uint32_t>::max()) {
            throw engine::Unsupported(
                "pulling_geometry", std::to_string(count) + " vertices do not fit one draw");
        }
        return static_cast<std::uint32_t>(count);
    }

    static engine::GraphicsDescription describe(const BackendContext& context) {
        context.device.require(engine::Feature::geometry, "/strands/backend: pulling_geometry");
        engine::GraphicsDescription description = strandPipeline(context);
        description.shaders = {
            "strands/pulling.vert", geometryShader(context.output.quads), context.output.fragment};
        description.topology = VK_PRIMITIVE_TOPOLOGY_LINE_LIST;
        return description;
    }

    std::uint32_t vertices_;
    engine::GraphicsPipeline pipeline_;
};

// The shaders of the stages up to the last one. Throws engine::Unsupported for stages that the
// device hasn't.
std::vector<std::string> stageShaders(const BackendContext& context) {
    const StrandStages& stages = context.stages;
    const auto path = [&](StrandStage stage, const std::string& file) {
        return (stages.watched == stage ? "strands/watched/" : "strands/") + file;
    };
    std::vector<std::string> shaders{path(StrandStage::vertex, "tessellation.vert")};
    if (stages.last >= StrandStage::evaluation) {
        context.device.require(engine::Feature::tessellation, "/strands/backend: tessellation");
        shaders.emplace_back("strands/tessellation.tesc");
        shaders.push_back(path(StrandStage::evaluation, "tessellation.tese"));
    }
    if (stages.last >= StrandStage::geometry) {
        context.device.require(engine::Feature::geometry, "/strands/backend: tessellation");
        shaders.push_back(
            stages.watched == StrandStage::geometry ? "strands/watched/strand.geom"
                                                    : geometryShader(context.output.quads));
    }
    if (stages.last >= StrandStage::fragment) shaders.push_back(context.output.fragment);
    return shaders;
}

// Vertex -> control -> isolines -> evaluation -> geometry (camera-facing quads) -> fragment:
// thesis 2.2, 2.3.5.
class TessellationBackend : public StrandBackend {
public:
    explicit TessellationBackend(const BackendContext& context)
        : plan_(context.plan), watch_(context.stages.watched ? context.stages.watch : 0),
          draws_(planDraws(
              context.plan, context.strands.submission, context.device.maxTessellatedVertices())),
          pipeline_(context.device, describe(context)) {
        assert(watch_ != 0 || !context.stages.watched);
    }

    void draw(engine::Commands& commands, const StrandPicture& picture) const override {
        declareStrands(commands, picture.parameters);
        if (watch_ != 0)
            commands.bind(pipeline_, gpu::WatchedPush{.picture = picture.address, .watch = watch_});
        else
            commands.bind(pipeline_, gpu::StrandPush{.picture = picture.address});
        commands.images(pipeline_, picture.images);
        for (const engine::Draw& draw : draws_) commands.draw(draw);
    }

    std::optional<ExpectedCounts> expected() const override { return expectedCounts(plan_); }

private:
    static engine::GraphicsDescription describe(const BackendContext& context) {
        engine::GraphicsDescription description = strandPipeline(context);
        description.shaders = stageShaders(context);
        if (context.stages.last == StrandStage::vertex) {
            description.topology = VK_PRIMITIVE_TOPOLOGY_POINT_LIST;
        } else {
            description.topology = VK_PRIMITIVE_TOPOLOGY_PATCH_LIST;
            description.patch_control_points = 1;
        }
        return description;
    }

    StrandPlan plan_;
    std::uint64_t watch_;
    std::vector<engine::Draw> draws_;
    engine::GraphicsPipeline pipeline_;
};

template <class Made>
std::unique_ptr<StrandBackend> make(const BackendContext& context) {
    return std::make_unique<Made>(context);
}

struct BackendRow {
    Backend backend;
    std::unique_ptr<StrandBackend> (*make)(const BackendContext&);
};

// All back ends, one row each.
constexpr std::array kBackends{
    BackendRow{Backend::tessellation, make<TessellationBackend>},
    BackendRow{Backend::pulling_geometry, make<PullingGeometryBackend>},
    BackendRow{Backend::software, make<SoftwareBackend>},
};

// All that is skipped, one row each.
constexpr std::array kBackendLimits{
    BackendLimit{
        Backend::software, "a `/render/transparency` but `none`", "it keeps one strand a sample",
        [](const Settings& s) { return s.render.transparency != Transparency::none; }},
    BackendLimit{
        Backend::software, "a `/render/show` but `shading`", "it only shades",
        [](const Settings& s) { return s.render.show != Show::shading; }},
    BackendLimit{
        Backend::software, "`/strands/texture`", "its strands have no holes",
        [](const Settings& s) { return !s.strands.texture.empty(); }},
};

engine::Buffer watchBuffer(const engine::Device& device) {
    device.require(engine::Feature::vertex_stores, "ablation");
    return {
        device,
        {.size = sizeof(gpu::StageWatch), .usage = engine::Usage::storage, .name = "stage watch"}};
}

}  // namespace

std::unique_ptr<StrandBackend> makeBackend(Backend backend, const BackendContext& context) {
    if (context.output.quads == QuadKind::light) backend = mapBackend(backend, context.device);
    const auto row = std::ranges::find(kBackends, backend, &BackendRow::backend);
    assert(row != kBackends.end());
    if (!context.stages.last) return std::make_unique<EmptyBackend>();
    if (backend != Backend::tessellation && context.stages != StrandStages{})
        throw engine::Unsupported("/strands/backend", "only tessellation's stages can be left out");
    return row->make(context);
}

Backend mapBackend(Backend backend, const engine::Device& device) {
    if (backend != Backend::software) return backend;
    return device.has(engine::Feature::tessellation) ? Backend::tessellation
                                                     : Backend::pulling_geometry;
}

std::span<const BackendLimit> backendLimits() { return kBackendLimits; }

void checkBackend(const Settings& settings) {
    for (const BackendLimit& limit : kBackendLimits) {
        if (limit.backend != settings.strands.backend || !limit.asks(settings)) continue;
        std::string text =
            std::string(limit.asked_for) + " is not drawn: " + std::string(limit.reason);
        std::erase(text, '`');
        throw engine::Unsupported("/strands/backend", text);
    }
}

bool readsSceneDepth(const Settings& settings) {
    return settings.render.hair && settings.strands.backend == Backend::software;
}

engine::Constants strandConstants(const StrandSettings& strands, const StrandPlan& plan) {
    return {
        {gpu::kCurveConstant, shaderCode(strands.curve)},
        {gpu::kTaperConstant, shaderCode(strands.taper)},
        {gpu::kLodModeConstant, shaderCode(plan.lod_mode)},
        {gpu::kSourceConstant, shaderCode(strands.source)},
        {gpu::kWidthConstant, shaderCode(strands.width)},
        {gpu::kOffsetsConstant, hasOffsets(strands)},
        {gpu::kInterpolationConstant, shaderCode(strands.interpolation)},
        {gpu::kCollisionRuleConstant, strands.collision_rule},
        {gpu::kRandomnessConstant, shaderCode(strands.randomness)},
        {gpu::kLodMorphConstant, plan.morphs}};
}

// ---- Watched stages -----------------------------------------------------------------------------

StageWatch::StageWatch(const engine::Device& device)
    : device_(device), buffer_(watchBuffer(device)) {
    seeNone();
}

void StageWatch::seeAll() { see(0, 0); }

void StageWatch::seeNone() { see(0xffffffff, 0x9e3779b9); }  // any number that is nothing special

StageWatch::Seen StageWatch::seen() const {
    const gpu::StageWatch watch = engine::downloadAs<gpu::StageWatch>(device_, buffer_).front();
    return {.invocations = watch.count, .sum = watch.sum};
}

void StageWatch::see(std::uint32_t mask, std::uint32_t wanted) {
    const gpu::StageWatch watch{.mask = mask, .wanted = wanted, .sum = 0, .count = 0};
    engine::upload(device_, std::as_bytes(std::span(&watch, 1)), buffer_);
}

}  // namespace hair::rendering
