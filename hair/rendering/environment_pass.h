#pragma once

#include <optional>

#include "engine/buffer.h"
#include "engine/commands.h"
#include "engine/pipeline.h"
#include "hair/rendering/render_assets.h"
#include "hair/settings.h"

namespace hair {

// Light from all around: the background that it is, and what matt surfaces get of it.
// shaders/environment/radiance.glsl says which way its picture lies; /render/environment_turn turns
// it about +y, by the right-hand rule. Where there is no tone map, what is seen of it and what it
// lights are turned into display colours, clipped.
class EnvironmentPass {
public:
    EnvironmentPass(
        const engine::Device& device, const Settings& settings, const RenderAssets& assets);

    // Address of gpu::EnvironmentParameters; 0 where there is no environment.
    std::uint64_t address() const { return parameters_.address(); }

    // Into the target that is being rendered to, behind everything: where nothing is drawn yet.
    // Nothing where there is no environment.
    void draw(engine::Commands& commands, std::uint64_t picture) const;

private:
    engine::Buffer texels_;
    engine::Buffer parameters_;
    std::optional<engine::GraphicsPipeline> background_;
};

}  // namespace hair
