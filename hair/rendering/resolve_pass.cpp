#include "hair/rendering/resolve_pass.h"

#include <array>

#include "hair/rendering/working_color.h"

namespace hair {

namespace {

constexpr std::uint32_t kGroupSide = 8;  // local size in post/resolve.glsl

}  // namespace

ResolvePass::ResolvePass(
    const engine::Device& device, const RenderSettings& render,
    const engine::TargetDescription& target) {
    if (!hasLinearLight(render) && target.msaa == 1 && target.ssaa == 1) return;
    average_.emplace(
        device,
        engine::ComputeDescription{
            .shader = target.msaa > 1 ? "post/resolve_multisample.comp" : "post/resolve.comp",
            .constants = {target.msaa, target.ssaa},
            .sampled_images = 1,
            .storage_images = 1});
}

void ResolvePass::record(engine::Commands& commands, const engine::Target& target) const {
    if (!average_) {
        target.copyToOutput(commands);
        return;
    }
    target.beginResolve(commands);
    const std::array sampled{&target.color()};
    const std::array storage{&target.output()};
    commands.bind(*average_);
    commands.images(*average_, sampled, storage);
    const auto [width, height] = target.output().extent();
    commands.dispatch(
        (width + kGroupSide - 1) / kGroupSide, (height + kGroupSide - 1) / kGroupSide);
    target.endResolve(commands);
}

}  // namespace hair
