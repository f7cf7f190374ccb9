#include "hair/gpu_structs.h"
#include "hair/rendering/backends.h"

namespace hair {

namespace {

class TessellationBackend : public StrandBackend {
public:
    explicit TessellationBackend(const BackendContext& context)
        : plan_(context.plan),
          draws_(planDraws(
              context.plan, context.strands.submission, context.device.maxTessellatedVertices())),
          pipeline_(context.device, describe(context)) {}

    void draw(
        engine::Commands& commands, std::uint64_t picture,
        std::span<const engine::SampledImage> images) const override {
        commands.bind(pipeline_, gpu::StrandPush{.picture = picture});
        commands.images(pipeline_, images);
        for (const engine::Draw& draw : draws_) commands.draw(draw);
    }

    std::optional<ExpectedCounts> expected() const override { return expectedCounts(plan_); }

private:
    static engine::GraphicsDescription describe(const BackendContext& context) {
        engine::GraphicsDescription description = strandPipeline(context);
        description.shaders = {
            "strands/tessellation.vert", "strands/tessellation.tesc", "strands/tessellation.tese",
            context.output.geometry, context.output.fragment};
        description.topology = VK_PRIMITIVE_TOPOLOGY_PATCH_LIST;
        description.patch_control_points = 1;
        return description;
    }

    StrandPlan plan_;
    std::vector<engine::Draw> draws_;
    engine::GraphicsPipeline pipeline_;
};

}  // namespace

std::unique_ptr<StrandBackend> makeTessellationBackend(const BackendContext& context) {
    return std::make_unique<TessellationBackend>(context);
}

}  // namespace hair
