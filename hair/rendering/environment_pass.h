#pragma once

#include <optional>

#include "engine/buffer.h"
#include "engine/commands.h"
#include "engine/pipeline.h"
#include "hair/rendering/render_assets.h"
#include "hair/settings.h"

namespace hair {

// Light from all around: the background that it is, and what matt surfaces get of it.
class EnvironmentPass {
public:
    EnvironmentPass(
        const engine::Device& device, const Settings& settings, const RenderAssets& assets);

    // Of gpu::EnvironmentParameters; 0 where there is no environment.
    std::uint64_t address() const { return 0; }

    // Into the target that is being rendered to, behind everything: where nothing is drawn yet.
    // Nothing where there is no environment.
    void draw(engine::Commands& commands, std::uint64_t picture) const;
};

}  // namespace hair
