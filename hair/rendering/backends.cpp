#include "hair/rendering/backends.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <optional>

#include "engine/error.h"
#include "engine/shaders.h"
#include "engine/transfer.h"
#include "hair/gpu_structs.h"
#include "hair/rendering/mesh_backend.h"
#include "hair/rendering/points_pass.h"
#include "hair/rendering/rays_backend.h"
#include "hair/rendering/software_backend.h"
#include "hair/rendering/strand_offsets.h"
#include "hair/shader_codes.h"

namespace hair::rendering {

// ---- The list of back ends ----------------------------------------------------------------------

namespace {

using engine::Access;

// The geometry stage that makes the quads.
std::string geometryShader(QuadKind quads) {
    return quads == QuadKind::camera ? "strands/strand.geom" : "strands/strand.geom+shadow";
}

// Draws no strands.
class EmptyBackend : public StrandBackend {
public:
    void draw(engine::Commands&, const StrandPicture&) const override {}

    std::optional<ExpectedCounts> expected() const override { return std::nullopt; }
};

// Returns the number of vertices: both ends of every piece.
std::uint32_t lineListVertices(const StrandPlan& plan) {
    const std::uint64_t count =
        std::uint64_t{2} * plan.patches() * plan.strands_per_patch * plan.forced_tessellation;
    if (count > std::numeric_limits<std::uint32_t>::max())
        throw engine::Unsupported(
            "/strands/backend", std::to_string(count) + " vertices do not fit one draw");
    return static_cast<std::uint32_t>(count);
}

// Evaluates strand points in the vertex stage of a line list, with the geometry and fragment stages
// of tessellation.
class PullingGeometryBackend : public StrandBackend {
public:
    explicit PullingGeometryBackend(const BackendContext& context)
        : vertices_(lineListVertices(context.plan)), pipeline_(context.device, describe(context)) {}

    static void check(const engine::Device& device, const Settings&, const StrandPlan& plan) {
        device.require(engine::Feature::geometry, "/strands/backend: pulling_geometry");
        lineListVertices(plan);
    }

    void draw(engine::Commands& commands, const StrandPicture& picture) const override {
        declareStrands(commands, picture.parameters);
        commands.bind(pipeline_, gpu::StrandPush{.picture = picture.address});
        commands.images(pipeline_, picture.images);
        commands.draw({.vertices = vertices_});
    }

    std::optional<ExpectedCounts> expected() const override { return std::nullopt; }

private:
    static engine::GraphicsDescription describe(const BackendContext& context) {
        context.device.require(engine::Feature::geometry, "/strands/backend: pulling_geometry");
        engine::GraphicsDescription description = strandPipeline(context);
        description.shaders = {
            "strands/pulling_geometry.vert", geometryShader(context.output.quads),
            context.output.fragment};
        description.topology = VK_PRIMITIVE_TOPOLOGY_LINE_LIST;
        return description;
    }

    std::uint32_t vertices_;
    engine::GraphicsPipeline pipeline_;
};

// Draws strands as lines a pixel wide. An opaque strand takes random samples of a pixel in
// proportion to its coverage, so a single strand is a dotted line.
class LinesBackend : public StrandBackend {
public:
    explicit LinesBackend(const BackendContext& context)
        : vertices_(lineListVertices(context.plan)), pipeline_(context.device, describe(context)) {}

    static void check(const engine::Device&, const Settings&, const StrandPlan& plan) {
        lineListVertices(plan);
    }

    void draw(engine::Commands& commands, const StrandPicture& picture) const override {
        declareStrands(commands, picture.parameters);
        commands.bind(pipeline_, gpu::StrandPush{.picture = picture.address});
        commands.images(pipeline_, picture.images);
        commands.draw({.vertices = vertices_});
    }

