#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "engine/pipeline.h"
#include "hair/gpu_structs.h"
#include "hair/settings.h"
#include "hair/simulation/guide_view.h"

namespace hair::simulation {

// The hand of a pull during a time step.
struct Hand {
    glm::dvec3 position;  // at the end of the step, m
    glm::dvec3 velocity;  // mean over the step, m/s
};

// Returns the hand in the time step from `from` to `to` (s); none if it does not pull. It pulls in
// steps with a middle between its first and last key, that is for most of each of these steps. So
// keys at multiples of the step work as written, however they are rounded. Before its first key and
// after its last, the hand is at that key's position.
//
// The implicit spring needs the hand's position at the end of the step. It uses the mean velocity,
// not the path's velocity at one time, because keys may be much closer than steps, and the path
// between them may be arbitrarily fast.
std::optional<Hand> handIn(const PullSettings& pull, double from, double to);

// Throws Error for pulls (/simulation/pulls/N) at missing vertices, and for keys with times that
// don't ascend.
void checkPulls(
    std::span<const PullSettings> pulls, std::uint32_t guides, std::uint32_t vertices_per_guide);

// Adds the acceleration of every guide vertex by the hands to GuideAddresses::accelerations, for a
// whole time step.
//
// A critically damped spring with the stiffness k and the damping c = 2 sqrt(k) holds vertex x at
// the hand h. Its acceleration a of x follows implicit Euler, which is stable for every k and time
// step dt: from the states of vertex and hand at the end of the step,
//     a = k (h' - x') + c (w - v'),   v' = v + dt (f + a),   x' = x + dt v',
// with the hand's velocity w and the known acceleration f: gravity and the buffer's contents. Hence
//     a = (k (h' - x - dt (v + dt f)) + c (w - v - dt f)) / (1 + c dt + k dt^2).
// At rest f + a = 0 and h - x = -f / k: the spring's own equilibrium, whatever the step.
//
// A vertex at a rest distance d from x gets a exp(-(d / radius)^2). With radius 0, only x gets a.
//
// Hands pull one after the other, each on the buffer that the earlier ones left. So a vertex held
// by several hands goes to their common equilibrium, and no further.
class PullPass {
public:
    // `pulls` must have passed checkPulls.
    PullPass(
        const engine::Device& device, std::uint32_t strand_count, std::uint32_t vertices_per_strand,
        const gpu::Step& step, std::vector<PullSettings> pulls);

    // `pulls` must have passed checkPulls.
    void setPulls(std::vector<PullSettings> pulls) noexcept { pulls_ = std::move(pulls); }

    // Records the time step that starts at `time`. Orders its work after earlier compute work. The
    // caller orders later work.
    void record(engine::Commands& commands, const GuideAddresses& guides, double time) const;

private:
    std::uint32_t vertex_count_;
    std::uint32_t vertices_per_strand_;
    gpu::Step step_;
    std::vector<PullSettings> pulls_;
    engine::Buffer held_;  // vec4: acceleration of the held vertex
    engine::ComputePipeline hold_;
    engine::ComputePipeline spread_;
};

}  // namespace hair::simulation
