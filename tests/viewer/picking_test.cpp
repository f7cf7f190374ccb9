#include "benchmarks/viewer/gizmo.h"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <glm/ext/quaternion_trigonometric.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace benchmarks::viewer {
namespace {

// Float rounding of a point projected to a pixel and back: pixels near 1000 have steps of 6e-5.
constexpr float kPixels = 1e-3f;

const PictureRect kRect{{100.0f, 50.0f}, {900.0f, 600.0f}};

hair::CameraSettings lookingDown() {
    hair::CameraSettings camera;
    camera.position = {0.3f, 0.2f, 0.6f};
    camera.target = {0.0f, 0.1f, 0.0f};
    camera.field_of_view = 60.0f;
    return camera;
}

hair::RenderSettings render() {
    hair::RenderSettings render;
    render.width = 1200;
    render.height = 800;
    return render;
}

PictureView viewDown() { return {lookingDown(), render(), kRect}; }

// Looks straight ahead, so that positions are clear without matrices: 90 degrees show 1 m above and
// below at a distance of 1 m.
PictureView simpleView() {
    hair::CameraSettings camera;
    camera.position = {0, 0, 1};
    camera.target = {0, 0, 0};
    camera.field_of_view = 90.0f;
    return {camera, render(), kRect};
}

TEST(PictureView, ShowsPointsWhereTheyAre) {
    const auto pixel = simpleView().pixel({0.5f, 0.25f, 0.0f});
    ASSERT_TRUE(pixel);
    EXPECT_NEAR(pixel->x, 550.0f + 0.5f * 300.0f, kPixels);
    EXPECT_NEAR(pixel->y, 350.0f - 0.25f * 300.0f, kPixels);
    EXPECT_FALSE(simpleView().pixel({0.0f, 0.0f, 2.0f}));
    EXPECT_NEAR(simpleView().pixelsPerMetre({0, 0, -1}), 150.0f, kPixels);
    EXPECT_NEAR(simpleView().depth({0.3f, 0.4f, -1}), 2.0f, 1e-6f);
}

TEST(PictureView, SendsARayThroughWhatAPixelShows) {
    for (const glm::vec3 point :
         {glm::vec3{0.1f, -0.2f, 0.05f}, glm::vec3{-0.3f, 0.3f, -2.0f}, glm::vec3{0, 0.1f, 0}}) {
        const auto pixel = viewDown().pixel(point);
        ASSERT_TRUE(pixel);
        const Ray ray = viewDown().ray(*pixel);
        const glm::dvec3 arm = glm::dvec3(point) - ray.from;
        const double distance = glm::length(glm::cross(arm, ray.direction));
        // Rounding of the pixel.
        EXPECT_LT(distance * double{viewDown().pixelsPerMetre(point)}, double{kPixels});
        EXPECT_GT(glm::dot(arm, ray.direction), 0.0);
    }
}

TEST(PictureView, DragsPointsToWhereTheMouseIs) {
    const glm::vec3 point{0.05f, 0.15f, 0.1f};
    const auto from = viewDown().pixel(point);
    ASSERT_TRUE(from);
    const glm::vec2 by{37.0f, -91.0f};
    const glm::vec3 moved = viewDown().dragged(point, *from, *from + by);
    const auto to = viewDown().pixel(point + moved);
    ASSERT_TRUE(to);
    EXPECT_NEAR(to->x - from->x, by.x, kPixels);
    EXPECT_NEAR(to->y - from->y, by.y, kPixels);
    // The point keeps its depth.
    EXPECT_NEAR(viewDown().depth(point + moved), viewDown().depth(point), 1e-6f);
}

TEST(Sphere, IsRoundAllPoints) {
    const std::array points{glm::vec3{-1, 0, 0}, glm::vec3{3, 0, 0}, glm::vec3{1, 1, 0}};
    const Sphere sphere = sphereRound(points);
    EXPECT_EQ(sphere.center, glm::vec3(1.0f, 0.5f, 0.0f));
    EXPECT_NEAR(sphere.radius, std::sqrt(4.25f), 1e-6f);
}

// Two guides of three vertices, one behind the other.
const std::vector<glm::vec3> kGuides{{0, 0.2f, 0.1f},  {0, 0, 0.1f},  {0, -0.2f, 0.1f},
                                     {0, 0.2f, -0.5f}, {0, 0, -0.5f}, {0, -0.2f, -0.5f}};

TEST(PickVertex, TakesTheOneInFrontAndNoRoot) {
    const PictureView view = simpleView();
    const auto middle = pickVertex(view, kGuides, 3, {550.0f, 350.0f}, 10.0f, 1.0f);
    ASSERT_TRUE(middle);
    EXPECT_EQ(middle->guide, 0u);
    EXPECT_EQ(middle->vertex, 1u);
    const auto behind = pickVertex(view, kGuides, 3, *view.pixel(kGuides[5]), 10.0f, 1.0f);
    ASSERT_TRUE(behind);
    EXPECT_EQ(behind->guide, 1u);
    EXPECT_EQ(behind->vertex, 2u);
    EXPECT_FALSE(pickVertex(view, kGuides, 3, *view.pixel(kGuides[0]), 10.0f, 1.0f));
    EXPECT_FALSE(pickVertex(view, kGuides, 3, {900.0f, 350.0f}, 10.0f, 1.0f));
}

TEST(PickHair, FindsThePointOfASegmentUnderThePixel) {
    const PictureView view = simpleView();
    const glm::vec3 wanted{0.0f, 0.07f, 0.1f};  // in the first guide's first segment
    const auto point = pickHair(view, kGuides, 3, *view.pixel(wanted), 3.0f);
    ASSERT_TRUE(point);
    EXPECT_LT(glm::length(*point - wanted), 1e-5f);
    EXPECT_FALSE(pickHair(view, kGuides, 3, {560.0f, 350.0f}, 3.0f));
}

// A segment that recedes from the camera: the middle of its image is not its own middle.
TEST(PickHair, MindsPerspective) {
    const std::vector<glm::vec3> guide{{-0.2f, 0, 0.5f}, {0.9f, 0, -2.0f}};
    const glm::vec3 wanted = glm::mix(guide[0], guide[1], 0.3f);
    const PictureView view = simpleView();
    const auto point = pickHair(view, guide, 2, *view.pixel(wanted), 3.0f);
    ASSERT_TRUE(point);
    EXPECT_LT(glm::length(*point - wanted), 1e-4f);
}

// Nothing joins the tip of one guide to the root of the next.
TEST(PickHair, FindsNothingBetweenGuides) {
    const std::vector<glm::vec3> guides{
        {-0.4f, 0.2f, 0}, {-0.4f, 0, 0}, {0.4f, 0, 0}, {0.4f, -0.2f, 0}};
    EXPECT_FALSE(pickHair(simpleView(), guides, 2, {550.0f, 350.0f}, 20.0f));
}

TEST(PickMesh, HitsATriangleThatMovedWithTheHead) {
    hair::groom::Mesh mesh;
    mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}};
    const Ray ray{{0, 0, 2}, {0, 0, -1}};
    const auto at_rest = pickMesh(ray, mesh, {});
    ASSERT_TRUE(at_rest);
    EXPECT_NEAR(*at_rest, 2.0, 1e-12);
    const auto moved = pickMesh(ray, mesh, {.translation = {0.2, 0.1, 0.5}});
    ASSERT_TRUE(moved);
    EXPECT_NEAR(*moved, 1.5, 1e-12);
    // After a quarter turn about +y, it is seen edge-on.
    const hair::simulation::RigidMotion turned{
        .rotation = glm::angleAxis(std::numbers::pi / 2, glm::dvec3{0, 1, 0}),
        .translation = {0.1, 0, 0}};
    EXPECT_FALSE(pickMesh(ray, mesh, turned));
    EXPECT_FALSE(pickMesh({{0, 0, -1}, {0, 0, -1}}, mesh, {}));  // behind the ray
}

