#include "hair/rendering/strand_structure.h"

#include <cassert>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/error.h"
#include "engine/transfer.h"

namespace hair::rendering {
namespace {

static_assert(
    sizeof(gpu::PrimitivesPush) == 44 && offsetof(gpu::PrimitivesPush, invocations) == 32);
static_assert(sizeof(gpu::StrandBox) == 32 && offsetof(gpu::StrandBox, piece) == 24);

constexpr const char* kCorners = "quad corners";
constexpr const char* kIndices = "quad triangles";
constexpr const char* kBoxes = "strand boxes";

using Kind = engine::PrimitiveSet::Kind;

// The setting that asks for rays, for messages.
const char* askedBy(const Settings& settings) {
    return tracesShadows(settings) ? "/shading/shadows/hair: rays" : "/strands/backend: rays";
}

RaysGeometry geometryOf(const Settings& settings) {
    const std::optional<RaysGeometry> geometry = tracedGeometry(settings);
    assert(geometry);
    return *geometry;
}

// A box, or two triangles, for each piece of a strand at the finest level of detail, and two
// corners for each point.
engine::PrimitiveSet primitivesOf(const Settings& settings, const StrandPlan& plan) {
    const bool has_boxes = geometryOf(settings) == RaysGeometry::boxes;
    const std::uint64_t pieces = plan.strands() * plan.segments * plan.forced_tessellation;
    const std::uint64_t vertices =
        has_boxes ? 0 : 2 * plan.strands() * pointsPerStrand(settings.strands, plan);
    constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
    if (6 * pieces > kMost || vertices > kMost)
        throw engine::Unsupported(
            askedBy(settings),
            std::to_string(pieces) + " pieces of strands are too many for 32-bit indices");
    return {
        .kind = has_boxes ? Kind::boxes : Kind::triangles,
        .count = static_cast<std::uint32_t>(has_boxes ? pieces : 2 * pieces),
        .vertices = static_cast<std::uint32_t>(vertices),
        .box_stride = sizeof(gpu::StrandBox),
        .is_opaque = !plan.merged_hairs,  // which have gaps
        .rebuild = settings.strands.rays.update == RaysUpdate::build ? engine::Rebuild::anew
                                                                     : engine::Rebuild::refit};
}

engine::MemoryRows primitiveRows(const engine::PrimitiveSet& of) {
    if (of.kind == Kind::boxes)
        return {"acceleration", {{kBoxes, engine::bytesOf<gpu::StrandBox>(of.count)}}};
    return {
        "acceleration",
        {{kCorners, engine::bytesOf<glm::vec3>(of.vertices)},
         {kIndices, engine::bytesOf<std::uint32_t>(std::uint64_t{3} * of.count)}}};
}

// The corners of each piece's triangles, in the order in which `expanded` draws them.
std::vector<std::uint32_t> triangleIndices(const StrandSettings& strands, const StrandPlan& plan) {
    const bool split = strands.taper == Taper::segment;
    const auto points = static_cast<std::uint32_t>(pointsPerStrand(strands, plan));
    const std::uint32_t ends = plan.forced_tessellation + (split ? 1 : 0);  // of a segment
    std::vector<std::uint32_t> indices;
    indices.reserve(std::size_t{6} * plan.strands() * plan.segments * plan.forced_tessellation);
    for (std::uint32_t strand = 0; strand < plan.strands(); ++strand)
        for (std::uint32_t segment = 0; segment < plan.segments; ++segment)
            for (std::uint32_t piece = 0; piece < plan.forced_tessellation; ++piece) {
                const std::uint32_t first = 2 * (strand * points + segment * ends + piece);
                for (const std::uint32_t corner : {0u, 1u, 2u, 1u, 3u, 2u})
                    indices.push_back(first + corner);
            }
    return indices;
}

engine::ComputeDescription
primitivesStage(const engine::Device& device, const Settings& settings, const StrandPlan& plan) {
    engine::Constants constants = pointsConstants(settings.strands, plan);
    constants.emplace_back(gpu::kGroupConstant, strandGroup(device));
    const std::string shader = geometryOf(settings) == RaysGeometry::boxes
                                   ? "strands/rays/boxes.comp"
                                   : "strands/rays/corners.comp";
    return {
        .shader = readsPairs(device) ? shader + "+packed" : shader,
        .constants = constants,
        .push_size = sizeof(gpu::PrimitivesPush)};
}

// Throws as StrandStructure::check() does.
engine::PrimitiveSet
checkedPrimitives(const engine::Device& device, const Settings& settings, const StrandPlan& plan) {
    StrandStructure::check(device, settings, plan);
    return primitivesOf(settings, plan);
}

}  // namespace

std::optional<RaysGeometry> tracedGeometry(const Settings& settings) {
    if (tracesShadows(settings)) return RaysGeometry::boxes;  // quads face the eye, not the light
    if (!settings.render.hair || settings.strands.backend != Backend::rays) return std::nullopt;
    return settings.strands.rays.geometry;
}

void StrandStructure::check(
    const engine::Device& device, const Settings& settings, const StrandPlan& plan) {
    device.require(engine::Feature::ray_queries, askedBy(settings));
    engine::AccelerationStructure::rows(device, primitivesOf(settings, plan));
}

engine::MemoryRows StrandStructure::rows(
    const engine::Device& device, const Settings& settings, const StrandPlan& plan) {
    if (!device.has(engine::Feature::ray_queries)) return {};
    const engine::PrimitiveSet primitives = primitivesOf(settings, plan);
    engine::MemoryRows rows = primitiveRows(primitives);
    rows.add(engine::AccelerationStructure::rows(device, primitives));
    return rows;
}

StrandStructure::StrandStructure(
    const engine::Device& device, const Settings& settings, const StrandPlan& plan,
    const PointsPass& points)
    : points_(points), geometry_(geometryOf(settings)),
      leaves_out_(
          settings.strands.rays.update == RaysUpdate::build &&
          engine::AccelerationStructure::leavesOutNan(device)),
      group_(strandGroup(device)), structure_(device, checkedPrimitives(device, settings, plan)),
      stage_(device, primitivesStage(device, settings, plan)) {
    const engine::PrimitiveSet primitives = primitivesOf(settings, plan);
    const engine::MemoryRows rows = primitiveRows(primitives);
    invocations_ = hasBoxes() ? primitives.count : primitives.vertices / 2;
    primitives_ = {device, rows[hasBoxes() ? kBoxes : kCorners]};
    if (!hasBoxes())
        indices_ =
            engine::makeBuffer(device, triangleIndices(settings.strands, plan), rows, kIndices);
}

void StrandStructure::tracesLight(engine::Commands& commands, Tracer tracer) const {
    using engine::Access;
    const bool computes = tracer == Tracer::compute;
    const Access reads = computes ? Access::compute_read : Access::fragment_read;
    structure_.traces(commands, computes ? Access::trace_read : Access::fragment_trace);
    commands.uses({{boxes(), reads}, {points_.points(), reads}});
}

void StrandStructure::describe(gpu::ShadowParameters& shadows) const {
    assert(hasBoxes());
    shadows.structure = structure_.address();
    shadows.points = points_.points().address();
    shadows.boxes = boxes().address();
}

void StrandStructure::record(engine::Commands& commands, const StrandPicture& picture) {
    commands.bind(
        stage_, gpu::PrimitivesPush{
                    .picture = picture.address,
                    .points = commands.reads(points_.points()),
                    .pieces = commands.reads(points_.pieces()),
                    .primitives = commands.writes(primitives_),
                    .invocations = invocations_,
                    .strands = points_.strandCount(picture.parameters),
                    .leaves_out = leaves_out_});
    commands.dispatchInvocations(invocations_, group_);
    structure_.build(commands, primitives_, hasBoxes() ? nullptr : &indices_);
}

}  // namespace hair::rendering
