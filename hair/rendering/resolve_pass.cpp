#include "hair/rendering/resolve_pass.h"

#include <array>

namespace hair {

namespace {

constexpr std::uint32_t kGroupSide = 8;  // local size in post/resolve.glsl

}  // namespace

ResolvePass::ResolvePass(const engine::Device& device, const engine::TargetDescription& target)
    : pipeline_(device, {.shader = target.msaa > 1 ? "post/resolve_multisample.comp"
                                                   : "post/resolve.comp",
                         .constants = {target.msaa, target.ssaa},
                         .sampled_images = 1,
                         .storage_images = 1}) {}

void ResolvePass::record(engine::Commands& commands, const engine::Target& target) const {
    target.beginResolve(commands);
    const std::array sampled{&target.color()};
    const std::array storage{&target.output()};
    commands.bind(pipeline_);
    commands.images(pipeline_, sampled, storage);
    const auto [width, height] = target.output().extent();
    commands.dispatch((width + kGroupSide - 1) / kGroupSide, (height + kGroupSide - 1) / kGroupSide);
    target.endResolve(commands);
}

}  // namespace hair
