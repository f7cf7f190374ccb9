#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "engine/buffer.h"
#include "engine/commands.h"
#include "engine/pipeline.h"
#include "hair/gpu_structs.h"
#include "hair/settings.h"
#include "hair/simulation/hand.h"

namespace hair {

// The acceleration that hands give every guide vertex, added to a buffer of vec4 [strand][vertex],
// m/s^2, for a whole time step.
//
// A critically damped spring with the stiffness k, c = 2 sqrt(k), holds vertex x at the hand h. The
// acceleration a that it gives x is that of implicit Euler, which is stable for every k and time
// step dt: from where vertex and hand are when the step ends,
//     a = k (h' - x') + c (w - v'),   v' = v + dt (f + a),   x' = x + dt v',
// with the hand's velocity w and the acceleration f that is known already: gravity's, and what is
// in the buffer. It follows
//     a = (k (h' - x - dt (v + dt f)) + c (w - v - dt f)) / (1 + c dt + k dt^2).
// At rest f + a = 0 and h - x = -f / k: the spring's own balance, whatever the step.
//
// A vertex that is at rest d away from x gets a exp(-(d / radius)^2); with radius 0 only x gets a.
//
// Hands pull one after the other, each in the buffer that those before it have left: so a vertex
// that many hold goes where all of them together would have it, and no further.
class PullPass {
public:
    // `pulls` are those that checkPulls has passed.
    PullPass(
        const engine::Device& device, std::uint32_t strand_count, std::uint32_t vertices_per_strand,
        const gpu::Step& step, std::vector<PullSettings> pulls);

    // Other pulls, which checkPulls has passed.
    void setPulls(std::vector<PullSettings> pulls) noexcept { pulls_ = std::move(pulls); }

    // For the time step that begins at `time`. `guides` is the address of gpu::GuideParameters.
    // Orders its work after earlier compute work; the caller orders what comes after.
    void record(
        engine::Commands& commands, std::uint64_t guides, std::uint64_t accelerations,
        double time) const;

private:
    std::uint32_t vertex_count_;
    std::uint32_t vertices_per_strand_;
    gpu::Step step_;
    std::vector<PullSettings> pulls_;
    engine::Buffer held_;  // vec4, the acceleration of the vertex that is held
    engine::ComputePipeline hold_;
    engine::ComputePipeline spread_;
};

}  // namespace hair
