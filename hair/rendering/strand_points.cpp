#include "hair/rendering/strand_points.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>

#include "engine/buffer_image.h"
#include "engine/error.h"
#include "engine/pipeline.h"
#include "engine/transfer.h"
#include "hair/rendering/renderer.h"
#include "hair/rendering/skinned_head.h"
#include "hair/rendering/strand_backend.h"
#include "hair/rendering/strand_offsets.h"

namespace hair::rendering {
namespace {

using Record = gpu::StrandPointRecord;
static_assert(sizeof(Record) == 36 && offsetof(Record, tangent) == 16);
static_assert(offsetof(gpu::StrandPointsPush, count) == 16);

// Shaders number points in 32 bits.
std::uint32_t pointCount(const StrandPlan& plan) {
    const std::uint64_t count = plan.strands() * plan.segments * (plan.forced_tessellation + 1);
    constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
    if (count > kMost) {
        throw engine::Unsupported(
            "strand points", std::to_string(count) + " are too many: at most " +
                                 std::to_string(kMost) + " are supported");
    }
    return static_cast<std::uint32_t>(count);
}

}  // namespace

const Record& StrandPoints::at(
    std::uint32_t triangle, std::uint32_t strand, std::uint32_t segment,
    std::uint32_t point) const {
    assert(
        triangle < plan.triangles && strand < plan.forced_density && segment < plan.segments &&
        point <= plan.forced_tessellation);
    const std::size_t line = std::size_t{triangle} * plan.forced_density + strand;
    return records[(line * plan.segments + segment) * (plan.forced_tessellation + 1) + point];
}

StrandPoints evaluateStrandPoints(
    const engine::Device& device, const Settings& settings, const StrandView& view,
    std::uint32_t most_at_once) {
    assert(most_at_once > 0);
    StrandPoints result{
        .plan = planStrands(view, settings, device.info().limits.maxTessellationGenerationLevel)};
    const std::uint32_t count = pointCount(result.plan);
    if (count == 0) return result;

    const engine::ComputePipeline pipeline(
        device, {.shader = "strands/evaluate.comp",
                 .constants = strandConstants(settings.strands, result.plan),
                 .extensions = strandExtensions(settings.strands),
                 .push_size = sizeof(gpu::StrandPointsPush)});
    const engine::Buffer parameters(
        device, {.size = sizeof(gpu::PictureParameters),
                 .usage = engine::Usage::upload,
                 .name = "picture parameters"});
    const std::uint32_t size = std::min(count, most_at_once);
    const engine::Buffer records(device, {.size = size * sizeof(Record), .name = "strand points"});
    std::optional<FramesPass> frames;
    if (FramesPass::isNeeded(view)) frames.emplace(device, view);
    std::optional<SkinnedHead> skin;
    if (view.deforming) skin.emplace(device, settings, result.plan, view);
    const gpu::PictureParameters picture = pictureParameters(
        settings, result.plan, view,
        {.guide_normals = frames ? frames->normals().address() : 0,
         .guide_turns = frames ? frames->turns().address() : 0,
         .root_corrections = skin ? skin->corrections().address() : 0});
    parameters.write(picture);
    result.records.reserve(count);
    for (std::uint32_t first = 0; first < count; first += std::min(size, count - first)) {
        const std::uint32_t part = std::min(size, count - first);
        runOnce(device, [&](engine::Commands& commands) {
            if (frames && first == 0) {
                frames->record(commands, view);
                commands.barrier(engine::Access::compute_write, engine::Access::compute_read);
            }
            if (skin && first == 0) {
                skin->record(commands, parameters.address(), picture, 0);
                commands.barrier(engine::Access::compute_write, engine::Access::compute_read);
            }
            commands.uses(
                {{view.guides, engine::Access::compute_read},
                 {view.contacts, engine::Access::compute_read},
                 {frames ? frames->normals().address() : 0, engine::Access::compute_read},
                 {frames ? frames->turns().address() : 0, engine::Access::compute_read},
                 {picture.root_corrections, engine::Access::compute_read},
                 {records, engine::Access::compute_write}});
            commands.bind(
                pipeline, gpu::StrandPointsPush{
                              .picture = parameters.address(),
                              .records = records.address(),
                              .count = part,
                              .first = first});
            commands.dispatchInvocations(part, gpu::kStrandPointsGroupSize);
            commands.barrier(engine::Access::compute_write, engine::Access::transfer_read);
        });
        const std::vector<Record> evaluated = engine::downloadAs<Record>(device, records);
        result.records.insert(result.records.end(), evaluated.begin(), evaluated.begin() + part);
    }
    return result;
}

}  // namespace hair::rendering
