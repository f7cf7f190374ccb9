#pragma once

#include <glm/vec3.hpp>

#include "benchmarks/viewer/tools/moment.h"
#include "hair/simulation_settings.h"

namespace benchmarks {

// A pose of the head, as keyframes have it.
struct HeadPose {
    glm::vec3 rotation{0.0f};  // pitch, yaw and roll, deg
    glm::vec3 translation{0.0f};  // m

    bool operator==(const HeadPose&) const = default;
};

HeadPose headAt(const hair::MotionSettings& motion, double time);

// A motion that is the same up to now and rests from then on: with the keyframes so far, if they
// say the same without those after now, else with one for each of the frames so far, which were
// `frame_time` long (as far as there may be so many keyframes). It does not repeat.
hair::MotionSettings
motionUntil(const hair::MotionSettings& motion, const Moment& moment, double frame_time);

// Of a motion that rests from now on: the head has the pose from the next frame on. False, and
// nothing is done, where it has it already or where there is no room for more keyframes.
bool moveHead(hair::MotionSettings& motion, const Moment& moment, const HeadPose& pose);

}  // namespace benchmarks
