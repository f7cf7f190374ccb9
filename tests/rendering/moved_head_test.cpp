#include <cmath>

#include <glm/ext/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include "hair/rendering/renderer.h"
#include "tests/gpu_fixture.h"
#include "tests/largest_difference.h"
#include "tests/rendering/pictures.h"

// Pictures of a head that has moved.
namespace hair::rendering {
namespace {

using MovedHeadTest = GpuTest;

// The guides are already moved. The root normals, which lift strands onto the scalp, are as made
// and turn with the head.
TEST_F(MovedHeadTest, StrandsMoveWithTheHead) {
    glm::mat4 head = glm::translate(glm::mat4(1.0f), {0.1f, -0.2f, 0.3f});
    head = glm::rotate(head, 2.0f, glm::normalize(glm::vec3(1.0f, -2.0f, 3.0f)));
    const groom::Groom groom = tangledGroom(6);
    groom::Groom moved = groom;
    for (glm::vec3& point : moved.points) point = glm::vec3(head * glm::vec4(point, 1.0f));
    groom::Groom flat = moved;
    flat.root_normals.clear();

    const Settings settings{.strands = {.density = 30, .tessellation = 2}};
    const auto evaluate = [&](const groom::Groom& of, const glm::mat4& where) {
        const DeviceHair hair(device(), of);
        StrandView view = hair.view();
        view.head = where;
        return evaluateStrandPoints(device(), settings, view).records;
    };
    const auto still = evaluate(groom, glm::mat4(1.0f));
    const auto turned = evaluate(moved, head);
    const auto without_lift = evaluate(flat, head);
    // 20 roundings of 2^-24 of control points within 1.5 m, as in strand_points_test.cpp, in both,
    // and 10 more by the matrix.
    constexpr double kTolerance = 50 * 0x1p-24 * 1.5 * 2.0;
    ASSERT_EQ(turned.size(), still.size());
    ASSERT_EQ(without_lift.size(), still.size());
    Extremes lifts;
    for (std::size_t i = 0; i < still.size(); ++i) {
        const glm::dvec3 expected = glm::dmat4(head) * glm::dvec4(still[i].position, 1.0);
        ASSERT_LT(glm::distance(glm::dvec3(turned[i].position), expected), kTolerance);
        lifts.add(double{glm::distance(turned[i].position, without_lift[i].position)});
    }
    EXPECT_GT(lifts.greatest(), 1000.0 * kTolerance);  // there was something to turn
}

Settings small() {
    Settings settings = thesisAtRest();
    settings.render.width = 320;
    settings.render.height = 180;
    return settings;
}

// Head, hair, camera and light move together, so the picture is the same.
TEST_F(MovedHeadTest, PictureIsTheSameWhereEverythingMoves) {
    Settings settings = small();
    const Pixels still = drawCase(device(), settings);

    // +z to +x, about the origin, then 1 m up: all with little rounding.
    settings.simulation.motion.keyframes = {
        {.rotation = {0.0f, 90.0f, 0.0f}, .translation = {0.0f, 1.0f, 0.0f}}};
    const Pixels left_behind = drawCase(device(), settings);
    const auto moved = [](const glm::vec3& p) { return glm::vec3(p.z, p.y + 1.0f, -p.x); };
    settings.camera.position = moved(settings.camera.position);
    settings.camera.target = moved(settings.camera.target);
    settings.shading.lights[0].position = moved(settings.shading.lights[0].position);
    const Pixels followed = drawCase(device(), settings);

    EXPECT_GT(differingPixels(still, left_behind), 2000u);
    // Points are up to 2e-7 m off, and a pixel is 7 mm, so each end of a line changes what
    // covers a pixel's middle, or the order of two strands in depth, with a probability of 3e-5.
    // For a hundred strands on top of each other in 10^4 pixels of hair, 30 pixels may change; the
    // test allows three times that, for chance.
    EXPECT_LT(differingPixels(still, followed), 100u);
}

TEST_F(MovedHeadTest, BackEndsDrawTheSame) {
    Settings settings = small();
    settings.simulation.motion.keyframes = {
        {.rotation = {20.0f, 50.0f, -10.0f}, .translation = {0.05f, 0.0f, 0.02f}}};
    const Pixels instanced = drawCase(device(), settings);
    EXPECT_GT(differingPixels(instanced, drawBald(device(), settings)), 625u);
    settings.strands.submission = Submission::batched;
    EXPECT_EQ(differingPixels(instanced, drawCase(device(), settings)), 0u);
    settings.strands.backend = Backend::pulling_geometry;
    EXPECT_EQ(differingPixels(instanced, drawCase(device(), settings)), 0u);
}

// Within a case that plays frame by frame.
TEST_F(MovedHeadTest, FrozenHairFollowsInEveryFrame) {
    Settings settings = small();
    settings.simulation.motion = {
        .keyframes = {{.time = 0.0f}, {.time = 0.5f, .rotation = {0.0f, 60.0f, 0.0f}}}};
    benchmarks::measure::Case picture(device(), settings, HAIRBENCH_SOURCE_DIR "/scenes");
    engine::FrameLoop loop(device(), engine::Timing::overlapped);
    for (int i = 0; i < 31; ++i) loop.frame([&](engine::Passes& passes) { picture.frame(passes); });
    loop.finish();
    const Pixels end = picture.picture();
    settings.simulation.motion.keyframes = {{.rotation = {0.0f, 60.0f, 0.0f}}};
    // The device rounds the moved hair, and the host rounds the hair that starts there, as above.
    EXPECT_LT(differingPixels(end, drawCase(device(), settings)), 100u);
}

}  // namespace
}  // namespace hair::rendering
