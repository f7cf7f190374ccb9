#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "engine/commands.h"
#include "engine/device.h"
#include "engine/pipeline.h"
#include "hair/gpu_structs.h"
#include "hair/rendering/strand_backend.h"
#include "hair/rendering/strand_plan.h"
#include "hair/settings.h"

namespace hair::rendering {

// Sizes of the back end `mesh` for a device.
struct MeshSizes {
    std::uint32_t points = 0;  // most points of strands per mesh work group
    std::uint32_t task_group = 0;  // invocations per task work group; each takes a block
    std::uint32_t mesh_group = 0;  // invocations per mesh work group
};

// Returns the largest sizes that the device supports and prefers. On a processor, groups are no
// larger than the vector of invocations that it runs at a time. Throws engine::Unsupported if the
// device's limits are too small for the shaders.
MeshSizes meshSizes(const engine::DeviceInfo& device);

// Returns the number of blocks of strands that mesh work groups draw at the finest level of detail.
// Throws engine::Unsupported for more than shaders can number.
std::uint32_t countBlocks(const StrandPlan& plan, Taper taper, std::uint32_t points);

// Draws strands by task and mesh stages. The task stage culls the blocks of strands that the
// picture can't show or the level of detail doesn't draw. The mesh stage evaluates each point of
// the others once and makes their quads.
class MeshBackend : public StrandBackend {
public:
    // Throws engine::Unsupported for features or limits that the device lacks.
    explicit MeshBackend(const BackendContext& context);

    // Throws as the constructor does, without making the back end.
    static void
    check(const engine::Device& device, const Settings& settings, const StrandPlan& plan);

    engine::PassKind passKind() const override { return engine::PassKind::meshes; }
    void draw(engine::Commands& commands, const StrandPicture& picture) const override;
    std::string variant() const override;
    std::optional<ExpectedCounts> expected() const override { return std::nullopt; }

private:
    MeshSizes sizes_;
    StrandPlan plan_;
    Taper taper_;
    engine::GraphicsPipeline pipeline_;
};

}  // namespace hair::rendering
