#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

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

// ---- Several heads ------------------------------------------------------------------------------

// The first head left of the middle, the second right of it, so far apart that their pictures do
// not overlap.
Settings twoHeads() {
    Settings settings = small();
    settings.copies = {.count = 2, .spacing = 0.8f};
    settings.camera.position = {0.4f, 0.0f, 1.2f};
    settings.camera.target = {0.4f, 0.0f, 0.0f};
    settings.camera.field_of_view = 50.0f;
    return settings;
}

// The same view of one of the heads.
Settings oneHead(Settings settings, std::uint32_t head) {
    const glm::vec3 offset = copyOffsets(settings.copies)[head];
    settings.copies = {};
    settings.camera.position -= offset;
    settings.camera.target -= offset;
    for (LightSettings& light : settings.shading.lights) light.position -= offset;
    return settings;
}

// The left half of one picture beside the right half of another.
Pixels halves(const Settings& settings, const Pixels& left, const Pixels& right) {
    Pixels joined = left;
    const std::size_t width = settings.render.width;
    for (std::size_t i = 0; i < joined.size() / 4; ++i)
        if (i % width >= width / 2) std::copy_n(right.begin() + i * 4, 4, joined.begin() + i * 4);
    return joined;
}

TEST(CopyOffsetsTest, RowsFillASquareFromTheirMiddles) {
    EXPECT_EQ(copyOffsets({}), std::vector{glm::vec3(0.0f)});
    const std::vector<glm::vec3> five{{0, 0, 0}, {2, 0, 0}, {-2, 0, 0}, {0, 0, -2}, {2, 0, -2}};
    EXPECT_EQ(copyOffsets({.count = 5, .spacing = 2.0f}), five);
}

// Each head is drawn with the parameters of its own picture, so nothing is rounded differently.
TEST_F(MovedHeadTest, ManyHeadsAreThePicturesOfEach) {
    for (const Backend backend : {Backend::tessellation, Backend::expanded, Backend::software})
        for (const std::uint32_t samples : {1u, 4u}) {
            Settings settings = with(twoHeads(), backend);
            settings.render.msaa = samples;
            settings.lod = {.near_distance = 0.5f, .far_distance = 4.0f, .error = 3.0f};
            for (const LodMode mode : {LodMode::distance, LodMode::cluster}) {
                settings.lod.mode = mode;
                const Pixels left = drawCase(device(), oneHead(settings, 0));
                const Pixels right = drawCase(device(), oneHead(settings, 1));
                EXPECT_GT(differingPixels(left, right), 2000u);
                EXPECT_EQ(
                    differingPixels(drawCase(device(), settings), halves(settings, left, right)),
                    0u)
                    << static_cast<int>(backend) << " with " << samples << " samples";
            }
        }
}

TEST_F(MovedHeadTest, ManyHeadsHaveTheShadowsOfEach) {
    Settings settings = with(twoHeads(), Backend::software);
    settings.shading.lights = {
        {.type = LightType::directional, .direction = {-1.0f, -1.0f, -1.0f}}};
    settings.shading.shadows = {
        .meshes = true, .hair = HairShadows::deep_opacity, .resolution = 256};
    const Pixels left = drawCase(device(), oneHead(settings, 0));
    const Pixels right = drawCase(device(), oneHead(settings, 1));
    EXPECT_EQ(differingPixels(drawCase(device(), settings), halves(settings, left, right)), 0u);
}

// A nearer head hides a farther one, in whichever order they are drawn.
TEST_F(MovedHeadTest, NearerHeadsHideFartherOnes) {
    Settings settings = with(small(), Backend::software);
    settings.copies = {.count = 2, .spacing = 0.05f};
    settings.camera.position = {-1.0f, 0.0f, 0.0f};
    const Pixels from_left = drawCase(device(), settings);
    settings.copies.count = 1;
    // The nearer head hides the farther one except for hair beside it.
    const std::size_t hidden = differingPixels(from_left, drawCase(device(), settings));
    settings.camera.position.x -= 0.05f;
    const std::size_t seen = differingPixels(from_left, drawCase(device(), settings));
    EXPECT_LT(hidden, seen);
}

// The second head is `delay` further in the motion, and everything else is the same.
TEST_F(MovedHeadTest, HeadsMoveByThemselves) {
    Settings settings = with(twoHeads(), Backend::software);
    settings.simulation.solver = Solver::shape;
    settings.simulation.motion = {
        .keyframes =
            {{.time = 0.0f}, {.time = 0.25f, .rotation = {0.0f, 40.0f, 0.0f}}, {.time = 0.5f}},
        .repeat = true};
    settings.copies.motion = CopyMotion::own;
    settings.copies.delay = 0.2f;
    const auto played = [&](const Settings& of) {
        benchmarks::measure::Case picture(device(), of, HAIRBENCH_SOURCE_DIR "/scenes");
        engine::FrameLoop loop(device(), engine::Timing::overlapped);
        for (int i = 0; i < 10; ++i)
            loop.frame([&](engine::Passes& passes) { picture.frame(passes); });
        loop.finish();
        return std::pair(picture.picture(), picture.stateHash());
    };
    const auto [both, state] = played(settings);
    const auto [left, left_state] = played(oneHead(settings, 0));
    Settings later = oneHead(settings, 1);
    for (Keyframe& key : later.simulation.motion.keyframes) key.time -= settings.copies.delay;
    const auto [right, right_state] = played(later);
    EXPECT_NE(left_state, right_state);
    EXPECT_NE(state, left_state);
    EXPECT_EQ(differingPixels(both, halves(settings, left, right)), 0u);
}

}  // namespace
}  // namespace hair::rendering