    std::optional<ExpectedCounts> expected() const override { return std::nullopt; }

private:
    static engine::GraphicsDescription describe(const BackendContext& context) {
        engine::GraphicsDescription description = strandPipeline(context);
        description.constants.emplace_back(
            gpu::kStrictLinesConstant, context.device.info().limits.strictLines == VK_TRUE);
        description.constants.emplace_back(gpu::kLinesConstant, true);
        constexpr std::string_view kOpaque = "strands/strand.frag";
        std::string fragment = context.output.fragment;
        if (engine::shaderFile(fragment) == kOpaque)
            fragment.replace(0, kOpaque.size(), "strands/samples.frag");
        description.shaders = {"strands/lines.vert", fragment};
        description.topology = VK_PRIMITIVE_TOPOLOGY_LINE_LIST;
        return description;
    }

    std::uint32_t vertices_;
    engine::GraphicsPipeline pipeline_;
};

// Lines of consecutive pieces. Each end of a piece has two corners.
struct PieceLines {
    std::uint32_t lines;
    std::uint32_t pieces;  // of a line
    std::uint32_t ends;  // from the first end of a line to that of the next
};

// Returns the corners of the pieces' quads.
std::vector<std::uint32_t> quadIndices(const PieceLines& of) {
    std::vector<std::uint32_t> indices;
    indices.reserve(std::size_t{6} * of.lines * of.pieces);
    for (std::uint32_t line = 0; line < of.lines; ++line) {
        for (std::uint32_t piece = 0; piece < of.pieces; ++piece) {
            const std::uint32_t first = 2 * (line * of.ends + piece);
            for (const std::uint32_t corner : {0u, 1u, 2u, 1u, 3u, 2u})
                indices.push_back(first + corner);
        }
    }
    return indices;
}

constexpr const char* kCorners = "strands' corners";

engine::MemoryRows cornerRows(const PieceLines& of) {
    return {"strands", {{kCorners, engine::bytesOf<std::uint32_t>(6ull * of.lines * of.pieces)}}};
}

// Makes the corners of quads in the vertex stage, which evaluates the points as well.
class PullingBackend : public StrandBackend {
public:
    explicit PullingBackend(const BackendContext& context)
        : lines_(lineCount(context.plan)), block_(blockOf(context.plan)),
          indices_per_line_(6 * context.plan.forced_tessellation),
          indices_(engine::makeBuffer(
              context.device, quadIndices(linesOf(context.plan)), cornerRows(linesOf(context.plan)),
              kCorners)),
          pipeline_(context.device, describe(context, block_)) {}

    static void check(const engine::Device&, const Settings&, const StrandPlan& plan) {
        lineCount(plan);
    }

    static engine::MemoryRows rows(const engine::Device&, const Settings&, const StrandPlan& plan) {
        return cornerRows(linesOf(plan));
    }

    void draw(engine::Commands& commands, const StrandPicture& picture) const override {
        declareStrands(commands, picture.parameters);
        commands.bind(pipeline_, gpu::StrandPush{.picture = picture.address});
        commands.images(pipeline_, picture.images);
        const std::uint32_t whole = lines_ / block_;
        if (whole > 0)
            commands.drawIndexed(
                indices_, {.indices = block_ * indices_per_line_, .instances = whole});
        if (const std::uint32_t rest = lines_ % block_; rest > 0)
            commands.drawIndexed(
                indices_, {.indices = rest * indices_per_line_, .first_instance = whole});
    }

    std::optional<ExpectedCounts> expected() const override { return std::nullopt; }

private:
    // Counts the isolines of all patches.
    static std::uint32_t lineCount(const StrandPlan& plan) {
        const std::uint64_t count = std::uint64_t{plan.patches()} * plan.strands_per_patch;
        if (count > std::numeric_limits<std::uint32_t>::max()) {
            throw engine::Unsupported(
                "pulling", std::to_string(count) + " strands' segments are too many");
        }
        return static_cast<std::uint32_t>(count);
    }

    static PieceLines linesOf(const StrandPlan& plan) {
        return {
            .lines = blockOf(plan),
            .pieces = plan.forced_tessellation,
            .ends = plan.forced_tessellation + 1};
    }

    // Isolines per instance: enough to make an instance worth its cost, few enough for a short list
    // of corners.
    static std::uint32_t blockOf(const StrandPlan& plan) {
        constexpr std::uint32_t kMostCorners = 4096;
        return std::max(kMostCorners / (2 * (plan.forced_tessellation + 1)), 1u);
    }

