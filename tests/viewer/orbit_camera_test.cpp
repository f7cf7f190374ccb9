#include "benchmarks/viewer/view_tools.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include <glm/trigonometric.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include "hair/rendering/environment.h"

namespace benchmarks::viewer {
namespace {

constexpr float kHeight = 600.0f;  // px
constexpr float kAspect = 1.5f;
// Float rounding after a few rotations.
constexpr float kTolerance = 1e-5f;

hair::CameraSettings camera() {
    hair::CameraSettings camera;
    camera.position = {0.3f, 0.2f, 0.6f};
    camera.target = {0.0f, 0.1f, 0.0f};
    camera.field_of_view = 60.0f;
    return camera;
}

float distanceOf(const hair::CameraSettings& camera) {
    return glm::length(camera.position - camera.target);
}

// Returns a point's position in the picture, px from the top left corner.
glm::vec2 pixelOf(const hair::CameraSettings& camera, glm::vec3 point) {
    const glm::vec4 clip =
        hair::rendering::viewProjection(camera, kAspect) * glm::vec4(point, 1.0f);
    const glm::vec2 unit = (glm::vec2(clip) / clip.w + 1.0f) / 2.0f;
    return unit * glm::vec2(kHeight * kAspect, kHeight);
}

TEST(Orbit, KeepsTargetAndDistance) {
    const hair::CameraSettings before = camera();
    hair::CameraSettings after = before;
    orbit(after, {123.0f, -45.0f}, kHeight);
    EXPECT_EQ(after.target, before.target);
    EXPECT_NEAR(distanceOf(after), distanceOf(before), kTolerance);
}

TEST(Orbit, GoesHalfRoundForAPictureOfPixels) {
    hair::CameraSettings turned = camera();
    orbit(turned, {kHeight, 0.0f}, kHeight);
    const glm::vec3 before = camera().position - camera().target;
    const glm::vec3 after = turned.position - turned.target;
    EXPECT_NEAR(after.x, -before.x, kTolerance);
    EXPECT_NEAR(after.y, before.y, kTolerance);
    EXPECT_NEAR(after.z, -before.z, kTolerance);
}

TEST(Orbit, NeverLooksAlongUp) {
    for (const float pixels : {10'000.0f, -10'000.0f}) {
        hair::CameraSettings turned = camera();
        orbit(turned, {0.0f, pixels}, kHeight);
        const glm::vec3 arm = glm::normalize(turned.position - turned.target);
        EXPECT_LT(std::abs(glm::dot(arm, turned.up)), 0.9999f) << pixels;
        EXPECT_EQ(arm.y > 0.0f, pixels > 0.0f);  // as if the hair were dragged down
    }
}

TEST(Orbit, DragsWhatIsInFrontAlong) {
    const hair::CameraSettings before = camera();
    const glm::vec3 front = before.target + 0.1f * glm::normalize(before.position - before.target);
    hair::CameraSettings after = before;
    orbit(after, {20.0f, 10.0f}, kHeight);
    EXPECT_GT(pixelOf(after, front).x, pixelOf(before, front).x);
    EXPECT_GT(pixelOf(after, front).y, pixelOf(before, front).y);
}

TEST(Pan, KeepsWhatIsAtTheTargetUnderTheMouse) {
    const hair::CameraSettings before = camera();
    hair::CameraSettings after = before;
    pan(after, {31.0f, -17.0f}, kHeight);
    const glm::vec2 moved = pixelOf(after, before.target) - pixelOf(before, before.target);
    EXPECT_NEAR(moved.x, 31.0f, 0.01f);
    EXPECT_NEAR(moved.y, -17.0f, 0.01f);
}

TEST(Zoom, GoesATenthNearerWithEachStep) {
    hair::CameraSettings near = camera();
    zoom(near, 2.0f);
    EXPECT_NEAR(distanceOf(near), 0.81f * distanceOf(camera()), kTolerance);
    zoom(near, -2.0f);
    EXPECT_NEAR(distanceOf(near), distanceOf(camera()), kTolerance);
    zoom(near, 1000.0f);
    EXPECT_GE(distanceOf(near), near.near_plane);
}

TEST(Fly, TakesTheTargetAlong) {
    hair::CameraSettings moved = camera();
    fly(moved, {0.0f, 0.0f, 0.5f});
    const glm::vec3 forward = camera().target - camera().position;
    EXPECT_NEAR(glm::length(moved.position - camera().position - 0.5f * forward), 0, kTolerance);
    EXPECT_NEAR(distanceOf(moved), distanceOf(camera()), kTolerance);
}

// A sphere's outline is a circle of radius r / sqrt(d^2 - r^2) in the plane at distance 1.
TEST(FrameSphere, FillsThePicture) {
    hair::CameraSettings framed = camera();
    const glm::vec3 center{0.1f, -0.2f, 0.05f};
    frameSphere(framed, center, 0.2f);
    EXPECT_EQ(framed.target, center);
    const float d = distanceOf(framed);
    const float outline = 0.2f / std::sqrt(d * d - 0.2f * 0.2f);
    EXPECT_NEAR(outline, std::tan(glm::radians(30.0f)), 1e-4f);
}

// A picture that is taller than wide is filled across.
TEST(FrameSphere, FillsTheShorterSide) {
    hair::CameraSettings framed = camera();
    frameSphere(framed, {0, 0, 0}, 0.2f, 0.5f);
    const float d = distanceOf(framed);
    const float outline = 0.2f / std::sqrt(d * d - 0.2f * 0.2f);
    EXPECT_NEAR(outline, 0.5f * std::tan(glm::radians(30.0f)), 1e-4f);
}

// Must hold for any field of view, because nothing is visible from inside the hair.
TEST(Presets, SeeTheSphereFromOutsideAndKeepUp) {
    for (const float field_of_view : {20.0f, 60.0f, 100.0f, 150.0f}) {
        for (const CameraPreset& preset : cameraPresets()) {
            SCOPED_TRACE(std::string(preset.name) + " at " + std::to_string(field_of_view));
            hair::CameraSettings looking = camera();
            looking.field_of_view = field_of_view;
            look(looking, preset, {0, 0, 0}, 0.2f);
            const glm::vec2 pixel = pixelOf(looking, {0, 0, 0});
            EXPECT_NEAR(pixel.x, kHeight * kAspect / 2, 0.01f);
            EXPECT_NEAR(pixel.y, kHeight / 2, 0.01f);
            EXPECT_GT(distanceOf(looking), 0.2f);
            EXPECT_GT(pixelOf(looking, {0, -0.1f, 0}).y, pixel.y);
        }
    }
}

TEST(Presets, AreNearAndFar) {
    const auto distance = [](std::string_view name) {
        hair::CameraSettings looking = camera();
        const auto preset = std::ranges::find(cameraPresets(), name, &CameraPreset::name);
        look(looking, *preset, {0, 0, 0}, 0.2f);
        return distanceOf(looking);
    };
    // A sphere fills 60 degrees from r / sin(30 degrees) = 2 r, one radius above its surface.
    EXPECT_NEAR(distance("Front"), 0.4f, kTolerance);
    EXPECT_LT(distance("Close-up"), 0.3f);
    EXPECT_NEAR(distance("Far"), 2.0f, kTolerance);
}

// Cameras that the settings panel allows: along up, and at the target.
TEST(Orbit, MakesCamerasThatCanBe) {
    for (const glm::vec3 position : {glm::vec3{0, 1, 0}, glm::vec3{0, -1, 0}, glm::vec3{0, 0, 0}}) {
        hair::CameraSettings turned = camera();
        turned.position = position;
        turned.target = {0, 0, 0};
        orbit(turned, {0.0f, 0.0f}, kHeight);
        const glm::vec3 arm = turned.position - turned.target;
        ASSERT_GT(glm::length(arm), 0.0f);
        EXPECT_GT(glm::length(glm::cross(glm::normalize(arm), turned.up)), 1e-3f);
    }
}

TEST(Focus, TurnsToThePointAndStaysWhereItIs) {
    hair::CameraSettings focused = camera();
    focus(focused, {0.05f, 0.1f, 0.2f});
    EXPECT_EQ(focused.position, camera().position);
    const glm::vec2 pixel = pixelOf(focused, {0.05f, 0.1f, 0.2f});
    EXPECT_NEAR(pixel.x, kHeight * kAspect / 2, 0.01f);
    EXPECT_NEAR(pixel.y, kHeight / 2, 0.01f);
}

TEST(Focus, NeverLooksAlongUp) {
    hair::CameraSettings focused = camera();
    focus(focused, focused.position - glm::vec3{0, 0.3f, 0});
    EXPECT_EQ(focused.target, camera().target);
}

}  // namespace
}  // namespace benchmarks::viewer
