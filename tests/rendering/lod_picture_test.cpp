#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include "benchmarks/lod/walk.h"
#include "tests/gpu_fixture.h"
#include "tests/rendering/pictures.h"

// Level of detail in pictures: thesis 2.3.8.1.
namespace hair::rendering {
namespace {

class LodPictureTest : public GpuTest {
protected:
    static Settings small() {
        Settings settings = thesisAtRest();
        settings.render.width = 320;
        settings.render.height = 180;
        return settings;
    }

    static Pixels draw(const Settings& settings) { return drawCase(device(), settings); }
};

// The scalp is within 0.15 m of the origin and the camera 0.5 m from it: the root triangles are
// 0.35 to 0.65 m away.
TEST_F(LodPictureTest, NearHairIsThatOfLevelZero) {
    Settings settings = small();
    const Pixels forced = draw(settings);
    settings.lod = {
        .mode = LodMode::distance,
        .level = 3.0f,  // is not read
        .near_distance = 1.0f,
        .far_distance = 2.0f};
    EXPECT_EQ(differingPixels(draw(settings), forced), 0u);
}

// With an error that no strand's absence keeps, all are drawn in full, in another order. Only
// points of straight pieces may be left out, and these guides have none.
TEST_F(LodPictureTest, ClustersOfNoErrorAreLevelZero) {
    for (const Backend backend : {Backend::tessellation, Backend::expanded, Backend::software}) {
        Settings settings = with(small(), backend);
        settings.camera.position = {0.0f, 0.1f, 1.0f};
        const groom::Groom groom = tangledGroom(8);
        const auto draw_groom = [&] { return drawGroom(device(), settings, groom, nullptr); };
        const Pixels full = draw_groom();
        settings.lod = {.mode = LodMode::cluster, .error = 0.01f};
        EXPECT_EQ(differingPixels(draw_groom(), full), 0u);
        settings.lod.error = 10.0f;
        EXPECT_GT(differingPixels(draw_groom(), full), 100u);
    }
}

TEST_F(LodPictureTest, FarHairIsThatOfTheMaximumLevel) {
    Settings settings = small();
    const Pixels full = draw(settings);
    settings.lod.level = 1.0f;
    const Pixels forced = draw(settings);
    EXPECT_GT(differingPixels(full, forced), 0u);
    settings.lod = {
        .mode = LodMode::distance,
        .near_distance = 0.05f,
        .far_distance = 0.1f,
        .maximum_level = 1.0f};
    EXPECT_EQ(differingPixels(draw(settings), forced), 0u);
}

// Above the width at which strand_plan.h limits strands, distance alone draws no coarser ones.
TEST_F(LodPictureTest, StrandsStopAtTheirGreatestWidth) {
    Settings settings = small();
    settings.strands.tessellation = 1;
    settings.lod = {.mode = LodMode::distance, .near_distance = 0.05f, .far_distance = 0.1f};
    settings.lod.maximum_level = 4.0f;
    const Pixels four = draw(settings);
    settings.lod.maximum_level = 8.0f;
    EXPECT_EQ(differingPixels(draw(settings), four), 0u);
    settings.lod.maximum_level = 1.0f;
    EXPECT_GT(differingPixels(draw(settings), four), 0u);
}

// The camera is 1 m to 20 m away. The hair is equally large in all pictures, with 16 samples a
// pixel. Level 0 covers some 160,000 samples, which vary by 0.1 % at random. strand_plan.h lets
// the outline grow by 3 %.
TEST_F(LodPictureTest, KeepsCoverageFromOneToTwentyMetres) {
    Settings settings = thesisAtRest();
    settings.render = {.width = 128, .height = 128, .ssaa = 4, .background = glm::vec3(0.0f)};
    settings.render.head = false;
    settings.shading.color = glm::vec3(1.0f);
    settings.shading.ambient = 1.0f;
    settings.shading.diffuse = 0.0f;
    settings.shading.specular = 0.0f;
    const auto coverage = [&](LodMode mode) {
        settings.lod.mode = mode;
        return benchmarks::lod::whiteShare(draw(settings));
    };
    for (const float distance : {1.0f, 3.0f, 8.0f, 20.0f}) {
        settings.camera.position = {0.0f, 0.0f, distance};
        settings.camera.field_of_view = std::max(2.0f * glm::degrees(0.2f / distance), 1.0f);
        const double full = coverage(LodMode::forced);
        EXPECT_GT(full, 0.15);
        EXPECT_NEAR(coverage(LodMode::distance) / full, 1.0, 0.03) << distance << " m";
    }
}

// Half as many strands of twice the width have the same total area and, at random places, the same
// chance to cover a pixel. There are three differences:
//  - the outline moves out by half of a strand's growth. A strand is 1.25 mm wide on average,
//    2.5 mm at level 1 and 5 mm at level 2; round a disc of radius 0.15 m an outline 0.6 or 1.9 mm
//    farther out adds 0.8 or 2.5 % of area;
//  - strands are chords of their curves, 2 and 1 a segment instead of 4: below 1 % at these bends;
//  - chance: the 544 strands of level 2 cover each about 1/544 of the area; their sum varies by
//    1 / sqrt(544) = 4 %.
// Together they are below 10 %. Strands that did not widen would lose far more than that.
TEST_F(LodPictureTest, CoveredAreaIsKept) {
    Settings settings = thesisAtRest();
    settings.render.width = 480;
    settings.render.height = 480;
    settings.camera.position = {0.0f, 0.0f, 0.7f};
    settings.camera.field_of_view = 50.0f;  // 0.65 m in 480 px
    settings.strands.density = 16;
    const Pixels bald = drawBald(device(), settings);
    const auto area = [&] { return static_cast<double>(differingPixels(draw(settings), bald)); };

    const double full = area();
    EXPECT_GT(full, 0.1 * 480 * 480);
    for (const float level : {1.0f, 2.0f}) {
        settings.lod.level = level;
        EXPECT_NEAR(area() / full, 1.0, 0.1) << "level " << level;
    }
    settings.strands.root_width /= 4.0f;  // as for level 2 if the strands had kept their width
    settings.strands.tip_width /= 4.0f;
    EXPECT_LT(area() / full, 0.8);
}

}  // namespace
}  // namespace hair::rendering