    static engine::GraphicsDescription
    describe(const BackendContext& context, std::uint32_t block) {
        engine::GraphicsDescription description = strandPipeline(context);
        description.constants.emplace_back(gpu::kStrandBlockConstant, block);
        description.shaders = {
            context.output.quads == QuadKind::camera ? "strands/pulling.vert"
                                                     : "strands/pulling.vert+shadow",
            context.output.fragment};
        return description;
    }

    std::uint32_t lines_;
    std::uint32_t block_;
    std::uint32_t indices_per_line_;
    engine::Buffer indices_;
    engine::GraphicsPipeline pipeline_;
};

// Makes the corners of quads in the vertex stage from the points of a PointsPass. The camera's
// picture draws only the strands that it can show, shadow maps all of them.
class ExpandedBackend : public StrandBackend {
public:
    explicit ExpandedBackend(const BackendContext& context)
        : points_(*context.points), is_listed_(context.output.quads == QuadKind::camera),
          group_(strandGroup(context.device)),
          indices_per_strand_(6 * context.plan.segments * context.plan.forced_tessellation),
          list_(context.device, listStage(context)), pipeline_(context.device, describe(context)) {
        const engine::MemoryRows rows = rowsOf(context.strands, context.plan);
        indices_ = engine::makeBuffer(
            context.device, quadIndices(strandLines(context.strands, context.plan)), rows,
            kCorners);
        visible_ = {context.device, rows["strands' list"]};
        arguments_ = {context.device, rows["strands' draws"]};
    }

    static void check(const engine::Device&, const Settings&, const StrandPlan& plan) {
        checkPoints(plan);
    }

    static engine::MemoryRows
    rows(const engine::Device&, const Settings& settings, const StrandPlan& plan) {
        return rowsOf(settings.strands, plan);
    }

    void prepare(engine::Commands& commands, const StrandPicture& picture) const override {
        if (!is_listed_) return;
        const std::uint32_t strands = points_.strandCount(picture.parameters);
        commands.bind(
            list_, gpu::ExpandedPush{
                       .pieces = commands.reads(points_.pieces()),
                       .visible = commands.writes(visible_),
                       .arguments = commands.writes(arguments_),
                       .strands = strands});
        commands.dispatchInvocations(drawsOf(strands), group_);
    }

    void draw(engine::Commands& commands, const StrandPicture& picture) const override {
        const auto reads = [&](const engine::Buffer& buffer) {
            return commands.use({buffer, Access::vertex_read});
        };
        const std::uint32_t strands = points_.strandCount(picture.parameters);
        commands.bind(
            pipeline_, gpu::ExpandedPush{
                           .picture = picture.address,
                           .points = reads(points_.points()),
                           .pieces = reads(points_.pieces()),
                           .visible = is_listed_ ? reads(visible_) : 0,
                           .strands = strands});
        commands.images(pipeline_, picture.images);
        if (is_listed_) {
            commands.drawIndexed(indices_, arguments_, drawsOf(strands));
            return;
        }
        const std::uint32_t whole = strands / gpu::kExpandedStrands;
        const std::uint32_t rest = strands % gpu::kExpandedStrands;
        if (whole > 0)
            commands.drawIndexed(
                indices_,
                {.indices = gpu::kExpandedStrands * indices_per_strand_, .instances = whole});
        if (rest > 0)
            commands.drawIndexed(
                indices_, {.indices = rest * indices_per_strand_, .first_instance = whole});
    }

    std::optional<ExpectedCounts> expected() const override { return std::nullopt; }

private:
    static std::uint32_t drawsOf(std::uint32_t strands) {
        return divideUp(strands, gpu::kExpandedStrands);
    }

    // If segments have end points of their own, a line is a segment; otherwise it is a strand.
    static PieceLines strandLines(const StrandSettings& strands, const StrandPlan& plan) {
        if (strands.taper == Taper::segment)
            return {
                .lines = gpu::kExpandedStrands * plan.segments,
                .pieces = plan.forced_tessellation,
                .ends = plan.forced_tessellation + 1};
        const std::uint32_t pieces = plan.segments * plan.forced_tessellation;
        return {.lines = gpu::kExpandedStrands, .pieces = pieces, .ends = pieces + 1};
    }

