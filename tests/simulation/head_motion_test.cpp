#include "hair/simulation/head_motion.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/error_text.h"
#include "tests/largest_difference.h"

namespace hair::simulation {
namespace {

constexpr glm::vec3 kPivot{0.1f, -0.2f, 0.3f};
// Difference of points of size 1 by roundings of double.
constexpr double kDoubleRounding = 1e-13;

// Returns turns and shifts at irregular times, with a halt and coordinates that rise and fall.
MotionSettings wild() {
    return {
        .keyframes =
            {{.time = 0.5f, .rotation = {0, 10, 0}, .translation = {0, 0, 0}},
             {.time = 0.75f, .rotation = {40, -30, 5}, .translation = {0.1f, 0, 0.2f}},
             {.time = 1.75f, .rotation = {-10, -35, 15}, .translation = {0.3f, -0.1f, 0.1f}},
             {.time = 2.0f, .rotation = {-10, -35, 15}, .translation = {0.3f, -0.1f, 0.1f}},
             {.time = 2.25f, .rotation = {0, 370, 0}, .translation = {0, 0, 0}}},
        .pivot = kPivot};
}

MotionSettings repeating() {
    MotionSettings settings = wild();
    settings.repeat = true;
    return settings;
}

// Returns the images of three points that span space, which distinguish any two motions.
std::vector<glm::dvec3> marks(const RigidMotion& motion) {
    return {motion({1, 0, 0}), motion({0, 1, 0}), motion({0, 0, 1})};
}

double difference(const RigidMotion& a, const RigidMotion& b) {
    return largestDifference(marks(a), marks(b));
}

double rad(double degrees) { return degrees * std::acos(-1.0) / 180.0; }

// Moves `p` by a pose as the settings describe it, with matrices for turns about the axes: first
// roll, then pitch, then yaw, all about the pivot, and then the translation.
glm::dvec3 posed(const Keyframe& key, glm::dvec3 p) {
    p -= glm::dvec3(kPivot);
    const double roll = rad(key.rotation.z);
    p = {
        std::cos(roll) * p.x - std::sin(roll) * p.y, std::sin(roll) * p.x + std::cos(roll) * p.y,
        p.z};
    const double pitch = rad(key.rotation.x);
    p = {
        p.x, std::cos(pitch) * p.y - std::sin(pitch) * p.z,
        std::sin(pitch) * p.y + std::cos(pitch) * p.z};
    const double yaw = rad(key.rotation.y);
    p = {
        std::cos(yaw) * p.x + std::sin(yaw) * p.z, p.y, -std::sin(yaw) * p.x + std::cos(yaw) * p.z};
    return p + glm::dvec3(kPivot) + glm::dvec3(key.translation);
}

TEST(HeadMotion, StandsStillWithoutKeyframes) {
    const HeadMotion motion({.pivot = kPivot, .repeat = true});
    for (const double time : {0.0, 0.3, 1000.0})
        EXPECT_EQ(difference(motion.at(time), RigidMotion{}), 0.0);
}

TEST(HeadMotion, HasTheOnlyKeyframesPoseAtAllTimes) {
    for (const bool repeat : {false, true}) {
        MotionSettings settings{
            .keyframes = {{.time = 1.0f, .rotation = {20, 50, -70}, .translation = {1, 2, 3}}},
            .pivot = kPivot,
            .repeat = repeat};
        const HeadMotion motion(settings);
        for (const double time : {0.0, 1.0, 5.5})
            for (const glm::dvec3& p : {glm::dvec3(1, 0, 0), glm::dvec3(0.3, -0.5, 2.0)})
                EXPECT_LT(
                    glm::distance(motion.at(time)(p), posed(settings.keyframes[0], p)),
                    kDoubleRounding);
    }
}

TEST(HeadMotion, PassesThroughEveryKeyframe) {
    for (const MotionSettings& settings : {wild(), repeating()}) {
        const HeadMotion motion(settings);
        for (const Keyframe& key : settings.keyframes)
            for (const glm::dvec3& p : {glm::dvec3(1, 0, 0), glm::dvec3(0.3, -0.5, 2.0)})
                EXPECT_LT(glm::distance(motion.at(key.time)(p), posed(key, p)), kDoubleRounding)
                    << key.time;
    }
}

// Pitch moves the face (+z) down, yaw moves it to the head's left (+x), and roll moves the crown
// (+y) to the head's right (-x).
TEST(HeadMotion, TurnsTheWaysThatTheSettingsSay) {
    const auto turned = [](const glm::vec3& rotation, const glm::dvec3& p) {
        return HeadMotion({.keyframes = {{.rotation = rotation}}}).at(0.0)(p);
    };
    EXPECT_LT(glm::distance(turned({90, 0, 0}, {0, 0, 1}), {0, -1, 0}), kDoubleRounding);
    EXPECT_LT(glm::distance(turned({0, 90, 0}, {0, 0, 1}), {1, 0, 0}), kDoubleRounding);
    EXPECT_LT(glm::distance(turned({0, 0, 90}, {0, 1, 0}), {-1, 0, 0}), kDoubleRounding);
    // Roll: +x to +y; pitch: +y to +z; yaw: +z to +x.
    EXPECT_LT(glm::distance(turned({90, 90, 90}, {1, 0, 0}), {1, 0, 0}), kDoubleRounding);
}

TEST(HeadMotion, KeepsThePivot) {
    MotionSettings settings = wild();
    for (Keyframe& key : settings.keyframes) key.translation = glm::vec3(0.0f);
    const HeadMotion motion(settings);
    for (double time = 0.0; time < 3.0; time += 0.01)
        EXPECT_LT(glm::distance(motion.at(time)(kPivot), glm::dvec3(kPivot)), kDoubleRounding);
}

TEST(HeadMotion, RestsBeforeTheFirstAndAfterTheLastKeyframe) {
    const HeadMotion motion(wild());
    EXPECT_EQ(difference(motion.at(0.0), motion.at(0.5)), 0.0);
    EXPECT_EQ(difference(motion.at(2.25), motion.at(2.5)), 0.0);
    EXPECT_EQ(difference(motion.at(2.25), motion.at(1e6)), 0.0);
}

// A step of 1e-5 s on either side of a moment. The two velocities differ by acceleration times
// step, and by rounding over step. The greatest acceleration of wild() is that of 405 degrees in
// 0.25 s: at most 6 * 405 / 0.25^2 degrees/s^2 = 680 rad/s^2. (For a Hermite cubic with slopes of
// up to three times the secant's the 6 is 12.) The centripetal acceleration is of the same order.
// So it is 2000 m/s^2 * 1e-5 s at points 2 m from the pivot, doubled for safety.
constexpr double kDifference = 1e-5;
constexpr double kVelocityStep = 2.0 * 2.0 * 2000.0 * kDifference;

double velocityJump(const HeadMotion& motion, double time) {
    Extremes jumps;
    const auto before = marks(motion.at(time - kDifference));
    const auto now = marks(motion.at(time));
    const auto after = marks(motion.at(time + kDifference));
    for (std::size_t i = 0; i < 3; ++i)
        jumps.add(glm::length((after[i] - now[i]) - (now[i] - before[i])));
    return jumps.greatest() / kDifference;
}

TEST(HeadMotion, VelocityNeverJumps) {
    const HeadMotion motion(wild());
    for (const Keyframe& key : wild().keyframes)
        EXPECT_LT(velocityJump(motion, key.time), kVelocityStep) << key.time;
    // The test can detect a jump: at top speed, a sudden stop of the same head would be a jump of
    // 30 m/s or more.
    const double speed =
        glm::distance(motion.at(2.125 + kDifference)({0, 0, 1}), motion.at(2.125)({0, 0, 1})) /
        kDifference;
    EXPECT_GT(speed, 10.0 * kVelocityStep);
}

// 370 degrees are 10 degrees and a full turn, so the motion closes.
TEST(HeadMotion, RepeatsWithoutAJump) {
    const HeadMotion motion(repeating());
    const double period = 2.25 - 0.5;
    for (double time = 0.5; time < 2.25; time += 0.037)
        for (const int round : {1, 2, 50})
            // Times of 100 s are rounded by 1.4e-14 s, and the head moves at up to some 60 m/s.
            EXPECT_LT(difference(motion.at(time), motion.at(time + round * period)), 1e-11);
    for (const int round : {1, 2, 3}) {
        EXPECT_LT(velocityJump(motion, 0.5 + round * period), kVelocityStep);
        EXPECT_LT(velocityJump(motion, 0.75 + round * period), kVelocityStep);
    }
}

TEST(HeadMotion, GoesOnTurningThroughTheSeam) {
    const HeadMotion motion(
        {.keyframes = {{.time = 0.0f}, {.time = 2.0f, .rotation = {0, 720, 0}}}, .repeat = true});
    for (double time = 0.0; time < 7.0; time += 0.01) {
        const glm::dvec3 face = motion.at(time)({0, 0, 1});
        const double angle = rad(360.0 * time);
        EXPECT_LT(glm::distance(face, {std::sin(angle), 0.0, std::cos(angle)}), 1e-12) << time;
    }
}

TEST(HeadMotion, HoldsStillBetweenEqualPoses) {
    const HeadMotion motion(wild());
    for (double time = 1.75; time < 2.0; time += 0.01)
        EXPECT_LT(difference(motion.at(time), motion.at(1.75)), kDoubleRounding);
    const HeadMotion repeated(
        {.keyframes =
             {{.time = 0.0f, .rotation = {5, 6, 7}}, {.time = 1.0f, .rotation = {5, 6, 7}}},
         .repeat = true});
    EXPECT_LT(difference(repeated.at(0.3), repeated.at(17.0)), kDoubleRounding);
}

// About a single axis the head never turns beyond a keyframe.
TEST(HeadMotion, StaysBetweenItsKeyframes) {
    MotionSettings settings;
    const float angles[] = {0, 1, 60, 61, 20, 20.5f, 0};
    for (std::size_t i = 0; i < std::size(angles); ++i)
        settings.keyframes.push_back(
            {.time = 0.25f * static_cast<float>(i * i), .rotation = {0, angles[i], 0}});
    const HeadMotion motion(settings);
    for (std::size_t i = 0; i + 1 < std::size(angles); ++i) {
        const auto [low, high] = std::minmax(angles[i], angles[i + 1]);
        const double span = settings.keyframes[i + 1].time - settings.keyframes[i].time;
        for (int part = 0; part <= 100; ++part) {
            const glm::dvec3 face =
                motion.at(settings.keyframes[i].time + span * part / 100.0)({0, 0, 1});
            const double angle = std::atan2(face.x, face.z) / rad(1.0);
            EXPECT_GE(angle, low - 1e-9);
            EXPECT_LE(angle, high + 1e-9);
        }
    }
}

TEST(HeadMotion, StartsAndEndsGently) {
    // Between two rests the cubic is the smoothstep 3 s^2 - 2 s^3.
    const HeadMotion motion(
        {.keyframes = {{.time = 1.0f}, {.time = 3.0f, .translation = {2, 0, 0}}}});
    for (double s = 0.0; s <= 1.0; s += 0.05)
        EXPECT_NEAR(
            motion.at(1.0 + 2.0 * s).translation.x, 2.0 * (3.0 * s * s - 2.0 * s * s * s), 1e-14);
}

TEST(HeadMotion, RefusesTimesThatDoNotAscend) {
    const auto made = [](std::vector<float> times) {
        return errorText([&] {
            MotionSettings settings;
            for (const float time : times) settings.keyframes.push_back({.time = time});
            const HeadMotion motion(settings);
        });
    };
    EXPECT_EQ(made({0, 1, 2}), "no error");
    EXPECT_EQ(
        made({0, 1, 1}), "/simulation/motion/keyframes/2/time: is not after the previous keyframe");
    EXPECT_EQ(
        made({1, 0.5f, 2}),
        "/simulation/motion/keyframes/1/time: is not after the previous keyframe");
}

}  // namespace
}  // namespace hair::simulation
