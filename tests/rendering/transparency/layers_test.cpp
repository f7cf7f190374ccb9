#include <gtest/gtest.h>

#include "hair/rendering/shadow_pass.h"
#include "tests/rendering/transparency/layers.h"

namespace hair::rendering {
namespace {

class LayersTest : public TransparencyTest {
protected:
    // Half a step of 8-bit colours, and colours in half floats with an error of 2^-11 for each
    // layer. The grey takes as much again: it is not quite linear from side to side.
    static constexpr double kTolerance = 1.0 / 255;

    static void expectInOrder(const std::vector<double>& depths, float opacity) {
        Settings settings = layered(opacity);
        settings.render.transparency = Transparency::fragment_list;
        settings.render.list_length = 64;
        const double expected = over(layersInTheMiddle(depths), static_cast<double>(opacity), 0.2);
        EXPECT_NEAR(middle(draw(settings, layerLines(depths))), expected, kTolerance);
    }
};

TEST_F(LayersTest, ListsAreBlendedInOrderWhateverIsDrawnFirst) {
    expectInOrder({-0.03, 0.0, 0.03}, 0.4f);
    expectInOrder({0.03, 0.0, -0.03}, 0.4f);
    expectInOrder({0.0, 0.04, -0.03, 0.02}, 1.0f);
}

// More layers than composite/list.frag sorts at a time, and all of them are visible: 0.95^50 =
// 0.08.
TEST_F(LayersTest, LongListsAreBlendedToTheirEnd) {
    std::vector<double> depths;
    for (int i = 0; i < 50; ++i) depths.push_back(0.0016 * (i * 17 % 50) - 0.04);
    expectInOrder(depths, 0.05f);
}

TEST_F(LayersTest, OneWeightedLayerIsOver) {
    for (const float opacity : {0.1f, 0.5f, 0.9f}) {
        Settings settings = layered(opacity);
        settings.render.transparency = Transparency::weighted_blended;
        const double expected = over(layersInTheMiddle({0.02}), static_cast<double>(opacity), 0.2);
        EXPECT_NEAR(middle(draw(settings, layerLines({0.02}))), expected, kTolerance);
    }
}

TEST_F(LayersTest, WeightedLayersAreThePublishedMean) {
    const std::vector<double> depths{0.03, -0.03, 0.0, 0.01};
    for (const float opacity : {0.2f, 0.6f}) {
        Settings settings = layered(opacity);
        settings.render.transparency = Transparency::weighted_blended;
        const Sphere sphere = strandBounds(straightStrands(layerLines(depths)), settings.strands);
        const double expected = weighted(
            layersInTheMiddle(depths), static_cast<double>(opacity), 0.2, sphere.centre,
            static_cast<double>(sphere.radius));
        EXPECT_NEAR(middle(draw(settings, layerLines(depths))), expected, kTolerance);
    }
}

// Three layers that each cover random samples leave (1 - opacity)^3 of the background, as a mean
// over many pixels: layers must not choose the same samples. A sample's variance is at most 1/4,
// and 40 x 100 pixels have 4 each: 4 standard deviations are 0.016.
TEST_F(LayersTest, RandomSamplesOfSeveralLayersAreIndependent) {
    if (!device().supportsSamples(4)) GTEST_SKIP() << "no 4-sample images";
    Settings settings = whiteStrands(1.0);
    settings.strands.root_width = settings.strands.tip_width = kLayerWidth;
    settings.strands.opacity = 0.3f;
    settings.render.msaa = 4;
    settings.render.transparency = Transparency::alpha_to_coverage;
    const Pixels pixels = draw(settings, layerLines({0.0, 0.01, 0.02}));
    double sum = 0.0;
    for (std::uint32_t y = 46; y < 146; ++y)
        for (std::uint32_t x = 76; x < 116; ++x) sum += pixels[4 * (y * kSide + x)] / 255.0;
    EXPECT_NEAR(sum / 4000, 1 - 0.7 * 0.7 * 0.7, 0.016);
}

// A wall in the middle hides the layers behind it, but not those in front of it.
TEST_F(LayersTest, MeshesHideWhatIsBehindThem) {
    const groom::Mesh wall{
        .positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}},
        .normals = std::vector<glm::vec3>(4, {0.0f, 0.0f, 1.0f}),
        .triangles = {{0, 1, 2}, {0, 2, 3}},
        .triangle_materials = {0, 0},
        .materials = {{.name = "wall"}}};
    for (const Transparency transparency :
         {Transparency::weighted_blended, Transparency::fragment_list}) {
        Settings settings = layered(0.5f);
        settings.render.transparency = transparency;
        const Pixels bare = draw(settings, layerLines({-0.04}), &wall);
        settings.render.hair = false;
        EXPECT_EQ(differingPixels(draw(settings, layerLines({-0.04}), &wall), bare), 0u);
        settings.render.hair = true;
        const Pixels both = draw(settings, layerLines({-0.04, 0.02}), &wall);
        const double expected = over(layersInTheMiddle({0.02}), 0.5, middle(bare));
        EXPECT_NEAR(middle(both), expected, kTolerance);
    }
}

}  // namespace
}  // namespace hair::rendering
