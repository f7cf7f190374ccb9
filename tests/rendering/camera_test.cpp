#include "hair/rendering/environment.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <gtest/gtest.h>

namespace hair::rendering {
namespace {

// A float matrix product of numbers of size 1 has some ten roundings of 6e-8, and the division by
// w adds as much again.
constexpr float kRounding = 2e-6f;

glm::vec3 onScreen(const glm::mat4& matrix, const glm::vec3& point) {
    const glm::vec4 clip = matrix * glm::vec4(point, 1.0f);
    return glm::vec3(clip) / clip.w;
}

// Half the height of the picture at distance 1.
float tangentOfHalf(float degrees) {
    return std::tan(0.5f * degrees * std::numbers::pi_v<float> / 180.0f);
}

// The thesis's camera: (0, 0, 0.5) looks at the origin with 100 degrees.
TEST(Camera, TargetIsAtTheCentre) {
    const glm::vec3 centre = onScreen(viewProjection({}, 16.0f / 9.0f), glm::vec3(0.0f));
    EXPECT_NEAR(centre.x, 0.0f, kRounding);
    EXPECT_NEAR(centre.y, 0.0f, kRounding);
}

TEST(Camera, FieldOfViewReachesTheTopEdgeAndYPointsDown) {
    const glm::mat4 matrix = viewProjection({}, 16.0f / 9.0f);
    const float top = 0.5f * tangentOfHalf(100.0f);  // 0.596 m
    EXPECT_NEAR(onScreen(matrix, {0.0f, top, 0.0f}).y, -1.0f, kRounding);
    EXPECT_NEAR(onScreen(matrix, {0.0f, -top, 0.0f}).y, 1.0f, kRounding);
}

TEST(Camera, AspectWidensThePictureAndXPointsRight) {
    const glm::mat4 matrix = viewProjection({}, 2.0f);
    const float right = 2.0f * 0.5f * tangentOfHalf(100.0f);
    EXPECT_NEAR(onScreen(matrix, {right, 0.0f, 0.0f}).x, 1.0f, kRounding);
    EXPECT_NEAR(onScreen(matrix, {-right, 0.0f, 0.0f}).x, -1.0f, kRounding);
}

// depth = near / (far - near) * (far / distance - 1)
TEST(Camera, DepthRunsFromNearToFar) {
    const CameraSettings camera{.near_plane = 0.25f, .far_plane = 4.0f};
    const glm::mat4 matrix = viewProjection(camera, 1.0f);
    const auto depth = [&](float distance) {
        return onScreen(matrix, {0.0f, 0.0f, 0.5f - distance}).z;
    };
    EXPECT_NEAR(depth(0.25f), 1.0f, kRounding);
    EXPECT_NEAR(depth(4.0f), 0.0f, kRounding);
    EXPECT_NEAR(depth(1.0f), 0.2f, kRounding);  // 0.25 / 3.75 * 3
}

// 32-bit depth resolves less than a strand's width with the default planes of 0.01 and 100 m, from
// directly in front of the camera to beyond the distances of `hairbench lod`.
TEST(Camera, DepthTellsTenthsOfAMillimetreApartUpTo40M) {
    const CameraSettings camera{.position = glm::vec3(0.0f), .target = {0.0f, 0.0f, -1.0f}};
    const glm::mat4 matrix = viewProjection(camera, 1.0f);
    for (float distance = 0.02f; distance < 40.0f; distance *= 1.01f) {
        const glm::vec3 point(0.1f * distance, 0.2f * distance, -distance);
        EXPECT_GT(onScreen(matrix, point).z, onScreen(matrix, point - glm::vec3(0, 0, 1e-4f)).z)
            << distance;
    }
}

TEST(Camera, LooksFromAnywhereWithItsUpUpward) {
    const CameraSettings camera{
        .position = {1.0f, 2.0f, 3.0f},
        .target = {-1.0f, 1.0f, 1.0f},  // 3 m away
        .up = {0.0f, 0.5f, 0.0f},       // of arbitrary length
        .field_of_view = 60.0f};
    const glm::mat4 matrix = viewProjection(camera, 1.0f);
    const glm::vec3 forward = glm::vec3(-2.0f, -1.0f, -2.0f) / 3.0f;
    const glm::vec3 right = glm::normalize(glm::cross(forward, glm::vec3(0.0f, 1.0f, 0.0f)));
    const glm::vec3 up = glm::cross(right, forward);
    const float half = 3.0f * tangentOfHalf(60.0f);

    const glm::vec3 centre = onScreen(matrix, camera.target);
    EXPECT_NEAR(centre.x, 0.0f, kRounding);
    EXPECT_NEAR(centre.y, 0.0f, kRounding);
    const glm::vec3 corner = onScreen(matrix, camera.target + half * (right + up));
    EXPECT_NEAR(corner.x, 1.0f, kRounding);
    EXPECT_NEAR(corner.y, -1.0f, kRounding);
}

}  // namespace
}  // namespace hair::rendering
