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

// The hand of a pull in a time step.
struct Hand {
    glm::dvec3 position;  // at the step's end, m
    glm::dvec3 velocity;  // its mean over the step, m/s
};

// The hand in the time step between two times, s; null where it does not pull: it pulls in the
// steps whose middle lies between its first and last key, which is most of every such step. So keys
// at multiples of the step mean what they say, however those are rounded. Before its first key and
// after its last the hand is where these are.
//
// The spring is implicit, and asks where the hand is when the step ends. It asks for the mean
// velocity, and not that of the path at one time, because a path may have keys much closer than
// steps, between which it is as fast as one likes.
std::optional<Hand> handIn(const PullSettings& pull, double from, double to);

// Throws Error for pulls (/simulation/pulls/N) at vertices that there are not, and for keys whose
// times don't ascend.
void checkPulls(
    std::span<const PullSettings> pulls, std::uint32_t guides, std::uint32_t vertices_per_guide);

// The acceleration that hands give every guide vertex, added to GuideAddresses::accelerations, for
// a whole time step.
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

    // `pulls` are others that checkPulls has passed.
    void setPulls(std::vector<PullSettings> pulls) noexcept { pulls_ = std::move(pulls); }

    // Records the time step that begins at `time`. Orders its work after earlier compute work; the
    // caller orders what comes after.
    void record(engine::Commands& commands, const GuideAddresses& guides, double time) const;

private:
    std::uint32_t vertex_count_;
    std::uint32_t vertices_per_strand_;
    gpu::Step step_;
    std::vector<PullSettings> pulls_;
    engine::Buffer held_;  // vec4, the acceleration of the vertex that is held
    engine::ComputePipeline hold_;
    engine::ComputePipeline spread_;
};

}  // namespace hair::simulation