    static engine::MemoryRows rowsOf(const StrandSettings& strands, const StrandPlan& plan) {
        const std::uint32_t draws = drawsOf(static_cast<std::uint32_t>(plan.strands()));
        engine::MemoryRows rows(
            "strands", {{"strands' list", engine::bytesOf<std::uint32_t>(plan.strands())},
                        {"strands' draws", engine::bytesOf<gpu::IndexedCommand>(draws)}});
        rows.add(cornerRows(strandLines(strands, plan)));
        return rows;
    }

    static engine::ComputeDescription listStage(const BackendContext& context) {
        engine::Constants constants = pointsConstants(context.strands, context.plan);
        constants.emplace_back(gpu::kGroupConstant, strandGroup(context.device));
        return {
            .shader = "strands/points/list.comp",
            .constants = constants,
            .push_size = sizeof(gpu::ExpandedPush)};
    }

    static engine::GraphicsDescription describe(const BackendContext& context) {
        engine::GraphicsDescription description = strandPipeline(context);
        const engine::Constants places = placeConstants(context.plan);
        description.constants.insert(description.constants.end(), places.begin(), places.end());
        description.shaders = {
            std::string("strands/expanded.vert") +
                (context.output.quads == QuadKind::camera ? "" : "+shadow") +
                (readsPairs(context.device) ? "+packed" : ""),
            context.output.fragment};
        description.push_size = sizeof(gpu::ExpandedPush);
        return description;
    }

