#include "hair/rendering/mesh_backend.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <string>

#include "engine/error.h"

namespace hair::rendering {
namespace {

static_assert(offsetof(gpu::StrandMeshPush, blocks) == 8 && sizeof(gpu::StrandMeshPush) == 20);

constexpr const char* kMesh = "/strands/backend: mesh";
constexpr std::uint32_t kMostInvocations = 128;  // the guaranteed minimum, for tasks and meshes
constexpr std::uint32_t kProcessorGroup = 8;

// Memory of a mesh work group: strands/mesh/draw.glsl.
constexpr std::uint32_t kStrandBytes = 80;  // BlockStrand, vectors strided
constexpr std::uint32_t kSharedBytes =
    gpu::kMeshVertices / 4 * kStrandBytes + gpu::kMeshVertices / 2 * 4 * sizeof(glm::vec4);
constexpr std::uint32_t kOutputBytes = gpu::kMeshVertices * 4 * sizeof(glm::vec4);  // strided
constexpr std::uint32_t kPayloadBytes = kMostInvocations * sizeof(std::uint32_t);

MeshSizes sizesFor(const engine::Device& device) {
    device.require(engine::Feature::mesh_shader, kMesh);
    return meshSizes(device.info());
}

std::uint32_t
taskGroups(const engine::Device& device, const MeshSizes& sizes, std::uint32_t blocks) {
    const std::uint32_t groups = divideUp(blocks, sizes.task_group);
    if (groups > device.info().mesh_limits.maxTaskWorkGroupTotalCount)
        throw engine::Unsupported(
            kMesh, std::to_string(blocks) + " blocks of strands are too many for one draw");
    return groups;
}

engine::GraphicsDescription describe(const BackendContext& context, const MeshSizes& sizes) {
    engine::GraphicsDescription description = strandPipeline(context);
    const engine::Constants own{
        {gpu::kMostSegmentsConstant, context.plan.segments},
        {gpu::kMostPiecesConstant, context.plan.forced_tessellation},
        {gpu::kBlockPointsConstant, sizes.points},
        {gpu::kTaskGroupConstant, sizes.task_group},
        {gpu::kMeshGroupConstant, sizes.mesh_group}};
    description.constants.insert(description.constants.end(), own.begin(), own.end());
    const bool to_camera = context.output.quads == QuadKind::camera;
    description.shaders = {
        "strands/mesh/cull.task", to_camera ? "strands/mesh/draw.mesh" : "shadows/strands.mesh",
        context.output.fragment};
    description.push_size = sizeof(gpu::StrandMeshPush);
    return description;
}

}  // namespace

MeshSizes meshSizes(const engine::DeviceInfo& device) {
    const VkPhysicalDeviceMeshShaderPropertiesEXT& limits = device.mesh_limits;
    struct Needed {
        const char* what;
        std::uint32_t there;
        std::uint32_t wanted;
    };
    const std::array needs{
        Needed{"vertices", limits.maxMeshOutputVertices, gpu::kMeshVertices},
        Needed{"triangles", limits.maxMeshOutputPrimitives, gpu::kMeshVertices},
        Needed{"bytes of outputs", limits.maxMeshOutputMemorySize, kOutputBytes},
        Needed{
            "bytes of outputs and payload", limits.maxMeshPayloadAndOutputMemorySize,
            kOutputBytes + kPayloadBytes},
        Needed{"bytes of shared memory", limits.maxMeshSharedMemorySize, kSharedBytes},
        Needed{
            "bytes of shared memory and payload", limits.maxMeshPayloadAndSharedMemorySize,
            kSharedBytes + kPayloadBytes}};
    for (const Needed& need : needs) {
        if (need.there < need.wanted)
            throw engine::Unsupported(
                kMesh, "mesh work groups of the device have " + std::to_string(need.there) + " " +
                           need.what + "; " + std::to_string(need.wanted) + " are needed");
    }
    const std::uint32_t words = std::min(
                                    {limits.maxTaskPayloadSize, limits.maxTaskSharedMemorySize,
                                     limits.maxTaskPayloadAndSharedMemorySize / 2}) /
                                static_cast<std::uint32_t>(sizeof(std::uint32_t));
    const std::uint32_t liked =
        device.type == engine::DeviceType::cpu ? kProcessorGroup : kMostInvocations;
    const auto group = [&](std::initializer_list<std::uint32_t> most) {
        return std::max(std::min(std::min(most), liked), 1u);
    };
    return {
        .points = gpu::kMeshVertices / 2,
        .task_group = group(
            {limits.maxTaskWorkGroupInvocations, limits.maxTaskWorkGroupSize[0],
             limits.maxPreferredTaskWorkGroupInvocations, words}),
        .mesh_group = group(
            {limits.maxMeshWorkGroupInvocations, limits.maxMeshWorkGroupSize[0],
             limits.maxPreferredMeshWorkGroupInvocations})};
}

std::uint32_t countBlocks(const StrandPlan& plan, Taper taper, std::uint32_t points) {
    const std::uint32_t split = taper == Taper::segment ? 1 : 0;
    const std::uint32_t ends = plan.forced_tessellation + split;  // of a segment
    const std::uint32_t whole = points / (plan.segments * ends + 1 - split);
    std::uint64_t blocks = divideUp(plan.forced_density, std::max(whole, 1u));
    blocks *= divideUp(plan.segments, (points - 1 + split) / ends);
    blocks *= plan.triangles;
    if (blocks > std::numeric_limits<std::uint32_t>::max())
        throw engine::Unsupported(
            kMesh, std::to_string(blocks) + " blocks of strands are too many");
    return static_cast<std::uint32_t>(blocks);
}

MeshBackend::MeshBackend(const BackendContext& context)
    : sizes_(sizesFor(context.device)), plan_(context.plan), taper_(context.strands.taper),
      pipeline_(context.device, describe(context, sizes_)) {
    taskGroups(context.device, sizes_, countBlocks(plan_, taper_, sizes_.points));
}

void MeshBackend::check(
    const engine::Device& device, const Settings& settings, const StrandPlan& plan) {
    const MeshSizes sizes = sizesFor(device);
    taskGroups(device, sizes, countBlocks(plan, settings.strands.taper, sizes.points));
}

std::string MeshBackend::variant() const {
    return "workgroups of " + std::to_string(sizes_.task_group) + " tasks, of " +
           std::to_string(sizes_.mesh_group) + " invocations for " + std::to_string(sizes_.points) +
           " points";
}

void MeshBackend::draw(engine::Commands& commands, const StrandPicture& picture) const {
    declareStrands(commands, picture.parameters);
    StrandPlan plan = plan_;
    plan.forced_density = picture.parameters.forced_density;
    const std::uint32_t blocks = countBlocks(plan, taper_, sizes_.points);
    commands.bind(
        pipeline_, gpu::StrandMeshPush{
                       .picture = picture.address,
                       .blocks = blocks,
                       .reach = plan.reach,
                       .greatest_width = plan.greatest_width});
    commands.images(pipeline_, picture.images);
    commands.drawMeshTasks(divideUp(blocks, sizes_.task_group));
}

}  // namespace hair::rendering
