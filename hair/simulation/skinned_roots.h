#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "hair/gpu_structs.h"
#include "hair/groom/groom.h"
#include "hair/groom/mesh/deforming_mesh.h"
#include "hair/simulation/head_motion.h"

namespace hair::simulation {

// `after` of what `before` has moved.
RigidMotion operator*(const RigidMotion& after, const RigidMotion& before);

// The guides' roots where an animation deforms the mesh that they grow on: each is bound to a
// triangle, and moves as that does. Solvers take them from the device, where the frames of the ends
// of all of a step's substeps lie. Borrows the mesh.
class SkinnedRoots {
public:
    // `substeps` in a step.
    SkinnedRoots(
        const engine::Device& device, const groom::Groom& groom, const groom::DeformingMesh& mesh,
        std::uint32_t substeps);

    // How the mesh alone has moved roots since rest at a simulated time, s: [guide].
    std::vector<RigidMotion> at(double time) const;
    // The motion in the middle of them, which the head has for those who know of one motion alone.
    RigidMotion meanAt(double time) const;

    // Writes the frames of roots at the start of the substeps that divide the time between `from`
    // and `to`, s, evenly, and at the end of the last one; `substeps` of them, not more than in a
    // step. `head` moves the deformed mesh. After all who read the frames of the step before, in
    // compute; they are then visible to compute. Returns the head's mean motions at these times,
    // there until the next call.
    std::span<const RigidMotion> record(
        engine::Commands& commands, const HeadMotion& head, std::uint32_t substeps, double from,
        double to) const;

    // gpu::RigidFrame [guide] at the start of a substep, or at the end of the one before.
    std::uint64_t address(std::uint32_t substep) const;
    const engine::Buffer& frames() const { return frames_; }

private:
    // There until the next call.
    std::span<const groom::SurfaceMotion> motionsAt(double time) const;

    // Kept, so that a step takes no memory anew.
    struct Work {
        groom::DeformingMesh::Scratch scratch;
        std::vector<groom::SurfaceMotion> motions;  // [guide]
        std::vector<RigidMotion> means;  // [substep, and one more]
        std::vector<gpu::RigidFrame> frames;  // [substep, and one more][guide]
    };

    const groom::DeformingMesh* mesh_;
    std::vector<glm::vec3> roots_;  // [guide], at rest, m
    std::vector<groom::SurfaceBinding> bindings_;  // [guide]
    mutable Work work_;
    engine::Buffer frames_;  // gpu::RigidFrame [substep, and one more][guide]
};

}  // namespace hair::simulation
