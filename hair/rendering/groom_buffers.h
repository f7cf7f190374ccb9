#pragma once

#include <cstdint>

#include "engine/buffer_image.h"
#include "engine/device.h"
#include "hair/groom/groom.h"
#include "hair/groom/groom_size.h"
#include "hair/groom/mesh/deforming_mesh.h"
#include "hair/rendering/strand_view.h"
#include "hair/settings.h"

namespace hair::rendering {

// The constant data of a groom on the device, for rendering.
class GroomBuffers {
public:
    // `model` is the file that settings.strands.offsets names, null if that is empty. `deforming`
    // is the mesh under the hair if an animation deforms it; it must outlive the buffers. Throws
    // engine::Error as checkStrands and makeStrandOffsets do.
    GroomBuffers(
        const engine::Device& device, const groom::Groom& groom, const Settings& settings,
        const groom::StrandSet* model, const groom::DeformingMesh* deforming = nullptr);

    // If the groom is not known, its offsets are estimated.
    static engine::MemoryRows rows(const Settings& settings, const groom::GroomSize& size);

    // Lacks the guides' address and the head's motion.
    const StrandView& view() const { return view_; }

private:
    engine::Buffer root_triangles_;
    engine::Buffer root_normals_;
    engine::Buffer widths_;
    engine::Buffer bound_strands_;  // gpu::BoundStrand
    engine::Buffer group_shades_;
    engine::Buffer root_pattern_;
    engine::Buffer root_frames_;  // gpu::RootFrame
    engine::Buffer offsets_;
    engine::Buffer residuals_;
    engine::Buffer rest_tangents_;
    engine::Buffer rest_guides_;
    StrandView view_;
};

// Checks that the groom has the data that the settings need. Throws engine::Error "<JSON pointer>:
// <reason>".
void checkStrands(const StrandSettings& settings, const groom::Groom& groom);

}  // namespace hair::rendering
