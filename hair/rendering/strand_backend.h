#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "engine/commands.h"
#include "hair/rendering/strand_plan.h"
#include "hair/settings.h"

namespace hair {

// Draws all strands of a picture into the target that is being rendered to. Every back end draws
// the same strands; they differ in the pipeline stages that make them.
class StrandBackend {
public:
    virtual ~StrandBackend() = default;

    // `picture` is the device address of the picture's gpu::PictureParameters.
    virtual void draw(engine::Commands& commands, std::uint64_t picture) const = 0;

    // What the pipeline statistics of draw() must be; absent where the back end has no such stages.
    virtual std::optional<ExpectedCounts> expected() const = 0;
};

struct BackendContext {
    const engine::Device& device;
    const StrandPlan& plan;
    const StrandSettings& strands;
    std::uint32_t samples;  // of the target
};

std::unique_ptr<StrandBackend> makeBackend(Backend backend, const BackendContext& context);

}  // namespace hair
