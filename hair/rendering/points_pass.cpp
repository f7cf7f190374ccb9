#include "hair/rendering/points_pass.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <string>

#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "engine/error.h"
#include "engine/transfer.h"
#include "hair/rendering/strand_backend.h"
#include "hair/rendering/strand_offsets.h"

namespace hair::rendering {
namespace {

using engine::Access;

}  // namespace

// ---- Levels of detail by cluster ----------------------------------------------------------------

namespace {

static_assert(sizeof(gpu::LevelsPush) == 48 && sizeof(gpu::ClusterLevel) == 8);

// m, of strands at level 0, without gaps.
float widthOfStrands(const StrandPlan& plan) {
    return plan.greatest_width / (plan.merged_hairs ? gpu::kMostMergedSpread : 1.0f);
}

}  // namespace

engine::MemoryRows LevelsPass::rows(const StrandPlan& plan) {
    return {
        "strands",
        {{"cluster levels", engine::bytesOf<gpu::ClusterLevel>(plan.triangles)},
         {"cluster order",
          engine::bytesOf<std::uint32_t>(std::uint64_t{plan.triangles} * plan.density)},
         {"cluster coverings", engine::bytesOf<float>(plan.triangles)}}};
}

LevelsPass::LevelsPass(
    const engine::Device& device, const Settings& settings, const StrandPlan& plan)
    : push_{
          .slopes = 0.5f * static_cast<float>(settings.render.ssaa) *
                    glm::vec2(settings.render.width, settings.render.height),
          .error = static_cast<float>(settings.render.ssaa),
          .reach = plan.reach,
          .greatest_width = widthOfStrands(plan),
          .clusters = plan.triangles},
      pipeline_(
          device, {.shader = "strands/levels.comp",
                   .constants = strandConstants(settings.strands, plan),
                   .push_size = sizeof(gpu::LevelsPush)}) {
    const ClusterOrder order = orderClusters(settings.seed, plan.triangles, settings.strands);
    const engine::MemoryRows rows = LevelsPass::rows(plan);
    levels_ = {device, rows["cluster levels"]};
    order_ = engine::makeBuffer(device, order.strands, rows, "cluster order");
    coverings_ = engine::makeBuffer(device, order.coverings, rows, "cluster coverings");
    push_.coverings = coverings_.address();
}

void LevelsPass::record(
    engine::Commands& commands, std::uint64_t picture, const gpu::PictureParameters& parameters,
    const LodSettings& lod) const {
    gpu::LevelsPush push = push_;
    push.picture = picture;
    push.slopes *= parameters.pixel_slope;
    push.error *= lod.error;
    push.levels = commands.writes(levels_);
    commands.uses({{parameters.guides, Access::compute_read}});
    commands.bind(pipeline_, push);
    commands.dispatchInvocations(push.clusters, gpu::kLevelsGroupSize);
}

// ---- Skinned roots ------------------------------------------------------------------------------

namespace {

static_assert(sizeof(gpu::CarriedRoot) == 52 && offsetof(gpu::CarriedRoot, inverse_edges) == 36);
static_assert(sizeof(gpu::SkinPush) == 36);

// The pass computes roots without its own corrections.
engine::ComputeDescription skinStage(const StrandSettings& strands, StrandPlan plan) {
    plan.skinned = false;
    return {
        .shader = "strands/skin.comp",
        .constants = strandConstants(strands, plan),
        .push_size = sizeof(gpu::SkinPush)};
}

// The hair as it is at rest.
StrandView atRest(StrandView view) {
    view.guides = view.rest_guides;
    view.contacts = view.rest_guides;  // w is 0: no contact
    view.head = glm::mat4(1.0f);
    return view;
}

gpu::CarriedRoot carriedRoot(const groom::SurfaceBinding& binding, const glm::vec3& root) {
    const glm::dmat2 inverse = glm::inverse(binding.edges);
    return {
        .corners = {binding.corners[0], binding.corners[1], binding.corners[2]},
        .weights = binding.weights,
        .offset = glm::transpose(binding.frame) * (glm::dvec3(root) - binding.nearest),
        .inverse_edges = glm::dvec4(inverse[0], inverse[1])};
}

}  // namespace

engine::MemoryRows
SkinnedHead::rows(std::uint64_t vertices, std::uint64_t strands, const RenderSettings& render) {
    constexpr std::uint32_t kSlots = engine::FrameLoop::kMaxSlots;
    const std::size_t bytes = engine::bytesOf<glm::vec3>(vertices);
    engine::MemoryRows rows(
        "meshes", {{"deformed mesh positions", bytes, kSlots, engine::Usage::upload},
                   {"deformed mesh normals", bytes, kSlots, engine::Usage::upload}});
    rows.add("groom", {{"root corrections", engine::bytesOf<glm::vec4>(strands)}});
    if (strands > 0 && render.hair)
        rows.add(
            "groom", {{"root triangles of strands", engine::bytesOf<gpu::CarriedRoot>(strands)}});
    return rows;
}

SkinnedHead::SkinnedHead(
    const engine::Device& device, const Settings& settings, const StrandPlan& plan,
    const StrandView& view, const LevelsPass* levels)
    : strand_count_(plan.triangles * plan.density),
      pipeline_(device, skinStage(settings.strands, plan)) {
    const engine::MemoryRows rows =
        SkinnedHead::rows(view.deforming->restPositions().size(), strand_count_, settings.render);
    for (std::uint32_t slot = 0; slot < engine::FrameLoop::kMaxSlots; ++slot) {
        positions_[slot] = {device, rows["deformed mesh positions"]};
        normals_[slot] = {device, rows["deformed mesh normals"]};
        write(slot, view);
    }
    corrections_ = {device, rows["root corrections"]};
    if (strand_count_ == 0 || !settings.render.hair) return;

    const StrandView rest = atRest(view);
    std::optional<FramesPass> frames;
    if (FramesPass::isNeeded(rest)) frames.emplace(device, rest);
    const engine::Buffer parameters(
        device, {.size = sizeof(gpu::PictureParameters),
                 .usage = engine::Usage::upload,
                 .name = "picture parameters",
                 .purpose = "shading"});
    const gpu::PictureParameters picture = pictureParameters(
        settings, plan, rest,
        {.guide_normals = frames ? frames->normals().address() : 0,
         .guide_turns = frames ? frames->turns().address() : 0,
         .cluster_levels = levels ? levels->levels().address() : 0,
         .strand_order = levels ? levels->order().address() : 0});
    parameters.write(picture);
    runOnce(device, [&](engine::Commands& commands) {
        if (levels) {
            levels->record(commands, parameters.address(), picture, settings.lod);
            commands.uses({{picture.cluster_levels, Access::compute_read}});
        }
        if (frames) {
            frames->record(commands, rest);
            commands.uses(
                {{frames->normals().address(), Access::compute_read},
                 {frames->turns().address(), Access::compute_read}});
        }
        commands.bind(
            pipeline_, gpu::SkinPush{
                           .picture = parameters.address(),
                           .found = commands.writes(corrections_),
                           .count = strand_count_});
        commands.dispatchInvocations(strand_count_, gpu::kSkinGroupSize);
    });
    std::vector<glm::vec3> found;
    for (const glm::vec4& root : engine::downloadAs<glm::vec4>(device, corrections_))
        found.emplace_back(root);
    const std::vector<groom::SurfaceBinding> bindings = view.deforming->bind(found);
    std::vector<gpu::CarriedRoot> roots;
    roots.reserve(found.size());
    for (std::size_t i = 0; i < found.size(); ++i)
        roots.push_back(carriedRoot(bindings[i], found[i]));
    roots_ = engine::makeBuffer(device, roots, rows, "root triangles of strands");
}

void SkinnedHead::write(std::uint32_t slot, const StrandView& view) {
    view.deforming->positions(view.time, work_.scratch, work_.positions);
    view.deforming->normals(work_.positions, work_.scratch, work_.turned);
    work_.moved.clear();
    for (const glm::dvec3& position : work_.positions)
        work_.moved.emplace_back(view.carried * glm::dvec4(position, 1.0));
    for (glm::vec3& normal : work_.turned)
        normal = glm::vec3(glm::dmat3(view.carried) * glm::dvec3(normal));
    positions_[slot].write(std::as_bytes(std::span(work_.moved)));
    normals_[slot].write(std::as_bytes(std::span(work_.turned)));
}

void SkinnedHead::record(
    engine::Commands& commands, std::uint64_t picture, const gpu::PictureParameters& parameters,
    std::uint32_t slot) const {
    if (!roots_.address()) return;
    commands.uses(
        {{parameters.guides, Access::compute_read},
         {parameters.contacts, Access::compute_read},
         {parameters.guide_normals, Access::compute_read},
         {parameters.guide_turns, Access::compute_read},
         {parameters.cluster_levels, Access::compute_read}});
    commands.bind(
        pipeline_, gpu::SkinPush{
                       .picture = picture,
                       .roots = roots_.address(),
                       .mesh = positions_[slot].address(),
                       .found = commands.writes(corrections_),
                       .count = strand_count_});
    commands.dispatchInvocations(strand_count_, gpu::kSkinGroupSize);
}

// ---- Points of strands --------------------------------------------------------------------------

namespace {

static_assert(sizeof(gpu::HairBounds) == 16);
static_assert(sizeof(gpu::PointsPush) == 56 && offsetof(gpu::PointsPush, width) == 32);

constexpr std::size_t kPointBytes = 16;  // strands/points/points.glsl

// On a processor, a texel fetch reads whole points for all invocations at once, which is faster:
// docs/performance.md.
bool readsTexels(const engine::Device& device, std::size_t bytes) {
    return device.info().type == engine::DeviceType::cpu &&
           bytes / kPointBytes <= device.info().limits.maxTexelBufferElements;
}

// A piece takes one iteration for its point, and some more where a segment begins.
std::uint32_t evaluatedBlock(
    const engine::Device& device, const StrandSettings& strands, const StrandPlan& plan) {
    return strandBlock(device, strands, plan, 4);
}

// Returns the segments that an invocation evaluates. A processor reads the control points that two
// segments share once. On other devices a strand whose segments are evaluated at the same time is
// done sooner, and an invocation needs fewer registers.
std::uint32_t segmentRun(const engine::Device& device, const StrandPlan& plan) {
    return device.info().type == engine::DeviceType::cpu ? plan.segments : 1;
}

engine::ComputeDescription
evaluateStage(const engine::Device& device, const Settings& settings, const StrandPlan& plan) {
    engine::Constants constants = pointsConstants(settings.strands, plan);
    constants.emplace_back(
        gpu::kStrandBlockConstant, evaluatedBlock(device, settings.strands, plan));
    constants.emplace_back(gpu::kSegmentRunConstant, segmentRun(device, plan));
    constants.emplace_back(gpu::kGroupConstant, strandGroup(device));
    constants.emplace_back(gpu::kPixelSamplesConstant, settings.render.msaa);
    return {
        .shader = readsPairs(device) ? "strands/points/evaluate.comp+packed"
                                     : "strands/points/evaluate.comp",
        .constants = constants,
        .extensions = strandExtensions(settings.strands),
        .push_size = sizeof(gpu::PointsPush)};
}

}  // namespace

// Shaders number points in 32 bits; the last number stands for no point.
void checkPoints(const StrandPlan& plan) {
    const std::uint64_t points =
        plan.strands() * plan.segments * (std::uint64_t{plan.forced_tessellation} + 1);
    if (points >= std::numeric_limits<std::uint32_t>::max())
        throw engine::Unsupported(
            "/strands/backend", "up to " + std::to_string(points) + " points are too many");
}

engine::MemoryRows PointsPass::rows(const StrandSettings& strands, const StrandPlan& plan) {
    const auto atLeastOne = [](std::uint64_t bytes) {
        return std::max(static_cast<std::size_t>(bytes), kPointBytes);
    };
    return {
        "strands",
        {{"strands' points",
          atLeastOne(kPointBytes * plan.strands() * pointsPerStrand(strands, plan))},
         {"strands' pieces", atLeastOne(sizeof(std::uint32_t) * plan.strands())},
         {"strands' bounds", sizeof(gpu::HairBounds)}}};
}

PointsPass::PointsPass(
    const engine::Device& device, const Settings& settings, const StrandPlan& plan, bool culls)
    : push_{
          .width = settings.render.width * settings.render.ssaa,
          .height = settings.render.height * settings.render.ssaa,
          .reach = plan.reach,
          .greatest_width = plan.greatest_width,
          .culls = culls},
      group_(strandGroup(device)),
      triangles_(plan.triangles), block_(evaluatedBlock(device, settings.strands, plan)),
      runs_(divideUp(plan.segments, segmentRun(device, plan))),
      evaluate_(device, evaluateStage(device, settings, plan)) {
    checkPoints(plan);
    const engine::MemoryRows rows = PointsPass::rows(settings.strands, plan);
    points_ = {device, rows["strands' points"]};
    pieces_ = {device, rows["strands' pieces"]};
    bounds_ = {device, rows["strands' bounds"]};
    if (readsTexels(device, points_.size()))
        texels_.emplace(device, points_, VK_FORMAT_R32G32B32A32_UINT);
}

void PointsPass::clear(engine::Commands& commands) const { commands.fill(bounds_, 0); }

void PointsPass::record(
    engine::Commands& commands, std::uint64_t picture,
    const gpu::PictureParameters& parameters) const {
    gpu::PointsPush push = push_;
    push.picture = picture;
    push.strands = strandCount(parameters);
    push.points = commands.writes(points_);
    push.pieces = commands.writes(pieces_);
    push.bounds = commands.writes(bounds_);
    declareStrands(commands, parameters, engine::Access::compute_read);
    commands.bind(evaluate_, push);
    const std::uint32_t blocks = divideUp(parameters.forced_density, block_);  // of a triangle
    commands.dispatchInvocations(triangles_ * blocks * runs_, group_);
}

std::size_t pointsPerStrand(const StrandSettings& strands, const StrandPlan& plan) {
    if (strands.taper == Taper::segment)
        return std::size_t{plan.segments} * (plan.forced_tessellation + 1);
    return std::size_t{plan.segments} * plan.forced_tessellation + 1;
}

engine::Constants placeConstants(const StrandPlan& plan) {
    return {
        {gpu::kMostSegmentsConstant, plan.segments},
        {gpu::kMostPiecesConstant, plan.forced_tessellation}};
}

engine::Constants pointsConstants(const StrandSettings& strands, const StrandPlan& plan) {
    engine::Constants constants = strandConstants(strands, plan);
    const engine::Constants places = placeConstants(plan);
    constants.insert(constants.end(), places.begin(), places.end());
    return constants;
}

bool readsPairs(const engine::Device& device) { return device.has(engine::Feature::long_integers); }

std::uint32_t strandGroup(const engine::Device& device) {
    constexpr std::uint32_t kLeast = 32;
    if (device.info().type == engine::DeviceType::cpu) return kLeast;
    return std::max(device.info().subgroup_size, kLeast);
}

std::uint32_t strandBlock(
    const engine::Device& device, const StrandSettings& strands, const StrandPlan& plan,
    std::uint32_t turns) {
    constexpr std::uint64_t kMostTurns = 60000;
    constexpr std::uint64_t kProcessorBlock = 8;
    if (device.info().type != engine::DeviceType::cpu) return 1;
    if (strands.source != StrandSource::root_triangles) return 1;
    const std::uint64_t pieces = std::uint64_t{plan.segments} * plan.forced_tessellation;
    const std::uint64_t most = kMostTurns / (turns * pieces);
    return static_cast<std::uint32_t>(std::clamp(most, std::uint64_t{1}, kProcessorBlock));
}

}  // namespace hair::rendering
