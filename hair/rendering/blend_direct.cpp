#include "hair/rendering/blends.h"
#include "hair/rendering/target_description.h"

namespace hair {

namespace {

// Fragments go to the target at once.
class DirectBlend : public StrandBlend {
public:
    DirectBlend(const RenderSettings& render, const char* fragment_shader)
        : output_{
              .fragment = fragment_shader,
              .colors = {{colorFormat(render)}},
              .samples = render.msaa} {}

    StrandOutput output() const override { return output_; }

    void record(
        engine::Passes& passes, const engine::Target& target,
        const std::function<void(engine::Commands&)>& draw) const override {
        passes.pass("strands", engine::PassKind::graphics, [&](engine::Commands& commands) {
            target.beginRendering(commands, engine::Load::keep, {});
            draw(commands);
            target.endRendering(commands);
        });
    }

private:
    StrandOutput output_;
};

}  // namespace

std::unique_ptr<StrandBlend> makeOpaqueBlend(const BlendContext& context) {
    return std::make_unique<DirectBlend>(context.settings.render, "strands/strand.frag");
}

std::unique_ptr<StrandBlend> makeShownBlend(const BlendContext& context) {
    return std::make_unique<DirectBlend>(context.settings.render, "strands/strand_show.frag");
}

std::unique_ptr<StrandBlend> makeSampleBlend(const BlendContext& context) {
    return std::make_unique<DirectBlend>(context.settings.render, "strands/samples.frag");
}

}  // namespace hair
