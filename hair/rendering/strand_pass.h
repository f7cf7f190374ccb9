#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "engine/frame_loop.h"
#include "engine/target.h"
#include "hair/rendering/strand_backend.h"
#include "hair/rendering/strand_blend.h"
#include "hair/rendering/strand_view.h"
#include "hair/settings.h"

namespace hair {

// Draws a picture's strands with the transparency that is asked for: the pass "strands" and, where
// fragments are blended after all are known, "composite".
class StrandPass {
public:
    // `view` has the sphere that the strands can't leave, which weighted_blended goes by. Throws
    // engine::Unsupported for what the device lacks.
    StrandPass(
        const engine::Device& device, const Settings& settings, const StrandPlan& plan,
        const engine::Target& target, const StrandView& view, const StrandStages& stages = {});

    // `images` are the kStrandImages that strands/fragment.glsl samples.
    void record(
        engine::Passes& passes, const engine::Target& target, std::uint64_t picture,
        std::span<const engine::SampledImage> images) const;

    // PictureParameters::fragments.
    std::uint64_t fragments() const { return blend_->fragments(); }

    std::optional<ExpectedCounts> expected() const { return backend_->expected(); }

    const StrandBlend& blend() const { return *blend_; }

private:
    std::unique_ptr<StrandBlend> blend_;
    std::unique_ptr<StrandBackend> backend_;
};

}  // namespace hair
