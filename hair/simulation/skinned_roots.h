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

// Applies `before`, then `after`.
RigidMotion operator*(const RigidMotion& after, const RigidMotion& before);

// The guides' roots on a mesh that an animation deforms. Each root is bound to a triangle and moves
// with it. Solvers read the roots' frames on the device, at the ends of all substeps of a step.
// Borrows the mesh.
class SkinnedRoots {
public:
    // `substeps`: per step.
    SkinnedRoots(
        const engine::Device& device, const groom::Groom& groom, const groom::DeformingMesh& mesh,
        std::uint32_t substeps);

    // Returns how the mesh alone has moved the roots since rest, at a simulated time, s: [guide].
    std::vector<RigidMotion> at(double time) const;
    // Returns the mean of these motions, for code that needs one motion of the head.
    RigidMotion meanAt(double time) const;

    // Writes the roots' frames at the start of each substep and at the end of the last. The
    // `substeps`, at most as many as in a step, divide the time from `from` to `to` (s) evenly.
    // `head` moves the deformed mesh. Orders its work after all compute reads of the previous
    // step, and makes the frames visible to compute. Returns the head's mean motions at these
    // times, valid until the next call.
    std::span<const RigidMotion> record(
        engine::Commands& commands, const HeadMotion& head, std::uint32_t substeps, double from,
        double to) const;

    // Address of gpu::RigidFrame [guide] at the start of a substep, or at the end of the one
    // before.
    std::uint64_t address(std::uint32_t substep) const;
    const engine::Buffer& frames() const { return frames_; }

private:
    // Valid until the next call.
    std::span<const groom::SurfaceMotion> motionsAt(double time) const;

    // Kept to avoid allocations in every step.
    struct Work {
        groom::DeformingMesh::Scratch scratch;
        std::vector<groom::SurfaceMotion> motions;  // [guide]
        std::vector<RigidMotion> means;  // [substep + 1]
        std::vector<gpu::RigidFrame> frames;  // [substep + 1][guide]
    };

    const groom::DeformingMesh* mesh_;
    std::vector<glm::vec3> roots_;  // [guide], at rest, m
    std::vector<groom::SurfaceBinding> bindings_;  // [guide]
    mutable Work work_;
    engine::Buffer frames_;  // gpu::RigidFrame [substep + 1][guide]
};

}  // namespace hair::simulation
