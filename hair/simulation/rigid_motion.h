#pragma once

#include <glm/ext/quaternion_double.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "hair/gpu_structs.h"

namespace hair {

// x -> rotation x + translation: from where the groom was made to where it is now.
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

}  // namespace hair
