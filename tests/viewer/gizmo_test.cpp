#include "benchmarks/viewer/gizmo.h"

#include <numbers>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "benchmarks/viewer/toolbar.h"
#include "hair/simulation/head_motion.h"

namespace benchmarks::viewer {
namespace {

constexpr double kFrameTime = 1.0 / 60.0;  // s
constexpr float kReach = 8.0f;         // px
// Rounding of pixels to floats at about 600 px per metre: 1e-4 px is 2e-7 m.
constexpr float kMetres = 2e-6f;

PictureView view() {
    hair::CameraSettings camera;
    camera.position = {0.5f, 0.4f, 0.8f};
    camera.target = {0, 0, 0};
    camera.field_of_view = 50.0f;
    return {camera, {}, {{10.0f, 20.0f}, {1280.0f, 720.0f}}};
}

Gizmo gizmo() { return headGizmo({0.02f, 0.05f, -0.01f}, {}, 0.1f); }

TEST(Gizmo, ArrowsMoveAsFarAsTheMouseDoes) {
    for (int axis = 0; axis < 3; ++axis) {
        const glm::vec3 before = gizmo().origin + 0.7f * gizmo().size * moveAxis(axis);
        const glm::vec3 after = before + 0.13f * moveAxis(axis);
        EXPECT_NEAR(
            moved(view(), gizmo(), axis, *view().pixel(before), *view().pixel(after)), 0.13f,
            kMetres);
    }
}

// Dragging a ring's point to the pixel of another one turns the ring by the angle between both.
TEST(Gizmo, RingsTurnByTheAngleTheMouseGoesRound) {
    for (int axis = 0; axis < 3; ++axis) {
        const glm::vec3 around = gizmo().turn_axes[static_cast<std::size_t>(axis)];
        const auto arc = ringArc(view(), gizmo(), axis);
        const glm::vec3 before = arc[arc.size() / 2];
        const float angle = 0.4f;
        const glm::vec3 after =
            gizmo().origin + glm::angleAxis(angle, around) * (before - gizmo().origin);
        EXPECT_NEAR(
            turned(view(), gizmo(), axis, *view().pixel(before), *view().pixel(after)), angle,
            1e-4f);
    }
}

// A ring seen edge-on is dragged along itself: a drag by its radius turns it by 1 rad.
TEST(Gizmo, RingsSeenFromTheirEdgeTurnToo) {
    hair::CameraSettings camera;
    camera.position = {0, 0, 1};
    camera.target = {0, 0, 0};
    const PictureView ahead(camera, {}, {{0.0f, 0.0f}, {1280.0f, 720.0f}});
    const Gizmo still = headGizmo({0, 0, 0}, {}, 0.1f);
    const glm::vec2 from = *ahead.pixel({0, 0, 0.1f});
    const glm::vec2 to = *ahead.pixel({0.05f, 0, 0.1f});
    EXPECT_NEAR(turned(ahead, still, 1, from, to), 0.5f, 1e-4f);  // about +y, to the right
}

TEST(Gizmo, IsPickedWhereItIsShown) {
    for (int axis = 0; axis < 3; ++axis) {
        const auto tip = view().pixel(arrowTip(gizmo(), axis));
        EXPECT_EQ(
            pickGizmo(view(), gizmo(), *tip, kReach), (GizmoPart{GizmoPart::Kind::arrow, axis}));
        const auto arc = ringArc(view(), gizmo(), axis);
        // A point away from intersections of rings.
        const auto on = view().pixel(arc[arc.size() / 3]);
        EXPECT_EQ(pickGizmo(view(), gizmo(), *on, 2.0f), (GizmoPart{GizmoPart::Kind::ring, axis}));
    }
    EXPECT_FALSE(pickGizmo(view(), gizmo(), {15.0f, 25.0f}, kReach));
}

TEST(Gizmo, ArrowsAtTheCameraAreNotDragged) {
    hair::CameraSettings camera;
    camera.position = {0, 0, 1};
    camera.target = {0, 0, 0};
    const PictureView ahead(camera, {}, {{0.0f, 0.0f}, {1280.0f, 720.0f}});
    const Gizmo still = headGizmo({0, 0, 0}, {}, 0.1f);
    EXPECT_TRUE(canBeDragged(ahead, still, 0));
    EXPECT_FALSE(canBeDragged(ahead, still, 2));
}

// Turning about a ring's axis adds to one angle of the pose, by HeadMotion's convention.
TEST(HeadGizmo, RingsAreTheAnglesOfAKeyframe) {
    const HeadPose pose{{20.0f, -35.0f, 50.0f}, {0.1f, 0.2f, -0.3f}};
    const glm::vec3 pivot{0.0f, 0.1f, 0.0f};
    const auto rotationOf = [&](const HeadPose& of) {
        hair::MotionSettings motion{.keyframes = {{0.0f, of.rotation, of.translation}}};
        motion.pivot = pivot;
        return hair::simulation::HeadMotion(motion).at(0.0).rotation;
    };
    const Gizmo gizmo = headGizmo(pivot, pose, 0.1f);
    EXPECT_EQ(gizmo.origin, pivot + pose.translation);
    for (int axis = 0; axis < 3; ++axis) {
        HeadPose further = pose;
        further.rotation[axis] += 10.0f;
        const glm::dvec3 around = gizmo.turn_axes[static_cast<std::size_t>(axis)];
        const glm::dquat turned =
            glm::angleAxis(std::numbers::pi / 18.0, around) * rotationOf(pose);
        // Limited by the axes, which are floats.
        EXPECT_NEAR(std::abs(glm::dot(turned, rotationOf(further))), 1.0, 1e-7) << axis;
        const glm::dvec3 a = turned * glm::dvec3(1, 2, 3);
        const glm::dvec3 b = rotationOf(further) * glm::dvec3(1, 2, 3);
        EXPECT_LT(glm::length(a - b), 1e-5) << axis;
    }
}

void expectAscending(const hair::MotionSettings& motion) {
    for (std::size_t i = 1; i < motion.keyframes.size(); ++i)
        EXPECT_LT(motion.keyframes[i - 1].time, motion.keyframes[i].time) << i;
}

TEST(HeadKeys, AscendAndHaveThePoseAtEveryFrameThatIsPlayed) {
    hair::MotionSettings motion;
    std::vector<HeadPose> wanted;
    const auto dragTo = [&](std::uint32_t frame, float x) {
        moveHead(motion, momentAfter(frame, kFrameTime, kFrameTime), {{0, 0, 0}, {x, 0, 0}});
    };
    // First one frame per picture of the window, then pictures without frames, then several frames.
    dragTo(10, 0.1f);
    dragTo(11, 0.2f);
    dragTo(12, 0.25f);
    dragTo(12, 0.3f);
    dragTo(16, 0.4f);
    expectAscending(motion);
    const auto at = [&](std::uint32_t frame) {
        const Moment moment = momentAfter(frame, kFrameTime, kFrameTime);
        return headAt(motion, double{moment.now}).translation.x;
    };
    const std::pair<std::uint32_t, float> played[] = {{0, 0.0f},  {10, 0.0f}, {11, 0.1f},
                                                      {12, 0.2f}, {13, 0.3f}, {14, 0.3f},
                                                      {16, 0.3f}, {17, 0.4f}, {99, 0.4f}};
    for (const auto& [frame, x] : played) EXPECT_NEAR(at(frame), x, 1e-6f) << frame;
}

TEST(HeadKeys, KeepWhereTheHeadWas) {
    hair::MotionSettings nod{
        .keyframes = {
            {0.0f, {0, 0, 0}, {0, 0, 0}},
            {0.3f, {30, 10, 0}, {0.02f, 0, 0}},
            {0.7f, {-20, 350, 0}, {0, 0, 0.05f}},
            {1.0f, {0, 360, 0}, {0, 0, 0}}}};
    for (const bool repeats : {false, true}) {
        nod.repeat = repeats;
        // Frames between keyframes, at the end of the first round and in the third.
        for (const std::uint32_t frame : {0u, 5u, 29u, 59u, 140u}) {
            const Moment moment = momentAfter(frame, kFrameTime, kFrameTime);
            const hair::MotionSettings until = motionUntil(nod, moment, kFrameTime);
            EXPECT_FALSE(until.repeat);
            expectAscending(until);
            const hair::simulation::HeadMotion before(nod), after(until);
            for (std::uint32_t i = 0; i <= frame; ++i) {
                const double time = (i + 1.0) * kFrameTime;
                const hair::simulation::RigidMotion a = before.at(time), b = after.at(time);
                // A thousandth of a degree, or float rounding of a keyframe's time at 1.7 m/s.
                EXPECT_NEAR(std::abs(glm::dot(a.rotation, b.rotation)), 1.0, 1e-9);
                EXPECT_LT(glm::length(a.translation - b.translation), 2e-6);
            }
            // Afterwards it rests.
            EXPECT_LT(
                glm::length(after.at(1e3).translation - after.at(double{moment.now}).translation),
                1e-12);
        }
    }
}

// A motion that has ended needs no keyframe per frame.
TEST(HeadKeys, StayFewWhereTheMotionHadEnded) {
    const hair::MotionSettings motion{
        .keyframes = {{0.0f, {0, 0, 0}, {0, 0, 0}}, {0.5f, {30, 0, 0}, {0, 0, 0}}}};
    EXPECT_EQ(
        motionUntil(motion, momentAfter(100, kFrameTime, kFrameTime), kFrameTime).keyframes.size(),
        3u);
}

TEST(ColliderHandles, MoveTheColliderByWhatIsDragged) {
    const hair::simulation::RigidMotion head{
        .rotation = glm::angleAxis(0.7, glm::normalize(glm::dvec3{1, 2, 3})),
        .translation = {0.1, -0.05, 0.02}};
    const glm::vec3 by{0.03f, -0.02f, 0.01f};
    for (const hair::Follows follows : {hair::Follows::head, hair::Follows::world}) {
        const hair::Collider capsule{{0.1f, 0, 0}, {0.2f, 0.1f, 0}, 0.05f, follows};
        const ColliderAxis before = axisOf(capsule, head);
        const auto after = [&](ColliderPart part) {
            return axisOf(withMoved(capsule, head, view(), part, by), head);
        };
        EXPECT_LT(glm::length(after(ColliderPart::middle).a - before.a - by), kMetres);
        EXPECT_LT(glm::length(after(ColliderPart::middle).b - before.b - by), kMetres);
        EXPECT_LT(glm::length(after(ColliderPart::end_a).a - before.a - by), kMetres);
        EXPECT_EQ(after(ColliderPart::end_a).b, before.b);
        EXPECT_LT(glm::length(after(ColliderPart::end_b).b - before.b - by), kMetres);
        EXPECT_EQ(after(ColliderPart::end_b).a, before.a);
    }
}

TEST(ColliderHandles, RimIsOnTheSurfaceAndFollowsTheMouse) {
    const hair::Collider sphere{{0, 0, 0}, {0, 0, 0}, 0.05f, hair::Follows::world};
    const auto handles = colliderHandles(sphere, {}, view());
    ASSERT_EQ(handles[1].part, ColliderPart::rim);
    EXPECT_NEAR(glm::length(handles[1].point), 0.05f, 1e-7f);
    const glm::vec3 out = glm::normalize(handles[1].point) * 0.02f;
    EXPECT_NEAR(withMoved(sphere, {}, view(), ColliderPart::rim, out).radius, 0.07f, 1e-6f);
    // Stays within the table's limit.
    EXPECT_GE(withMoved(sphere, {}, view(), ColliderPart::rim, -5.0f * out).radius, 0.0001f);
}

TEST(ColliderHandles, StretchASphereToACapsule) {
    const hair::Collider sphere{{0, 0, 0}, {0, 0, 0}, 0.05f, hair::Follows::world};
    const hair::Collider capsule =
        withMoved(sphere, {}, view(), ColliderPart::stretch, {0, 0.1f, 0});
    EXPECT_EQ(capsule.a, sphere.a);
    EXPECT_EQ(capsule.b, glm::vec3(0, 0.1f, 0));
}

TEST(ColliderInFront, TouchesTheGroomsSphereAtTheFace) {
    const Sphere groom{{0.1f, 0.2f, 0.3f}, 0.15f};
    const hair::Collider collider = colliderInFront(groom);
    EXPECT_EQ(collider.a, collider.b);
    EXPECT_EQ(collider.follows, hair::Follows::head);
    EXPECT_GT(collider.a.z, groom.center.z);
    EXPECT_NEAR(glm::length(collider.a - groom.center), groom.radius + collider.radius, 1e-6f);
}

}  // namespace
}  // namespace benchmarks::viewer
