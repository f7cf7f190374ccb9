#pragma once

#include <optional>

#include "engine/pipeline.h"
#include "hair/rendering/strand_view.h"
#include "hair/settings.h"

namespace hair {

// Ribbons over the finished hair: the simulated guides and the root triangles (thesis figures 4.2
// and 4.6).
class OverlayPass {
public:
    OverlayPass(const engine::Device& device, const Settings& settings);

    bool empty() const { return !guides_ && !root_triangles_; }

    // Draws into the target that is being rendered to.
    void draw(engine::Commands& commands, std::uint64_t picture, const StrandView& view) const;

private:
    std::optional<engine::GraphicsPipeline> guides_;
    std::optional<engine::GraphicsPipeline> root_triangles_;
};

}  // namespace hair