TEST(PickCapsule, HitsSidesAndEnds) {
    const glm::vec3 a{-1, 0, 0}, b{1, 0, 0};
    const auto side = pickCapsule({{0.5, 0, 3}, {0, 0, -1}}, a, b, 0.25f);
    ASSERT_TRUE(side);
    EXPECT_NEAR(*side, 2.75, 1e-12);
    const auto end = pickCapsule({{3, 0, 0}, {-1, 0, 0}}, a, b, 0.25f);
    ASSERT_TRUE(end);
    EXPECT_NEAR(*end, 1.75, 1e-12);
    // The ball at b: a chord at 0.15 from the middle of a ball of radius 0.25 is 0.2 deep.
    const auto cap = pickCapsule({{1.15, 0, 3}, {0, 0, -1}}, a, b, 0.25f);
    ASSERT_TRUE(cap);
    EXPECT_NEAR(*cap, 2.8, 1e-6);  // 1.15 is not exact as a float
    EXPECT_FALSE(pickCapsule({{0, 0.3, 3}, {0, 0, -1}}, a, b, 0.25f));
    EXPECT_FALSE(pickCapsule({{0, 0, 0.1}, {0, 0, -1}}, a, b, 0.25f));  // from inside
}

}  // namespace
}  // namespace benchmarks::viewer
