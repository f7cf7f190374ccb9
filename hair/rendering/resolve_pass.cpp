#include "hair/rendering/resolve_pass.h"

#include <bit>
#include <cmath>
#include <string>
#include <vector>

#include "hair/rendering/working_color.h"

namespace hair {

namespace {

constexpr std::uint32_t kGroupSide = 8;  // local size in post/resolve.glsl and post/develop.glsl

engine::ComputeDescription
pipelineFor(const RenderSettings& render, const engine::TargetDescription& target) {
    const std::string variant = target.msaa > 1 ? "_multisample.comp" : ".comp";
    if (!hasLinearLight(render)) {
        return {
            .shader = "post/resolve" + variant,
            .constants = {target.msaa, target.ssaa},
            .sampled_images = 1,
            .storage_images = 1};
    }
    return {
        .shader = "post/develop" + variant,
        .constants =
            {target.msaa, target.ssaa, static_cast<std::uint32_t>(render.tone_map),
             std::bit_cast<std::uint32_t>(std::exp2(render.exposure))},
        .sampled_images = 1,
        .storage_images = 2};
}

}  // namespace

ResolvePass::ResolvePass(
    const engine::Device& device, const RenderSettings& render,
    const engine::TargetDescription& target) {
    if (!hasLinearLight(render) && target.msaa == 1 && target.ssaa == 1) return;
    pipeline_.emplace(device, pipelineFor(render, target));
}

void ResolvePass::record(engine::Commands& commands, const engine::Target& target) const {
    if (!pipeline_) {
        target.copyToOutput(commands);
        return;
    }
    target.beginResolve(commands);
    const std::vector<const engine::Image*> sampled{&target.color()};
    std::vector<const engine::Image*> storage{&target.output()};
    if (target.hasRadiance()) storage.insert(storage.begin(), &target.radiance());
    commands.bind(*pipeline_);
    commands.images(*pipeline_, sampled, storage);
    const auto [width, height] = target.output().extent();
    commands.dispatch(
        (width + kGroupSide - 1) / kGroupSide, (height + kGroupSide - 1) / kGroupSide);
    target.endResolve(commands);
}

}  // namespace hair
