#pragma once

#include <cstdint>

#include <glm/mat4x4.hpp>

#include "engine/buffer_image.h"
#include "engine/device.h"
#include "hair/groom/groom.h"
#include "hair/groom/groom_size.h"
#include "hair/groom/mesh/deforming_mesh.h"
#include "hair/settings.h"

namespace hair::rendering {

// What rendering knows of the hair: where the guides are now, and what is between them. The
// simulation and GroomBuffers fill it in; the renderer never includes the simulation. Addresses are
// device addresses.
struct StrandView {
    std::uint64_t guides = 0;  // vec4 [guide][vertex], m, root first
    std::uint64_t root_triangles = 0;  // uint [triangle][3], guide indices
    std::uint64_t root_normals = 0;  // vec3 [guide], unit length; 0: not known
    std::uint64_t guide_widths = 0;  // float [guide][vertex], m; 0: not known
    std::uint64_t bound_strands = 0;  // gpu::BoundStrand [strand], in the order in which levels of
                                      // detail keep them; 0: not drawn
    std::uint64_t contacts = 0;  // vec4 [guide][vertex]: w > 0 where in contact with a body and
                                 // at all vertices below; 0: not known
    std::uint64_t bodies = 0;  // gpu::Bodies: what hair collides with; 0: not known
    std::uint64_t root_pattern = 0;  // vec2 [strand]; 0: root triangles have patterns of their own
    std::uint64_t root_frames = 0;  // gpu::RootFrame [guide]; 0: strands are not offset
    std::uint64_t offsets = 0;  // StrandOffsets::values
    std::uint64_t residuals = 0;  // StrandResiduals::samples; 0: bound strands have none
    std::uint64_t rest_tangents = 0;  // vec3 [guide][vertex], restTangents(); 0: without residuals
    glm::vec3 centre{0.0f};  // of a sphere that the strands can't leave, m, before the head moved
    float radius = 0.0f;  // of it
    float offset_reach = 0.0f;  // m, how far offsets move a strand's points
    float greatest_width = 0.0f;  // m, of strands at level 0 of detail
    float greatest_width_scale = 0.0f;  // of levels of detail by distance: strand_plan.h; 0: any
    glm::mat4 head{1.0f};  // rigid motion of the root normals and of the mesh under the hair, or,
                           // where that deforms, of the scalp on average
    // Of a mesh under the hair that deforms; null: it keeps its shape.
    const groom::DeformingMesh* deforming = nullptr;
    double time = 0.0;  // s, that it is seen at
    glm::dmat4 carried{1.0};  // its rigid motion after it has been deformed
    std::uint64_t rest_guides = 0;  // vec4 [guide][vertex], m; w 0; where it deforms
    std::uint32_t guide_count = 0;
    std::uint32_t vertices_per_guide = 0;
    std::uint32_t triangle_count = 0;
    std::uint32_t bound_strand_count = 0;
    std::uint32_t offset_profiles = 0;
    std::uint32_t offset_samples = 0;
};

// What rendering reads of a groom and does not change, on the device.
class GroomBuffers {
public:
    // `model` is what settings.strands.offsets names, null if that is empty; `deforming` is the
    // mesh under the hair where an animation deforms it, and outlives the buffers. Throws
    // engine::Error as checkStrands and makeStrandOffsets do.
    GroomBuffers(
        const engine::Device& device, const groom::Groom& groom, const Settings& settings,
        const groom::StrandSet* model, const groom::DeformingMesh* deforming = nullptr);

    // Lacks the guides' address and the head's motion.
    const StrandView& view() const { return view_; }

private:
    engine::Buffer root_triangles_;
    engine::Buffer root_normals_;
    engine::Buffer widths_;
    engine::Buffer bound_strands_;  // gpu::BoundStrand
    engine::Buffer root_pattern_;
    engine::Buffer root_frames_;  // gpu::RootFrame
    engine::Buffer offsets_;
    engine::Buffer residuals_;
    engine::Buffer rest_tangents_;
    engine::Buffer rest_guides_;
    StrandView view_;
};

// B that GroomBuffers of a groom take at most, and FramesPass for it.
std::uint64_t groomBufferBytes(const Settings& settings, const groom::GroomSize& size);

// Whether the groom has what the strands are to be drawn with. Throws engine::Error
// "<JSON pointer>: <reason>".
void checkStrands(const StrandSettings& settings, const groom::Groom& groom);

}  // namespace hair::rendering
