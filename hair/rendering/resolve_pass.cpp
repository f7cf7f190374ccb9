#include "hair/rendering/resolve_pass.h"

#include <array>
#include <cmath>
#include <span>
#include <string>

#include "hair/gpu_structs.h"
#include "hair/rendering/render_assets.h"
#include "hair/shader_codes.h"

namespace hair::rendering {
namespace {

engine::ComputeDescription
pipelineFor(const RenderSettings& render, const engine::TargetDescription& target) {
    const std::string variant = target.msaa > 1 ? "_multisample.comp" : ".comp";
    engine::Constants constants{
        {gpu::kResolveSamplesConstant, target.msaa}, {gpu::kResolveFactorConstant, target.ssaa}};
    if (!hasLinearLight(render)) {
        return {
            .shader = "post/resolve" + variant,
            .constants = constants,
            .sampled_images = 1,
            .storage_images = 1};
    }
    constants.emplace_back(gpu::kResolveToneMapConstant, shaderCode(render.tone_map));
    constants.emplace_back(gpu::kResolveExposureConstant, std::exp2(render.exposure));
    return {
        .shader = "post/develop" + variant,
        .constants = constants,
        .sampled_images = 1,
        .storage_images = 2};
}

}  // namespace

ResolvePass::ResolvePass(
    const engine::Device& device, const RenderSettings& render,
    const engine::TargetDescription& target) {
    if (engine::resolveOf(target) != engine::Resolve::compute) return;
    pipeline_.emplace(device, pipelineFor(render, target));
}

void ResolvePass::record(engine::Commands& commands, const engine::Target& target) const {
    if (!pipeline_) {
        target.beginRendering(commands, engine::Load::keep, {}, engine::Target::Last::yes);
        target.endRendering(commands, engine::Target::Last::yes);
        return;
    }
    target.beginResolve(commands);
    const engine::Image* const sampled = &target.color();
    commands.bind(*pipeline_);
    if (target.hasRadiance())
        commands.images(
            *pipeline_, std::span(&sampled, 1), std::array{&target.radiance(), &target.output()});
    else
        commands.images(*pipeline_, std::span(&sampled, 1), std::array{&target.output()});
    const auto [width, height] = target.output().extent();
    commands.dispatch(
        (width + gpu::kResolveGroupSide - 1) / gpu::kResolveGroupSide,
        (height + gpu::kResolveGroupSide - 1) / gpu::kResolveGroupSide);
    target.endResolve(commands);
}

}  // namespace hair::rendering
