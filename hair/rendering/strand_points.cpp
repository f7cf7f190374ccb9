#include "hair/rendering/strand_points.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <optional>
#include <string>

#include "engine/error.h"
#include "engine/pipeline.h"
#include "engine/transfer.h"
#include "hair/rendering/backends.h"
#include "hair/rendering/frames_pass.h"
#include "hair/rendering/picture_parameters.h"
#include "hair/rendering/strand_offsets.h"

namespace hair {

namespace {

using Record = gpu::StrandPointRecord;
static_assert(sizeof(Record) == 32 && offsetof(Record, tangent) == 16);
static_assert(offsetof(gpu::StrandPointsPush, count) == 16);

constexpr std::uint32_t kGroup = 64;               // invocations, as in evaluate.comp
constexpr std::uint32_t kMostGroupsInRow = 65535;  // what every device has

std::uint32_t pointCount(const engine::Device& device, const StrandPlan& plan) {
    const std::uint64_t count = plan.strands() * plan.segments * (plan.forced_tessellation + 1);
    const std::uint64_t limit = device.info().limits.maxStorageBufferRange / sizeof(Record);
    if (count > limit) {
        throw engine::Unsupported(
            "strand points",
            std::to_string(count) + " are over the device's " + std::to_string(limit));
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
    const engine::Device& device, const Settings& settings, const StrandView& view) {
    StrandPoints result{
        .plan = planStrands(view, settings, device.info().limits.maxTessellationGenerationLevel)};
    const std::uint32_t count = pointCount(device, result.plan);
    if (count == 0) return result;

    const engine::ComputePipeline pipeline(
        device, {.shader = "strands/evaluate.comp",
                 .constants = strandConstants(settings.strands, settings.lod.mode),
                 .push_size = sizeof(gpu::StrandPointsPush)});
    const engine::Buffer parameters(
        device, {.size = sizeof(gpu::PictureParameters),
                 .usage = engine::Usage::upload,
                 .name = "picture parameters"});
    const engine::Buffer records(device, {.size = count * sizeof(Record), .name = "strand points"});
    std::optional<FramesPass> frames;
    if (hasOffsets(settings.strands)) frames.emplace(device, view);
    parameters.write(
        pictureParameters(
            settings, result.plan, view,
            {.guide_normals = frames ? frames->normals().address() : 0}));
    device.runOnce([&](engine::Commands& commands) {
        if (frames) frames->record(commands, view);
        commands.bind(
            pipeline,
            gpu::StrandPointsPush{
                .picture = parameters.address(), .records = records.address(), .count = count});
        const std::uint32_t groups = (count + kGroup - 1) / kGroup;
        const std::uint32_t columns = std::min(groups, kMostGroupsInRow);
        commands.dispatch(columns, (groups + columns - 1) / columns);
        commands.barrier(engine::Access::compute_write, engine::Access::transfer_read);
    });
    result.records = engine::downloadAs<Record>(device, records);
    return result;
}

}  // namespace hair
