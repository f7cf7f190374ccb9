#include "benchmarks/viewer/tools/head_keys.h"

#include <cmath>

#include "benchmarks/viewer/tools/field_limits.h"
#include "hair/simulation/head_motion.h"

namespace benchmarks {

namespace {

// What poses may differ by and count as the same: some steps of the floats that keyframes are made
// of, far below what can be seen.
constexpr float kDegrees = 1e-3f;
constexpr float kMetres = 1e-6f;

constexpr std::size_t kKeysOfAMove = 2;  // the present and the next frame

std::size_t mostKeys() { return mostOf(&hair::MotionSettings::keyframes); }

bool same(const hair::Keyframe& a, const hair::Keyframe& b) {
    for (int i = 0; i < 3; ++i) {
        // Whole turns apart is the same pose.
        if (std::abs(std::remainder(a.rotation[i] - b.rotation[i], 360.0f)) > kDegrees)
            return false;
        if (std::abs(a.translation[i] - b.translation[i]) > kMetres) return false;
    }
    return true;
}

hair::Keyframe keyOf(const HeadPose& pose, float time) {
    return {.time = time, .rotation = pose.rotation, .translation = pose.translation};
}

HeadPose poseOf(const hair::Keyframe& key) { return {key.rotation, key.translation}; }

// The angles that are whole turns from `key`'s and nearest to those of the key before.
hair::Keyframe unwound(hair::Keyframe key, const hair::Keyframe& before) {
    for (int i = 0; i < 3; ++i)
        key.rotation[i] =
            before.rotation[i] + std::remainder(key.rotation[i] - before.rotation[i], 360.0f);
    return key;
}

// Leaves what was, with a keyframe at the present.
void cut(hair::MotionSettings& motion, float now) {
    const hair::Keyframe present = keyOf(headAt(motion, double{now}), now);
    motion.repeat = false;
    std::erase_if(motion.keyframes, [&](const hair::Keyframe& key) { return key.time > now; });
    if (motion.keyframes.empty() || motion.keyframes.back().time < now)
        motion.keyframes.push_back(present);
}

}  // namespace

HeadPose headAt(const hair::MotionSettings& motion, double time) {
    return poseOf(hair::HeadMotion(motion).keyframeAt(time));
}

hair::MotionSettings
motionUntil(const hair::MotionSettings& motion, const Moment& moment, double frame_time) {
    hair::MotionSettings until = motion;
    if (motion.keyframes.empty()) return until;
    cut(until, moment.now);
    if (frame_time <= 0.0) return until;
    const hair::HeadMotion before(motion), after(until);
    std::vector<hair::Keyframe> keys;
    bool is_same = true;
    for (double frame = 1.0; static_cast<float>(frame * frame_time) <= moment.now; frame += 1.0) {
        const double time = frame * frame_time;
        const hair::Keyframe key = before.keyframeAt(time);
        is_same &= same(key, after.keyframeAt(time));
        keys.push_back(keys.empty() ? key : unwound(key, keys.back()));
    }
    if (!is_same && keys.size() + kKeysOfAMove <= mostKeys()) until.keyframes = std::move(keys);
    return until;
}

bool moveHead(hair::MotionSettings& motion, const Moment& moment, const HeadPose& pose) {
    const HeadPose wanted{
        allowed(&hair::Keyframe::rotation, pose.rotation),
        allowed(&hair::Keyframe::translation, pose.translation)};
    if (wanted == headAt(motion, double{moment.next})) return false;
    if (motion.keyframes.size() + kKeysOfAMove > mostKeys()) return false;
    cut(motion, moment.now);
    motion.keyframes.push_back(keyOf(wanted, moment.next));
    return true;
}

}  // namespace benchmarks
