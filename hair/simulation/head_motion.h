#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/ext/quaternion_double.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "hair/gpu_structs.h"
#include "hair/groom/groom.h"
#include "hair/groom/mesh/deforming_mesh.h"
#include "hair/settings.h"

namespace hair::simulation {

// x -> rotation x + translation, from the groom's frame to the present position.
struct RigidMotion {
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  // unit length
    glm::dvec3 translation{0.0};              // m

    glm::dvec3 operator()(const glm::dvec3& point) const { return rotation * point + translation; }
};

inline glm::mat4 toMatrix(const RigidMotion& motion) {
    glm::dmat4 matrix = glm::mat4_cast(motion.rotation);
    matrix[3] = glm::dvec4(motion.translation, 1.0);
    return matrix;
}

inline gpu::RigidFrame toGpu(const RigidMotion& motion) {
    const glm::dquat& q = motion.rotation;
    return {.rotation = {q.x, q.y, q.z, q.w}, .translation = motion.translation};
}

// The head's pose over simulated time. Every angle and coordinate of the keyframes has its own
// curve, as in animation programs: a cubic Hermite spline with the slopes of Fritsch and Butland
// 1984, A method for constructing local monotone piecewise cubic interpolants, that is the harmonic
// mean of the slopes to the neighbours, weighted by the spans. Velocities never jump. Between two
// keyframes the head stays in their range, so between equal keyframes it holds still. Before the
// first keyframe and after the last it rests, and it starts and ends gently. Repeating motion
// continues without a halt if the last pose equals the first, or differs by whole turns; its very
// first start is gentle if the first keyframe is a turning point. Without keyframes the head never
// moves.
class HeadMotion {
public:
    // Throws Error (/simulation/motion/keyframes/N/time) if times don't ascend.
    explicit HeadMotion(const MotionSettings& settings);

    // `time`: s.
    RigidMotion at(double time) const;
    // Returns the pose as a keyframe at that time. Angles may exceed whole turns.
    Keyframe keyframeAt(double time) const;

private:
    MotionSettings settings_;
};

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

    static engine::MemoryRows rows(std::uint64_t guides, std::uint32_t substeps) {
        return {
            "simulation",
            {{"guide root frames",
              engine::bytesOf<gpu::RigidFrame>(guides * (std::uint64_t{substeps} + 1))}}};
    }

    // Returns how the mesh alone has moved the roots since rest, at a simulated time, s: [guide].
    std::vector<RigidMotion> at(double time) const;
    // Returns the mean of these motions, for code that needs one motion of the head.
    RigidMotion meanAt(double time) const;

    // Writes the roots' frames at the start of each substep and at the end of the last. The
    // `substeps`, at most as many as in a step, divide the time from `from` to `to` (s) evenly.
    // `head` moves the deformed mesh. Returns the head's mean motions at these times, valid until
    // the next call.
    std::span<const RigidMotion> record(
        engine::Commands& commands, const HeadMotion& head, std::uint32_t substeps, double from,
        double to) const;

    // Address of gpu::RigidFrame [guide] at the start of a substep, or at the end of the one
    // before.
    std::uint64_t address(std::uint32_t substep) const;

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
