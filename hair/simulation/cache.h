#pragma once

#include <cstdint>
#include <vector>

#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "engine/pipeline.h"
#include "hair/gpu_structs.h"
#include "hair/groom/groom.h"
#include "hair/groom/groom_size.h"
#include "hair/simulation/guide_solver.h"
#include "hair/simulation/head_motion.h"

namespace hair::simulation {

// The interval of a cache's samples that a time lies in.
struct CacheInterval {
    std::size_t before = 0;  // sample
    std::size_t after = 0;  // the next sample; `before` itself at the first or the last
    double fraction = 0.0;  // of the way between them, [0, 1)
};

// `times` must ascend. Before the first and after the last, time stands still.
CacheInterval intervalAt(const std::vector<double>& times, double time);

// Motion of guides from a file: groom::GuideCache. It moves the rest positions, which every solver
// reads: `none` puts guides there, the others hold roots there, and the global shape constraint
// pulls to them. Solvers with goals of their own get these moved by the same way.
//
// If guides follow, every vertex also has a critically damped spring with the stiffness k and the
// damping c = 2 sqrt(k) to its place h in the file, by the equations of PullPass:
//     a = (k (h' - x - dt (v + dt f)) + c (w - v - dt f)) / (1 + c dt + k dt^2)
// with the mean velocity w of h over the step. A vertex that moves with h stays with it.
class CachePass {
public:
    // `rest_positions` (vec4 [strand][vertex]) must live as long as this. `goals` may be null. Both
    // have their values for the groom at rest.
    CachePass(
        const engine::Device& device, const groom::Groom& groom,
        const engine::Buffer& rest_positions, const engine::Buffer* goals);

    // `size` is the groom's. Goals are GuideSolver::goals().
    static engine::MemoryRows rows(const groom::GroomSize& size, bool has_goals);

    bool follows() const { return stiffness_ > 0.0; }

    // Writes the rest positions and goals at a time, s. The caller orders it before and after other
    // compute work.
    void recordRest(engine::Commands& commands, double time) const;

    // Adds the springs' accelerations of a whole step to GuideAddresses::accelerations. The rest
    // positions must be those at its start. Orders its work after earlier compute work. The caller
    // orders later work.
    void recordFollow(
        engine::Commands& commands, const GuideAddresses& guides, const RigidMotion& head_before,
        const RigidMotion& head_after, double to) const;

private:
    gpu::CachePlace placeAt(double time) const;

    std::vector<double> times_;
    std::uint32_t vertex_count_;
    double stiffness_;  // 1/s^2; 0: guides don't follow
    const engine::Buffer* rest_positions_;
    const engine::Buffer* goals_;
    engine::Buffer samples_;  // vec4 [sample][strand][vertex]
    engine::Buffer goal_offsets_;  // vec4 [strand][vertex]; goals from rest positions
    engine::ComputePipeline rest_;
    engine::ComputePipeline follow_;
};

}  // namespace hair::simulation
