#pragma once

#include <optional>

#include "engine/buffer.h"
#include "engine/pipeline.h"
#include "hair/rendering/render_assets.h"
#include "hair/rendering/strand_view.h"
#include "hair/settings.h"

namespace hair {

// Ribbons over the finished hair: the simulated guides, the root triangles (thesis figures 4.2 and
// 4.6) and the bodies that hair collides with, seen through hair and head.
class OverlayPass {
public:
    OverlayPass(const engine::Device& device, const Settings& settings, const RenderAssets& assets);

    bool empty() const { return !guides_ && !root_triangles_ && !bodies_; }

    // Draws into the target that is being rendered to.
    void draw(engine::Commands& commands, std::uint64_t picture, const StrandView& view) const;

private:
    struct BodyWires {
        engine::Buffer lines;  // gpu::BodyLine
        std::uint32_t line_count;
        engine::GraphicsPipeline pipeline;
    };

    std::optional<engine::GraphicsPipeline> guides_;
    std::optional<engine::GraphicsPipeline> root_triangles_;
    std::optional<BodyWires> bodies_;
};

}  // namespace hair
