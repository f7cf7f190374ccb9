#include "hair/rendering/environment_pass.h"

namespace hair {

EnvironmentPass::EnvironmentPass(const engine::Device&, const Settings&, const RenderAssets&) {}

void EnvironmentPass::draw(engine::Commands&, std::uint64_t) const {}

}  // namespace hair
