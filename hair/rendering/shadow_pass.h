#pragma once

#include <array>
#include <span>
#include <vector>

#include "engine/frame_loop.h"
#include "engine/sampler.h"
#include "hair/gpu_structs.h"
#include "hair/rendering/scene_meshes.h"
#include "hair/rendering/strand_backend.h"
#include "hair/rendering/strand_view.h"
#include "hair/settings.h"

namespace hair {

// What lights see: the depth of meshes, and of hair its depth and opacity in layers (Yuksel and
// Keyser 2008, Deep opacity maps). Each light has a part of an atlas.
class ShadowPass {
public:
    ShadowPass(const engine::Device& device, const Settings& settings, const StrandPlan& plan);

    // The passes "mesh_shadow" and "hair_shadow", where asked for. `picture` is what the camera's
    // picture reads.
    void record(
        engine::Passes& passes, const SceneMeshes& meshes, const StrandView& view,
        const gpu::PictureParameters& picture);

    // Of gpu::ShadowParameters, once recorded.
    std::uint64_t address(std::uint32_t slot) const { return parameters_[slot].address(); }

    // Depth of meshes, depth of hair, opacity of hair, in this order; in SHADER_READ_ONLY_OPTIMAL
    // once recorded. Images of one pixel where there are no such shadows.
    std::span<const engine::SampledImage> images() const { return images_; }

private:
    std::array<engine::Buffer, engine::FrameLoop::kMaxSlots> parameters_;
    std::vector<engine::Image> atlases_;
    engine::Sampler sampler_;
    std::vector<engine::SampledImage> images_;
};

}  // namespace hair
