#include <array>

#include "engine/error.h"
#include "engine/rendering.h"
#include "engine/sampler.h"
#include "engine/transfer.h"
#include "hair/gpu_structs.h"
#include "hair/rendering/blends.h"

namespace hair {

namespace {

// Formats that every device can blend.
constexpr VkFormat kSumFormat = VK_FORMAT_R16G16B16A16_SFLOAT;
constexpr VkFormat kRevealedFormat = VK_FORMAT_R16_SFLOAT;
constexpr std::uint64_t kBytesPerSample = 8 + 2;

engine::Image sumImage(const BlendContext& context, VkFormat format, const char* name) {
    const VkExtent2D extent = context.target.color().extent();
    return {
        context.device,
        {.format = format,
         .width = extent.width,
         .height = extent.height,
         .samples = context.settings.render.msaa,
         .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
         .name = name}};
}

engine::GraphicsDescription composite(const RenderSettings& render) {
    engine::GraphicsDescription description = compositePipeline(
        render,
        render.msaa > 1 ? "composite/weighted_multisample.frag" : "composite/weighted.frag");
    description.sampled_images = 2;
    return description;
}

const engine::Device& checked(const engine::Device& device) {
    if (!device.hasIndependentBlend())
        throw engine::Unsupported("weighted_blended", "the device has no independent blending");
    return device;
}

class WeightedBlend : public StrandBlend {
public:
    explicit WeightedBlend(const BlendContext& context)
        : samples_(context.settings.render.msaa),
          range_(engine::makeBuffer(
              checked(context.device),
              std::span<const gpu::BlendRange>(
                  std::array{gpu::BlendRange{context.view.centre, context.view.radius}}),
              "blend range")),
          sum_(sumImage(context, kSumFormat, "weighted sum")),
          revealed_(sumImage(context, kRevealedFormat, "revealed part")),
          sampler_(context.device, {.filter = VK_FILTER_NEAREST}),
          composite_(context.device, composite(context.settings.render)) {}

    StrandOutput output() const override {
        return {
            .fragment = "strands/weighted.frag",
            .colors =
                {{kSumFormat, engine::Blend::add}, {kRevealedFormat, engine::Blend::attenuate}},
            .depth_write = false,
            .samples = samples_};
    }

    void record(
        engine::Passes& passes, const engine::Target& target,
        const std::function<void(engine::Commands&)>& draw) const override {
        passes.pass("strands", engine::PassKind::graphics, [&](engine::Commands& commands) {
            sumUp(commands, target, draw);
        });
        passes.pass("composite", engine::PassKind::graphics, [&](engine::Commands& commands) {
            blend(commands, target);
        });
    }

    std::uint64_t fragments() const override { return range_.address(); }

    std::uint64_t bytes() const override {
        return kBytesPerSample * samples_ * sum_.extent().width * sum_.extent().height;
    }

private:
    void sumUp(
        engine::Commands& commands, const engine::Target& target,
        const std::function<void(engine::Commands&)>& draw) const {
        for (const engine::Image* image : {&sum_, &revealed_}) {
            commands.transition(
                *image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                engine::Access::graphics_read, engine::Access::attachment);
        }
        commands.barrier(engine::Access::attachment, engine::Access::attachment);
        const std::array sums{
            engine::Attachment{.image = &sum_, .load = engine::Load::clear, .clear = {}},
            engine::Attachment{.image = &revealed_, .load = engine::Load::clear, .clear = {1}}};
        engine::beginRendering(commands, sums, engine::Attachment{.image = &target.depth()});
        draw(commands);
        engine::endRendering(commands);
    }

    void blend(engine::Commands& commands, const engine::Target& target) const {
        for (const engine::Image* image : {&sum_, &revealed_}) {
            commands.transition(
                *image, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, engine::Access::attachment,
                engine::Access::graphics_read);
        }
        target.beginRendering(commands, engine::Load::keep, {});
        // One draw for each sample: shading by sample is a feature that not every device has.
        for (std::uint32_t i = 0; i < samples_; ++i) {
            commands.bind(composite_, gpu::CompositePush{.fragments = 0, .sample_index = i});
            commands.images(
                composite_, std::array{
                                engine::SampledImage{&sum_, &sampler_},
                                engine::SampledImage{&revealed_, &sampler_}});
            commands.draw({.vertices = 3});
        }
        target.endRendering(commands);
    }

    std::uint32_t samples_;
    engine::Buffer range_;  // gpu::BlendRange
    engine::Image sum_;
    engine::Image revealed_;
    engine::Sampler sampler_;
    engine::GraphicsPipeline composite_;
};

}  // namespace

std::unique_ptr<StrandBlend> makeWeightedBlend(const BlendContext& context) {
    return std::make_unique<WeightedBlend>(context);
}

}  // namespace hair
