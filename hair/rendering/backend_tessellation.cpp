#include <cassert>

#include "hair/gpu_structs.h"
#include "hair/rendering/backends.h"

namespace hair {

namespace {

// The shaders of the stages up to the last one.
std::vector<std::string> stageShaders(const BackendContext& context) {
    const StrandStages& stages = context.stages;
    const auto path = [&](StrandStage stage, const std::string& file) {
        return (stages.watched == stage ? "strands/watched/" : "strands/") + file;
    };
    std::vector<std::string> shaders{path(StrandStage::vertex, "tessellation.vert")};
    if (stages.last >= StrandStage::evaluation) {
        shaders.emplace_back("strands/tessellation.tesc");
        shaders.push_back(path(StrandStage::evaluation, "tessellation.tese"));
    }
    if (stages.last >= StrandStage::geometry) {
        shaders.push_back(
            stages.watched == StrandStage::geometry ? "strands/watched/strand.geom"
                                                    : context.output.geometry);
    }
    if (stages.last >= StrandStage::fragment) shaders.push_back(context.output.fragment);
    return shaders;
}

class TessellationBackend : public StrandBackend {
public:
    explicit TessellationBackend(const BackendContext& context)
        : plan_(context.plan), watch_(context.stages.watched ? context.stages.watch : 0),
          draws_(planDraws(
              context.plan, context.strands.submission, context.device.maxTessellatedVertices())),
          pipeline_(context.device, describe(context)) {
        assert(watch_ != 0 || !context.stages.watched);
    }

    void draw(
        engine::Commands& commands, std::uint64_t picture,
        std::span<const engine::SampledImage> images) const override {
        if (watch_ != 0)
            commands.bind(pipeline_, gpu::WatchedPush{.picture = picture, .watch = watch_});
        else
            commands.bind(pipeline_, gpu::StrandPush{.picture = picture});
        commands.images(pipeline_, images);
        for (const engine::Draw& draw : draws_) commands.draw(draw);
    }

    std::optional<ExpectedCounts> expected() const override { return expectedCounts(plan_); }

private:
    static engine::GraphicsDescription describe(const BackendContext& context) {
        engine::GraphicsDescription description = strandPipeline(context);
        description.shaders = stageShaders(context);
        if (context.stages.last == StrandStage::vertex) {
            description.topology = VK_PRIMITIVE_TOPOLOGY_POINT_LIST;
        } else {
            description.topology = VK_PRIMITIVE_TOPOLOGY_PATCH_LIST;
            description.patch_control_points = 1;
        }
        return description;
    }

    StrandPlan plan_;
    std::uint64_t watch_;
    std::vector<engine::Draw> draws_;
    engine::GraphicsPipeline pipeline_;
};

}  // namespace

std::unique_ptr<StrandBackend> makeTessellationBackend(const BackendContext& context) {
    return std::make_unique<TessellationBackend>(context);
}

}  // namespace hair
