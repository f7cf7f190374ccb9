#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/commands.h"
#include "engine/pipeline.h"
#include "engine/target.h"
#include "hair/rendering/strand_plan.h"
#include "hair/rendering/strand_stages.h"
#include "hair/settings.h"

namespace hair {

// Draws all strands of a picture into the target that is being rendered to. Every back end draws
// the same strands; they differ in the pipeline stages that make them.
class StrandBackend {
public:
    virtual ~StrandBackend() = default;

    // `picture` is the device address of the picture's gpu::PictureParameters; `images` are as many
    // as StrandOutput says.
    virtual void draw(
        engine::Commands& commands, std::uint64_t picture,
        std::span<const engine::SampledImage> images) const = 0;

    // What the pipeline statistics of draw() must be; absent where the back end has no such stages.
    virtual std::optional<ExpectedCounts> expected() const = 0;
};

// What becomes of strands' quads: the last stages of the pipeline and what they write to.
struct StrandOutput {
    std::string geometry = "strands/strand.geom";
    std::string fragment;
    std::vector<engine::ColorTarget> colors;
    VkFormat depth_format = engine::Target::kDepthFormat;
    bool depth_write = true;
    std::uint32_t samples = 1;
    engine::Constants shading;  // shadingConstants
    std::uint32_t sampled_images = 0;
};

struct BackendContext {
    const engine::Device& device;
    const StrandPlan& plan;
    const StrandSettings& strands;
    StrandOutput output;
    StrandStages stages{};
};

// Throws engine::Unsupported for stages that the back end doesn't have.
std::unique_ptr<StrandBackend> makeBackend(Backend backend, const BackendContext& context);

}  // namespace hair
