#pragma once

#include <cstdint>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "hair/groom/mesh/deforming_mesh.h"

namespace hair::rendering {

// The hair as rendering sees it: the guides now, and the strands between them. The simulation and
// GroomBuffers fill it in; the renderer never includes the simulation. Addresses are device
// addresses.
struct StrandView {
    std::uint64_t guides = 0;  // vec4 [guide][vertex], m, root first
    std::uint64_t root_triangles = 0;  // uint [triangle][3], guide indices
    std::uint64_t root_normals = 0;  // vec3 [guide], unit length; 0: not known
    std::uint64_t guide_widths = 0;  // float [guide][vertex], m; 0: not known
    std::uint64_t bound_strands = 0;  // gpu::BoundStrand [strand], in the order in which levels of
                                      // detail keep them; 0: not drawn
    std::uint64_t contacts = 0;  // vec4 [guide][vertex]: w > 0 from the first vertex in contact
                                 // with a body on; 0: not known
    std::uint64_t bodies = 0;  // gpu::Bodies: what hair collides with; 0: not known
    std::uint64_t root_pattern = 0;  // vec2 [strand]; 0: root triangles have patterns of their own
    std::uint64_t root_frames = 0;  // gpu::RootFrame [guide]; 0: strands are not offset
    std::uint64_t offsets = 0;  // StrandOffsets::values
    std::uint64_t group_shades = 0;  // float [guide or bound strand]; 0: there are no groups
    std::uint64_t residuals = 0;  // StrandResiduals::samples; 0: bound strands have none
    std::uint64_t rest_tangents = 0;  // vec3 [guide][vertex], restTangents(); 0: without residuals
    glm::vec3 centre{0.0f};  // of the strands' bounding sphere, m, before the head's motion
    float radius = 0.0f;  // of that sphere, m
    float offset_reach = 0.0f;  // m, how far offsets move a strand's points
    float greatest_width = 0.0f;  // m, of strands at level 0 of detail
    float greatest_width_scale = 0.0f;  // greatestWidthScale(); 0: any
    glm::mat4 head{1.0f};  // rigid motion of the root normals and of the mesh under the hair, or,
                           // if that deforms, of the scalp on average
    // The mesh under the hair, if it deforms; null: it keeps its shape.
    const groom::DeformingMesh* deforming = nullptr;
    double time = 0.0;  // s, the time of its pose
    glm::dmat4 carried{1.0};  // its rigid motion after deformation
    std::uint64_t rest_guides = 0;  // vec4 [guide][vertex], m; w 0; only with `deforming`
    std::uint32_t guide_count = 0;
    std::uint32_t vertices_per_guide = 0;
    std::uint32_t triangle_count = 0;
    std::uint32_t bound_strand_count = 0;
    std::uint32_t offset_profiles = 0;
    std::uint32_t offset_samples = 0;
};

}  // namespace hair::rendering
