#include <gtest/gtest.h>

#include "tests/gpu_fixture.h"
#include "tests/rendering/pictures.h"

namespace hair::rendering {
namespace {

class TransparentPictureTest : public GpuTest {
protected:
    static Settings small() {
        Settings settings = thesisAtRest();
        settings.render.width = 200;
        settings.render.height = 112;
        settings.render.list_length = 64;
        return settings;
    }

    static std::vector<Settings> allKinds() {
        std::vector<Settings> kinds;
        for (const Transparency transparency :
             {Transparency::alpha_to_coverage, Transparency::weighted_blended,
              Transparency::fragment_list}) {
            Settings settings = small();
            settings.render.transparency = transparency;
            settings.render.coverage = Coverage::analytic;
            settings.strands.opacity = 0.7f;
            if (transparency == Transparency::alpha_to_coverage) settings.render.msaa = 4;
            if (device().supportsSamples(settings.render.msaa)) kinds.push_back(settings);
        }
        return kinds;
    }
};

// On processors the back ends agree to the bit. A GPU's compiler rounds differently in another
// stage (backend_picture_test), which may take a sum of weights to the next step.
TEST_F(TransparentPictureTest, BackEndsAgree) {
    const bool is_processor = device().info().type == engine::DeviceType::cpu;
    for (Settings settings : allKinds()) {
        const Pixels tessellated = drawCase(device(), settings);
        settings.strands.backend = Backend::pulling_geometry;
        EXPECT_LE(
            differingPixels(tessellated, drawCase(device(), settings), is_processor ? 0 : 1),
            is_processor ? 0u : tessellated.size() / 4 / 1000)
            << static_cast<int>(settings.render.transparency);
    }
}

TEST_F(TransparentPictureTest, OpacityIsNothingWithoutTransparency) {
    Settings settings = small();
    const Pixels opaque = drawCase(device(), settings);
    settings.strands.opacity = 0.3f;
    EXPECT_EQ(differingPixels(opaque, drawCase(device(), settings)), 0u);
}

// The nearest of opaque fragments is seen, as without a list. Colours in half floats are right to a
// step of 8-bit ones. If two fragments are at the same depth, either may be seen: a step of 32-bit
// depth is 0.05 um there.
TEST_F(TransparentPictureTest, OpaqueListsAreTheOpaquePicture) {
    Settings settings = small();
    const Pixels opaque = drawCase(device(), settings);
    settings.render.transparency = Transparency::fragment_list;
    const Pixels listed = drawCase(device(), settings);
    ASSERT_EQ(listed.size(), opaque.size());
    for (std::size_t i = 0; i < opaque.size(); ++i) ASSERT_NEAR(listed[i], opaque[i], 1) << i;
}

// Frames follow one another without waiting, so each must be finished with the resources that they
// share. The fixture fails on a message of synchronisation validation.
TEST_F(TransparentPictureTest, FramesInFlightAreAllTheSame) {
    for (const Settings& settings : allKinds()) {
        benchmarks::measure::Case picture(device(), settings, HAIRBENCH_SOURCE_DIR "/scenes");
        engine::FrameLoop loop(device(), engine::Timing::overlapped);
        loop.frame([&](engine::Passes& passes) { picture.frame(passes); });
        loop.finish();
        const Pixels first = picture.picture();
        for (int i = 0; i < 3; ++i)
            loop.frame([&](engine::Passes& passes) { picture.frame(passes); });
        loop.finish();
        EXPECT_EQ(differingPixels(first, picture.picture()), 0u)
            << static_cast<int>(settings.render.transparency);
    }
}

// Guides are drawn over hair that wrote no depth.
TEST_F(TransparentPictureTest, OverlaysAreSeenThroughTheHair) {
    Settings settings = small();
    settings.render.transparency = Transparency::fragment_list;
    const Pixels hair = drawCase(device(), settings);
    settings.render.overlays.guides = true;
    const Pixels both = drawCase(device(), settings);
    EXPECT_GT(differingPixels(hair, both), 100u);
    settings.strands.root_width = settings.strands.tip_width = 0.0f;
    settings.render.transparency = Transparency::none;
    settings.render.overlays.guides = false;
    const Pixels bald = drawCase(device(), settings);
    settings.render.overlays.guides = true;
    const Pixels guides = drawCase(device(), settings);
    for (std::size_t i = 0; i < bald.size(); i += 4) {
        if (std::equal(&guides[i], &guides[i] + 4, &bald[i])) continue;
        ASSERT_TRUE(std::equal(&both[i], &both[i] + 4, &guides[i])) << "pixel " << i / 4;
    }
}

}  // namespace
}  // namespace hair::rendering
