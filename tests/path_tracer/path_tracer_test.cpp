// Compares the path tracer with results that are known independently.
#include "hair/reference/path_tracer.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include "hair/random.h"
#include "hair/reference/fiber.h"
#include "hair/rendering/fiber.h"
#include "tests/rendering/fiber_rig.h"

namespace hair::reference {
namespace {

using rendering::brownFiber;
using rendering::makeFiber;
using rendering::whiteFiber;

// Returns the control points of a straight fibre.
std::vector<glm::dvec4> straight(const glm::dvec3& root, const glm::dvec3& tip, double radius) {
    std::vector<glm::dvec4> control;
    for (int i = -1; i <= 2; ++i) control.emplace_back(root + double(i) * (tip - root), radius);
    return control;
}

// Returns a fibre across the whole of a narrow picture.
TracedScene oneFiber(const rendering::Fiber& fiber) {
    TracedScene scene;
    scene.fiber = fiber;
    scene.curves = {straight({-50, 0, 0}, {50, 0, 0}, 1)};
    return scene;
}

// Returns a camera so far away that rays are parallel. They see the middle half of the fibre's
// width.
TracedCamera farCamera() {
    return {
        .position = {0, 0, 1000},
        .field_of_view = glm::degrees(2 * std::atan(0.5 / 999)),
        .width = 8,
        .height = 8};
}

// The fibre's middle, |h| <= 0.5, is as bright as the mean over h of the light that it scatters,
// which the midpoint rule gives.
TEST(PathTracer, SeesWhatOneFiberScatters) {
    TracedScene scene = oneFiber(makeFiber(brownFiber()));
    const glm::dvec3 to_light = glm::normalize(glm::dvec3(0.3, 0.8, 0.4));
    scene.directions = {{-to_light, glm::dvec3(2)}};
    const TracedPicture picture = PathTracer(scene).trace(farCamera(), 256, 1);
    // x points to the tip. The eye is at azimuth 0, so y points to it.
    const glm::dvec3 wo(0, 1, 0);
    const glm::dvec3 wi(to_light.x, to_light.z, -to_light.y);
    constexpr int kPlaces = 1000;
    glm::dvec3 expected(0);
    for (int i = 0; i < kPlaces; ++i)
        expected +=
            2.0 * scattering(scene.fiber, wo, wi, (i + 0.5) / kPlaces - 0.5) / double{kPlaces};
    const glm::dvec3 mean = picture.mean();
    const glm::dvec3 error = picture.standardError();
    for (int c = 0; c < 3; ++c) {
        EXPECT_LT(error[c] / expected[c], 0.01);
        // The camera is at a finite distance. Rays differ by 0.0005 rad, which is 0.001 of h.
        EXPECT_NEAR(mean[c] / expected[c], 1, 3 * error[c] / expected[c] + 0.002) << c;
    }
}

// Returns a tuft of crossing fibres.
TracedScene tangle(const rendering::Fiber& fiber) {
    TracedScene scene;
    scene.fiber = fiber;
    for (std::uint32_t i = 0; i < 80; ++i) {
        const auto point = [&](std::uint32_t purpose) {
            return glm::dvec3(
                2 * random01(5, i, purpose) - 1, 2 * random01(5, i, purpose + 1) - 1,
                2 * random01(5, i, purpose + 2) - 1);
        };
        std::vector<glm::dvec4>& control = scene.curves.emplace_back();
        for (std::uint32_t k = 0; k < 6; ++k) control.emplace_back(2.0 * point(3 * k), 0.08);
    }
    return scene;
}

TracedCamera nearCamera() {
    return {.position = {0, 0, 6}, .field_of_view = 30, .width = 12, .height = 12};
}

// In uniform light from all directions, hair that absorbs nothing is invisible. Only paths that are
// cut off after 63 fibres are missing.
TEST(PathTracer, KeepsAllLightInAWhiteFurnace) {
    TracedScene scene = tangle(makeFiber(whiteFiber(0.3f, 0.3f)));
    scene.background = glm::dvec3(1);
    const TracedPicture picture = PathTracer(scene).trace(nearCamera(), 32, 1);
    const double error = picture.standardError().g;
    EXPECT_LT(error, 0.005);
    EXPECT_NEAR(picture.mean().g, 1, 4 * error + 0.001);
}

// A small spherical light is as bright as a point light, although they are sampled differently.
TEST(PathTracer, HasOneLightFromPointsAndSmallSpheres) {
    TracedScene scene = tangle(makeFiber(whiteFiber(0.7f, 0.7f)));
    const glm::dvec3 position(3, 5, 8);
    scene.points = {{position, glm::dvec3(50)}};
    const TracedPicture point = PathTracer(scene).trace(nearCamera(), 32, 1);
    scene.points.clear();
    constexpr double kRadius = 0.05;
    scene.spheres = {{position, kRadius, glm::dvec3(50 / (std::numbers::pi * kRadius * kRadius))}};
    const TracedPicture sphere = PathTracer(scene).trace(nearCamera(), 32, 2);
    for (int c = 0; c < 3; ++c) {
        const double error = std::hypot(point.standardError()[c], sphere.standardError()[c]);
        EXPECT_NEAR(point.mean()[c], sphere.mean()[c], 3 * error);
        EXPECT_LT(error / point.mean()[c], 0.05);
    }
}

TEST(PathTracer, IsTheSamePictureAgain) {
    TracedScene scene = tangle(makeFiber(brownFiber()));
    scene.points = {{{3, 5, 8}, glm::dvec3(50)}};
    const PathTracer tracer(scene);
    const TracedPicture first = tracer.trace(nearCamera(), 2, 7);
    EXPECT_EQ(first.radiances, tracer.trace(nearCamera(), 2, 7).radiances);
    EXPECT_NE(first.radiances, tracer.trace(nearCamera(), 2, 8).radiances);
}

// A matt floor has the radiance reflectance / pi times the irradiance.
TEST(PathTracer, SeesAMattFloor) {
    TracedScene scene;
    MattMesh& floor = scene.meshes.emplace_back();
    floor.positions = {{-9, -9, 0}, {9, -9, 0}, {0, 18, 0}};
    floor.normals.assign(3, {0, 0, 1});
    floor.triangles = {{0, 1, 2}};
    floor.reflectance = {0.2, 0.4, 0.8};
    const glm::dvec3 to_light(0, 0.6, 0.8);
    scene.directions = {{-to_light, glm::dvec3(3)}};
    const glm::dvec3 mean = PathTracer(scene).trace(nearCamera(), 2, 1).mean();
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(mean[c], floor.reflectance[c] / std::numbers::pi * 3 * 0.8, 1e-12);
}

}  // namespace
}  // namespace hair::reference
