#include <limits>

#include "engine/error.h"
#include "hair/gpu_structs.h"
#include "hair/rendering/backends.h"

namespace hair {

namespace {

class PullingGeometryBackend : public StrandBackend {
public:
    explicit PullingGeometryBackend(const BackendContext& context)
        : vertices_(vertexCount(context.plan)), pipeline_(context.device, describe(context)) {}

    void draw(
        engine::Commands& commands, std::uint64_t picture,
        std::span<const engine::SampledImage> images) const override {
        commands.bind(pipeline_, gpu::StrandPush{.picture = picture});
        commands.images(pipeline_, images);
        commands.draw({.vertices = vertices_});
    }

    std::optional<ExpectedCounts> expected() const override { return std::nullopt; }

private:
    static std::uint32_t vertexCount(const StrandPlan& plan) {
        const std::uint64_t count =
            std::uint64_t{2} * plan.patches() * plan.strands_per_patch * plan.forced_tessellation;
        if (count > std::numeric_limits<std::uint32_t>::max()) {
            throw engine::Unsupported(
                "pulling_geometry", std::to_string(count) + " vertices do not fit one draw");
        }
        return static_cast<std::uint32_t>(count);
    }

    static engine::GraphicsDescription describe(const BackendContext& context) {
        engine::GraphicsDescription description = strandPipeline(context);
        description.shaders = {
            "strands/pulling.vert", context.output.geometry, context.output.fragment};
        description.topology = VK_PRIMITIVE_TOPOLOGY_LINE_LIST;
        return description;
    }

    std::uint32_t vertices_;
    engine::GraphicsPipeline pipeline_;
};

}  // namespace

std::unique_ptr<StrandBackend> makePullingGeometryBackend(const BackendContext& context) {
    return std::make_unique<PullingGeometryBackend>(context);
}

}  // namespace hair