    const PointsPass& points_;
    bool is_listed_;  // prepare() lists the strands that the picture can show
    std::uint32_t draws_;
    std::uint32_t group_;  // invocations of a work group of list_
    std::uint32_t indices_per_strand_;
    engine::Buffer indices_;
    engine::Buffer visible_;  // gpu::ExpandedPush::visible
    engine::Buffer arguments_;  // gpu::IndexedCommand
    engine::ComputePipeline list_;
    engine::GraphicsPipeline pipeline_;
};

// Returns the shaders of the stages up to the last one. Throws engine::Unsupported for stages that
// the device lacks.
std::vector<std::string> stageShaders(const BackendContext& context) {
    const StrandStages& stages = context.stages;
    const auto path = [&](StrandStage stage, const std::string& file) {
        return file + (stages.watched == stage ? "+watched" : "");
    };
    std::vector<std::string> shaders{path(StrandStage::vertex, "strands/tessellation.vert")};
    if (stages.last >= StrandStage::evaluation) {
        context.device.require(engine::Feature::tessellation, "/strands/backend: tessellation");
        shaders.emplace_back("strands/tessellation.tesc");
        shaders.push_back(path(StrandStage::evaluation, "strands/tessellation.tese"));
    }
    if (stages.last >= StrandStage::geometry) {
        context.device.require(engine::Feature::geometry, "/strands/backend: tessellation");
        shaders.push_back(path(StrandStage::geometry, geometryShader(context.output.quads)));
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

    static void check(const engine::Device& device, const Settings&, const StrandPlan&) {
        device.require(engine::Feature::tessellation, "/strands/backend: tessellation");
        device.require(engine::Feature::geometry, "/strands/backend: tessellation");
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

struct BackendRow {
    Backend backend;
    std::unique_ptr<StrandBackend> (*make)(const BackendContext&);
    void (*check)(const engine::Device&, const Settings&, const StrandPlan&);
    engine::MemoryRows (*rows)(const engine::Device&, const Settings&, const StrandPlan&);
};

template <class Made>
constexpr BackendRow row(Backend backend) {
    return {
        backend,
        [](const BackendContext& context) -> std::unique_ptr<StrandBackend> {
            return std::make_unique<Made>(context);
        },
        Made::check, Made::rows};
}

// All back ends, one row each.
constexpr std::array kBackends{
    row<TessellationBackend>(Backend::tessellation),
    row<PullingGeometryBackend>(Backend::pulling_geometry),
    row<LinesBackend>(Backend::lines),
    row<PullingBackend>(Backend::pulling),
    row<ExpandedBackend>(Backend::expanded),
    row<MeshBackend>(Backend::mesh),
    row<SoftwareBackend>(Backend::software),
    row<RaysBackend>(Backend::rays),
};

const BackendRow& rowOf(Backend backend) {
    const auto found = std::ranges::find(kBackends, backend, &BackendRow::backend);
    assert(found != kBackends.end());
    return *found;
}

engine::Buffer watchBuffer(const engine::Device& device) {
    device.require(engine::Feature::vertex_stores, "ablation");
    return {
        device, {.size = sizeof(gpu::StageWatch), .name = "stage watch", .purpose = "measuring"}};
}

}  // namespace

std::unique_ptr<StrandBackend> makeBackend(Backend backend, const BackendContext& context) {
    if (context.output.quads == QuadKind::light) backend = mapBackend(backend);
    if (!context.stages.last) return std::make_unique<EmptyBackend>();
    if (backend != Backend::tessellation && context.stages != StrandStages{})
        throw engine::Unsupported("/strands/backend", "only tessellation's stages can be left out");
    return rowOf(backend).make(context);
}

void checkDevice(
    Backend backend, const engine::Device& device, const Settings& settings,
    const StrandPlan& plan) {
    rowOf(backend).check(device, settings, plan);
}

engine::MemoryRows backendRows(
    const engine::Device& device, const Settings& settings, const StrandPlan& plan,
    QuadKind quads) {
    const Backend backend = settings.strands.backend;
    return rowOf(quads == QuadKind::light ? mapBackend(backend) : backend)
        .rows(device, settings, plan);
}

namespace {

// Back ends that find in compute what each sample shows.
bool hasVisibilityBuffer(Backend backend) {
    return backend == Backend::software || backend == Backend::rays;
}

}  // namespace

Backend mapBackend(Backend backend) {
    assert(!drawsMapsInCompute(backend));
    return backend == Backend::lines ? Backend::pulling : backend;
}

bool drawsMapsInCompute(Backend backend) { return hasVisibilityBuffer(backend); }

bool readsPoints(const Settings& settings) {
    const Backend backend = settings.strands.backend;
    return settings.render.hair && (hasVisibilityBuffer(backend) || backend == Backend::expanded);
}

bool readsSceneDepth(const Settings& settings) {
    return settings.render.hair && hasVisibilityBuffer(settings.strands.backend);
}

// ---- Watched stages -----------------------------------------------------------------------------

StageWatch::StageWatch(const engine::Device& device)
    : device_(device), buffer_(watchBuffer(device)) {
    countNone();
}

void StageWatch::countAll() { set(0, 0); }

void StageWatch::countNone() { set(0xffffffff, 0x9e3779b9); }  // an arbitrary number

StageWatch::Counts StageWatch::counts() const {
    const gpu::StageWatch watch = engine::downloadAs<gpu::StageWatch>(device_, buffer_).front();
    return {.invocations = watch.count, .sum = watch.sum};
}

void StageWatch::set(std::uint32_t mask, std::uint32_t wanted) {
    const gpu::StageWatch watch{.mask = mask, .wanted = wanted, .sum = 0, .count = 0};
    engine::upload(device_, std::as_bytes(std::span(&watch, 1)), buffer_);
}

// ---- The choice of a back end -------------------------------------------------------------------

namespace {

// Only stages of compute that shade strands trace rays of light.
constexpr BackendLimit tracesNoLight(Backend backend) {
    return {
        backend, "`/shading/shadows/hair` `rays`", "its fragments trace no rays", tracesShadows};
}

// All settings that back ends don't draw, one row each.
constexpr std::array kBackendLimits{
    tracesNoLight(Backend::tessellation),
    tracesNoLight(Backend::pulling_geometry),
    tracesNoLight(Backend::lines),
    tracesNoLight(Backend::pulling),
    tracesNoLight(Backend::expanded),
    tracesNoLight(Backend::mesh),
    BackendLimit{
        Backend::lines, "`/render/coverage` `analytic`", "its lines are a pixel wide",
        [](const Settings& s) { return s.render.coverage == Coverage::analytic; }},
    BackendLimit{
        Backend::software, "a `/render/transparency` other than `none`",
        "it keeps one strand per sample",
        [](const Settings& s) { return s.render.transparency != Transparency::none; }},
    BackendLimit{
        Backend::software, "a `/render/show` other than `shading`",
        "it can only draw shaded strands",
        [](const Settings& s) { return s.render.show != Show::shading; }},
    BackendLimit{
        Backend::software, "`/strands/texture`", "its strands have no holes",
        [](const Settings& s) { return !s.strands.texture.empty(); }},
    BackendLimit{
        Backend::rays, "a `/render/transparency` other than `none`",
        "it keeps one strand per sample",
        [](const Settings& s) { return s.render.transparency != Transparency::none; }},
    BackendLimit{
        Backend::rays, "a `/render/show` other than `shading`", "it can only draw shaded strands",
        [](const Settings& s) { return s.render.show != Show::shading; }},
    BackendLimit{
        Backend::rays, "`/strands/texture`", "its strands have no holes",
        [](const Settings& s) { return !s.strands.texture.empty(); }},
    BackendLimit{
        Backend::rays, "`/shading/shadows/hair` `rays` with `/strands/rays/geometry` `triangles`",
        "the quads face the eye, not the light",
        [](const Settings& s) {
            return tracesShadows(s) && s.strands.rays.geometry == RaysGeometry::triangles;
        }},
};

// As measured on lavapipe (docs/performance.md).
constexpr std::array kOnProcessors{Backend::software, Backend::tessellation,     Backend::expanded,
                                   Backend::mesh,     Backend::pulling_geometry, Backend::pulling};

// As measured on an H200 (docs/performance.md).
constexpr std::array kOnGraphicsProcessors{Backend::software,     Backend::expanded,
                                           Backend::pulling,      Backend::mesh,
                                           Backend::tessellation, Backend::pulling_geometry};

// The reason why the back end can't draw the case; absent if it can.
std::optional<std::string> obstacle(
    Backend backend, const engine::Device& device, const Settings& settings,
    const StrandPlan& plan) {
    try {
        checkBackend(backend, settings);
        checkDevice(backend, device, settings, plan);
    } catch (const engine::Unsupported& error) {
        return error.what();
    }
    return std::nullopt;
}

}  // namespace

std::span<const BackendLimit> backendLimits() { return kBackendLimits; }

void checkBackend(Backend backend, const Settings& settings) {
    for (const BackendLimit& limit : kBackendLimits) {
        if (limit.backend != backend || !limit.asks(settings)) continue;
        std::string text =
            std::string(limit.asked_for) + " is not drawn: " + std::string(limit.reason);
        std::erase(text, '`');
        throw engine::Unsupported("/strands/backend", text);
    }
}

std::span<const Backend> backendOrder(const engine::DeviceInfo& device) {
    if (device.type == engine::DeviceType::cpu) return kOnProcessors;
    return kOnGraphicsProcessors;
}

BackendChoice chooseBackend(
    const engine::Device& device, const Settings& settings, const StrandPlan& plan,
    const StrandStages& stages) {
    const Backend own = settings.strands.backend;
    if (own != Backend::automatic) {
        if (settings.render.hair) checkBackend(own, settings);
        return {own, {}, "the scene names it"};
    }
    if (!settings.render.hair) return {Backend::tessellation, {}, "no hair is drawn"};
    if (stages != StrandStages{}) return {Backend::tessellation, {}, "its stages can be left out"};
    std::string others;
    for (const Backend backend : backendOrder(device.info())) {
        const std::optional<std::string> against = obstacle(backend, device, settings, plan);
        if (!against) return {backend, {}, "automatic: the first that can draw it" + others};
        others += "; not " + std::string(backendName(backend)) + ": " + *against;
    }
    throw engine::Unsupported("/strands/backend", "none can draw this" + others);
}

}  // namespace hair::rendering
