#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "engine/frame_loop.h"
#include "engine/pipeline.h"
#include "hair/gpu_structs.h"
#include "hair/groom/mesh/deforming_mesh.h"
#include "hair/rendering/strand_plan.h"
#include "hair/rendering/strand_view.h"
#include "hair/settings.h"

namespace hair::rendering {

// The mesh under the hair if an animation deforms it, and the roots of drawn strands, each bound to
// the triangle of the mesh that was nearest to it at rest. The simulation moves the roots of
// guides. The roots of strands between guides follow their guides and are then corrected here.
class SkinnedHead {
public:
    // `view` must have a mesh that deforms. Finds the roots at rest on the device and waits.
    SkinnedHead(
        const engine::Device& device, const Settings& settings, const StrandPlan& plan,
        const StrandView& view);

    // Writes the mesh at the view's time. No frame in flight may read the slot.
    void write(std::uint32_t slot, const StrandView& view);

    // vec3 [vertex], in the world; upload buffers.
    const engine::Buffer& positions(std::uint32_t slot) const { return positions_[slot]; }
    const engine::Buffer& normals(std::uint32_t slot) const { return normals_[slot]; }

    // Records the correction of the roots for the draws that follow. The guides and their frames
    // must be up to date and visible to compute. The corrections are then visible to the stages
    // before the rasteriser, and to a PointsPass. `picture` is the address of the
    // gpu::PictureParameters.
    void record(
        engine::Commands& commands, std::uint64_t picture, const gpu::PictureParameters& parameters,
        std::uint32_t slot) const;

    // vec4 [root triangle][strand], m.
    const engine::Buffer& corrections() const { return corrections_; }

private:
    // Kept, so that no picture allocates memory.
    struct Work {
        groom::DeformingMesh::Scratch scratch;
        std::vector<glm::dvec3> positions;  // [vertex], of the mesh, m
        std::vector<glm::vec3> moved;  // [vertex], in the world
        std::vector<glm::vec3> turned;
    };

    std::uint32_t strand_count_;
    Work work_;
    engine::ComputePipeline pipeline_;
    std::array<engine::Buffer, engine::FrameLoop::kMaxSlots> positions_;
    std::array<engine::Buffer, engine::FrameLoop::kMaxSlots> normals_;
    engine::Buffer corrections_;
    engine::Buffer roots_;  // gpu::CarriedRoot [root triangle][strand]
};

}  // namespace hair::rendering
