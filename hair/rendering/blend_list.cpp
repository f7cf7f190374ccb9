#include <array>

#include "engine/error.h"
#include "engine/rendering.h"
#include "engine/transfer.h"
#include "hair/gpu_structs.h"
#include "hair/rendering/blends.h"

namespace hair {

namespace {

// 4 GiB of nodes: what 32-bit offsets reach.
constexpr std::uint64_t kMostNodes = (std::uint64_t{1} << 32u) / sizeof(gpu::FragmentNode);

std::uint32_t pixelCount(const engine::Target& target) {
    const VkExtent2D extent = target.color().extent();
    return extent.width * extent.height;
}

std::uint32_t capacity(const BlendContext& context) {
    if (!context.device.hasFragmentStores())
        throw engine::Unsupported("fragment_list", "the device's fragments can't store");
    const std::uint64_t nodes =
        std::uint64_t{context.settings.render.list_length} * pixelCount(context.target);
    if (nodes > kMostNodes) {
        throw engine::Unsupported(
            "fragment_list", std::to_string(nodes) + " fragments do not fit 4 GiB");
    }
    return static_cast<std::uint32_t>(nodes);
}

engine::Buffer storage(const engine::Device& device, std::uint64_t bytes, const char* name) {
    return {device, {.size = bytes, .usage = engine::Usage::storage, .name = name}};
}

class ListBlend : public StrandBlend {
public:
    explicit ListBlend(const BlendContext& context)
        : device_(context.device), samples_(context.settings.render.msaa),
          capacity_(capacity(context)),
          heads_(storage(
              device_, sizeof(std::uint32_t) * pixelCount(context.target), "fragment heads")),
          nodes_(storage(device_, sizeof(gpu::FragmentNode) * capacity_, "fragment nodes")),
          counter_(storage(device_, sizeof(std::uint32_t), "fragment counter")),
          lists_(engine::makeBuffer(
              device_,
              std::span<const gpu::FragmentLists>(std::array{gpu::FragmentLists{
                  .heads = heads_.address(),
                  .nodes = nodes_.address(),
                  .counters = counter_.address(),
                  .capacity = capacity_,
                  .width = context.target.color().extent().width}}),
              "fragment lists")),
          composite_(device_, compositePipeline(context.settings.render, "composite/list.frag")) {}

    StrandOutput output() const override {
        return {.fragment = "strands/list.frag", .depth_write = false, .samples = samples_};
    }

    void record(
        engine::Passes& passes, const engine::Target& target,
        const std::function<void(engine::Commands&)>& draw) const override {
        passes.pass("strands", engine::PassKind::graphics, [&](engine::Commands& commands) {
            list(commands, target, draw);
        });
        passes.pass("composite", engine::PassKind::graphics, [&](engine::Commands& commands) {
            commands.barrier(engine::Access::fragment_write, engine::Access::graphics_read);
            target.beginRendering(commands, engine::Load::keep, {});
            commands.bind(
                composite_, gpu::CompositePush{.fragments = fragments(), .sample_index = 0});
            commands.draw({.vertices = 3});
            target.endRendering(commands);
        });
    }

    std::uint64_t fragments() const override { return lists_.address(); }

    std::uint64_t bytes() const override {
        return heads_.size() + nodes_.size() + counter_.size() + lists_.size();
    }

    std::optional<ListedFragments> listed() const override {
        return ListedFragments{
            .capacity = capacity_,
            .wanted = engine::downloadAs<std::uint32_t>(device_, counter_).front()};
    }

private:
    void list(
        engine::Commands& commands, const engine::Target& target,
        const std::function<void(engine::Commands&)>& draw) const {
        // After the last picture's passes.
        commands.barrier(engine::Access::fragment_write, engine::Access::transfer_write);
        commands.fill(heads_, gpu::kNoFragment);
        commands.fill(counter_, 0);
        commands.barrier(engine::Access::transfer_write, engine::Access::fragment_write);
        commands.barrier(engine::Access::attachment, engine::Access::attachment);
        engine::beginRendering(commands, {}, engine::Attachment{.image = &target.depth()});
        draw(commands);
        engine::endRendering(commands);
    }

    const engine::Device& device_;
    std::uint32_t samples_;
    std::uint32_t capacity_;  // nodes
    engine::Buffer heads_;
    engine::Buffer nodes_;
    engine::Buffer counter_;
    engine::Buffer lists_;  // gpu::FragmentLists
    engine::GraphicsPipeline composite_;
};

}  // namespace

std::unique_ptr<StrandBlend> makeListBlend(const BlendContext& context) {
    return std::make_unique<ListBlend>(context);
}

}  // namespace hair
