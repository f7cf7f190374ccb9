#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "engine/commands.h"
#include "engine/device.h"
#include "engine/pipeline.h"
#include "hair/gpu_structs.h"
#include "hair/rendering/backends.h"
#include "hair/rendering/strand_plan.h"
#include "hair/settings.h"

namespace hair::rendering {

// How the back end `mesh` is made for a device.
struct MeshSizes {
    std::uint32_t points = 0;  // of strands, that a mesh workgroup may have
    std::uint32_t task_group = 0;  // invocations in a task workgroup, of a block each
    std::uint32_t mesh_group = 0;  // in a mesh workgroup
};

// As large as the device can and likes to have them; on a processor, which runs a vector of
// invocations at a time, no more than that. Throws engine::Unsupported where it can't have what
// every device should.
MeshSizes meshSizes(const engine::DeviceInfo& device);

// Blocks of strands that mesh workgroups draw, at the finest level of detail. Throws
// engine::Unsupported for more than shaders number.
std::uint32_t
countBlocks(const StrandPlan& plan, const StrandSettings& strands, std::uint32_t points);

// Strands by task and mesh stages: the task stage leaves out the blocks of strands that the picture
// can't show or the level of detail doesn't draw, the mesh stage evaluates each point once and
// makes the quads of those that are left.
class MeshBackend : public StrandBackend {
public:
    // Throws engine::Unsupported for what the device can't do.
    explicit MeshBackend(const BackendContext& context);

    // The same of a case, before it is made.
    static void
    check(const engine::Device& device, const Settings& settings, const StrandPlan& plan);

    engine::PassKind passKind() const override { return engine::PassKind::meshes; }
    void draw(engine::Commands& commands, const StrandPicture& picture) const override;
    std::string variant() const override;
    std::optional<ExpectedCounts> expected() const override { return std::nullopt; }

private:
    MeshSizes sizes_;
    gpu::StrandMeshPush push_;  // but for the picture
    std::uint32_t groups_;  // of the task stage
    engine::GraphicsPipeline pipeline_;
};

}  // namespace hair::rendering
