#pragma once

#include <glm/ext/quaternion_double.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "hair/gpu_structs.h"
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

}  // namespace hair::simulation
