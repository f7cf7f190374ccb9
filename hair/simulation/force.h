#pragma once

#include <cstdint>

#include "engine/commands.h"
#include "engine/pipeline.h"
#include "hair/settings.h"
#include "hair/simulation/guide_view.h"

namespace hair::simulation {

// Evaluates the function of /simulation/force at every guide vertex, and adds the acceleration to
// GuideAddresses::accelerations for a whole time step.
class ForcePass {
public:
    // Throws Error if the file was not read or does not compile.
    ForcePass(
        const engine::Device& device, std::uint32_t vertex_count,
        const SimulationSettings& settings);

    // Records the time step that starts at `time`. Orders its work after earlier compute work. The
    // caller orders later work.
    void record(engine::Commands& commands, const GuideAddresses& guides, double time) const;

private:
    std::uint32_t vertex_count_;
    engine::ComputePipeline pipeline_;
};

}  // namespace hair::simulation
