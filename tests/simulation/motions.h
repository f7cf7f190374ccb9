#pragma once

#include <span>
#include <vector>

#include "hair/settings.h"
#include "hair/simulation/head_motion.h"

namespace hair::simulation {

// Neck position of a head at the origin, m.
inline constexpr glm::vec3 kNeck{0.0f, -0.08f, -0.02f};

// Keeps the head in one pose.
inline MotionSettings posed(const glm::vec3& rotation, const glm::vec3& translation) {
    return {.keyframes = {{.rotation = rotation, .translation = translation}}, .pivot = kNeck};
}

// Nods by 30 degrees each way, twice a second, and sways to the side.
inline MotionSettings nodding() {
    return {
        .keyframes =
            {{.time = 0.0f, .rotation = {-30, 0, 0}},
             {.time = 0.25f, .rotation = {30, 20, 5}, .translation = {0.05f, 0, 0}},
             {.time = 0.5f, .rotation = {-30, 0, 0}}},
        .pivot = kNeck,
        .repeat = true};
}

// Turns by 40 degrees and moves by 5 cm within three steps of 1/60 s.
inline MotionSettings jerk() {
    return {
        .keyframes =
            {{.time = 0.0f, .rotation = {10, -20, 0}},
             {.time = 0.05f, .rotation = {-20, 20, 15}, .translation = {0.03f, 0.02f, -0.04f}}},
        .pivot = kNeck};
}

inline std::vector<glm::dvec3>
carried(const RigidMotion& motion, std::span<const glm::vec3> points) {
    std::vector<glm::dvec3> result;
    for (const glm::vec3& point : points) result.push_back(motion(point));
    return result;
}

}  // namespace hair::simulation
