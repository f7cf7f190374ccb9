#include "hair/rendering/blends.h"

namespace hair {

namespace {

// For strands whose primitives are discarded before they are rasterised: they touch no attachment,
// and none may be there that their pipeline does not name. The target is rendered to without them,
// so that its share of the pass is the same as in other pictures.
class DiscardedBlend : public StrandBlend {
public:
    StrandOutput output() const override { return {.depth_format = VK_FORMAT_UNDEFINED}; }

    void record(
        engine::Passes& passes, const engine::Target& target,
        const std::function<void(engine::Commands&)>& draw) const override {
        passes.pass("strands", engine::PassKind::graphics, [&](engine::Commands& commands) {
            target.beginRendering(commands, engine::Load::keep, {});
            target.endRendering(commands);
            const VkRect2D area{{0, 0}, target.color().extent()};
            engine::beginRendering(commands, {}, std::nullopt, area);
            draw(commands);
            engine::endRendering(commands);
        });
    }
};

}  // namespace

std::unique_ptr<StrandBlend> makeDiscardedBlend() { return std::make_unique<DiscardedBlend>(); }

}  // namespace hair
