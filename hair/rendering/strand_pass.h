#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "engine/frame_loop.h"
#include "engine/target.h"
#include "hair/rendering/strand_backend.h"
#include "hair/settings.h"

namespace hair {

// Draws a picture's strands with the transparency that is asked for: the pass "strands" and, where
// fragments are blended after all are known, "composite".
class StrandPass {
public:
    // Throws engine::Unsupported for what the device lacks.
    StrandPass(
        const engine::Device& device, const Settings& settings, const StrandPlan& plan,
        const engine::Target& target);

    // `images` are the kStrandImages that strands/fragment.glsl samples.
    void record(
        engine::Passes& passes, const engine::Target& target, std::uint64_t picture,
        std::span<const engine::SampledImage> images) const;

    // Of gpu::FragmentLists; 0 where fragments are not listed.
    std::uint64_t fragments() const { return 0; }

    std::optional<ExpectedCounts> expected() const { return backend_->expected(); }

private:
    std::unique_ptr<StrandBackend> backend_;
};

}  // namespace hair
