#include "hair/rendering/rays_backend.h"

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/error.h"
#include "engine/transfer.h"
#include "hair/rendering/render_assets.h"

namespace hair::rendering {
namespace {

static_assert(sizeof(gpu::CornersPush) == 44 && offsetof(gpu::CornersPush, points_count) == 32);

constexpr const char* kRays = "/strands/backend: rays";
constexpr const char* kCorners = "quad corners";
constexpr const char* kIndices = "quad triangles";

// Two triangles for each piece of a strand at the finest level of detail, and two corners for each
// point.
engine::TriangleSet trianglesOf(const StrandSettings& strands, const StrandPlan& plan) {
    const std::uint64_t triangles = 2 * plan.strands() * plan.segments * plan.forced_tessellation;
    const std::uint64_t vertices = 2 * plan.strands() * pointsPerStrand(strands, plan);
    constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
    if (3 * triangles > kMost || vertices > kMost)
        throw engine::Unsupported(
            kRays, std::to_string(triangles) + " triangles are too many for 32-bit indices");
    return {
        .vertices = static_cast<std::uint32_t>(vertices),
        .triangles = static_cast<std::uint32_t>(triangles),
        .is_opaque = !plan.merged_hairs,  // which have gaps
        .rebuild = strands.rays.update == RaysUpdate::build ? engine::Rebuild::anew
                                                            : engine::Rebuild::refit};
}

engine::MemoryRows
raysRows(const engine::Device& device, const StrandSettings& strands, const StrandPlan& plan) {
    const engine::TriangleSet triangles = trianglesOf(strands, plan);
    engine::MemoryRows rows(
        "acceleration",
        {{kCorners, engine::bytesOf<glm::vec3>(triangles.vertices)},
         {kIndices, engine::bytesOf<std::uint32_t>(std::uint64_t{3} * triangles.triangles)}});
    rows.add(engine::TriangleStructure::rows(device, triangles));
    return rows;
}

// The corners of each piece's triangles, in the order in which `expanded` draws them.
std::vector<std::uint32_t> triangleIndices(const StrandSettings& strands, const StrandPlan& plan) {
    const bool split = strands.taper == Taper::segment;
    const auto points = static_cast<std::uint32_t>(pointsPerStrand(strands, plan));
    const std::uint32_t ends = plan.forced_tessellation + (split ? 1 : 0);  // of a segment
    std::vector<std::uint32_t> indices;
    indices.reserve(std::size_t{3} * trianglesOf(strands, plan).triangles);
    for (std::uint32_t strand = 0; strand < plan.strands(); ++strand)
        for (std::uint32_t segment = 0; segment < plan.segments; ++segment)
            for (std::uint32_t piece = 0; piece < plan.forced_tessellation; ++piece) {
                const std::uint32_t first = 2 * (strand * points + segment * ends + piece);
                for (const std::uint32_t corner : {0u, 1u, 2u, 1u, 3u, 2u})
                    indices.push_back(first + corner);
            }
    return indices;
}

engine::ComputeDescription cornersStage(const BackendContext& context) {
    engine::Constants constants = pointsConstants(context.strands, context.plan);
    constants.emplace_back(gpu::kGroupConstant, strandGroup(context.device));
    return {
        .shader = readsPairs(context.device) ? "strands/rays/corners.comp+packed"
                                             : "strands/rays/corners.comp",
        .constants = constants,
        .push_size = sizeof(gpu::CornersPush)};
}

const BackendContext& checked(const BackendContext& context) {
    context.device.require(engine::Feature::ray_queries, kRays);
    return context;
}

}  // namespace

void RaysBackend::check(
    const engine::Device& device, const Settings& settings, const StrandPlan& plan) {
    device.require(engine::Feature::ray_queries, kRays);
    checkPoints(plan);
    VisibilityBuffer::check(device, settings, kRays);
    engine::TriangleStructure::rows(device, trianglesOf(settings.strands, plan));
}

engine::MemoryRows
RaysBackend::rows(const engine::Device& device, const Settings& settings, const StrandPlan& plan) {
    engine::MemoryRows rows = VisibilityBuffer::rows(targetDescription(settings.render));
    if (device.has(engine::Feature::ray_queries))
        rows.add(raysRows(device, settings.strands, plan));
    return rows;
}

RaysBackend::RaysBackend(const BackendContext& context)
    : points_(*context.points), visibility_(checked(context), kRays),
      point_count_(trianglesOf(context.strands, context.plan).vertices / 2),
      leaves_out_(
          context.strands.rays.update == RaysUpdate::build &&
          engine::TriangleStructure::leavesOutNan(context.device)),
      group_(strandGroup(context.device)),
      columns_(divideUp(context.target->color().extent().width, pixelGroup(context.device))),
      structure_(context.device, trianglesOf(context.strands, context.plan)),
      corners_stage_(context.device, cornersStage(context)),
      trace_(
          context.device, samplesStage(context, "rays", "trace.comp", pixelGroup(context.device))) {
    const engine::MemoryRows rows = raysRows(context.device, context.strands, context.plan);
    corners_ = {context.device, rows[kCorners]};
    indices_ = engine::makeBuffer(
        context.device, triangleIndices(context.strands, context.plan), rows, kIndices);
}

void RaysBackend::accelerate(engine::Commands& commands, const StrandPicture& picture) {
    commands.bind(
        corners_stage_, gpu::CornersPush{
                            .picture = picture.address,
                            .points = commands.reads(points_.points()),
                            .pieces = commands.reads(points_.pieces()),
                            .corners = commands.writes(corners_),
                            .points_count = point_count_,
                            .strands = points_.strandCount(picture.parameters),
                            .leaves_out = leaves_out_});
    commands.dispatchInvocations(point_count_, group_);
    structure_.build(commands, corners_, indices_);
}

void RaysBackend::prepare(engine::Commands& commands, const StrandPicture& picture) const {
    visibility_.clear(commands, picture);
    gpu::SoftwarePush constants = visibility_.push(picture);
    constants.points = commands.reads(points_.points());
    constants.pieces = commands.reads(points_.pieces());
    constants.bounds = commands.reads(points_.bounds());
    constants.visibility = commands.writes(visibility_.samples());
    constants.structure = structure_.traces(commands);
    commands.bind(trace_, constants);
    commands.dispatch(constants.height, columns_);
    visibility_.shade(commands, picture);
}

void RaysBackend::draw(engine::Commands& commands, const StrandPicture& picture) const {
    visibility_.draw(commands, picture);
}

}  // namespace hair::rendering
