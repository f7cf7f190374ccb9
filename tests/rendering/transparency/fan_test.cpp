#include <algorithm>

#include <gtest/gtest.h>

#include "tests/rendering/transparency/straight_strands.h"

// The sum of the strands' coverage over the picture is their length times their width.
namespace hair::rendering {
namespace {

class FanTest : public TransparencyTest {
protected:
    // Samples lie along the strand, so a length of 27.3 px is wrong by up to a pixel at random.
    // For 25 strands 0.3 % of that is left. The coverage must be right to 2 %.
    static constexpr double kTolerance = 0.02;

    static void expectArea(const Settings& settings, double width) {
        EXPECT_NEAR(covered(draw(settings, fan())) / area(fan(), width), 1.0, kTolerance)
            << width << " px";
    }
};

TEST_F(FanTest, AnalyticCoverageIsTheAreaAtEveryWidth) {
    for (const double width : {0.1, 0.25, 0.5, 1.0, 2.0, 4.0}) {
        const Settings settings = whiteStrands(width);
        expectArea(withAnalyticCoverage(settings, Transparency::weighted_blended), width);
    }
    expectArea(withAnalyticCoverage(whiteStrands(0.5), Transparency::fragment_list), 0.5);
}

TEST_F(FanTest, AnalyticCoverageIsTheAreaWithFourSamples) {
    if (!device().supportsSamples(4)) GTEST_SKIP() << "no 4-sample images";
    for (const double width : {0.25, 2.0}) {
        Settings settings = whiteStrands(width);
        settings.render.msaa = 4;
        expectArea(withAnalyticCoverage(settings, Transparency::weighted_blended), width);
        // If two quads of a strand share a pixel, "over" subtracts their product. For the 11 joints
        // of 27.3 px, that is at most 1/4 of a pixel.
        settings = withAnalyticCoverage(settings, Transparency::fragment_list);
        const double found = covered(draw(settings, fan())) / area(fan(), width);
        EXPECT_LT(found, 1.0 + kTolerance) << width;
        EXPECT_GT(found, 1.0 - kTolerance - 0.25 * 11 / kLength * std::min(width, 1.0)) << width;
    }
}

// Samples 1/4 px apart measure strands of 1 px or more to 2 %: every row of a strand has at least 4
// of them across, and 25 strands have 2,700 rows, each off by less than a sample, at random.
TEST_F(FanTest, SamplesFindTheAreaOfStrandsAsWideAsAPixel) {
    for (const double width : {1.0, 2.0, 4.0}) {
        Settings settings = whiteStrands(width);
        settings.render.ssaa = 4;
        expectArea(settings, width);
        if (!device().supportsSamples(4)) continue;
        settings.render.ssaa = 2;
        settings.render.msaa = 4;
        expectArea(settings, width);
    }
}

TEST_F(FanTest, ThinStrandsHaveNoGaps) {
    const std::vector<Line> lines = fan();
    const Pixels pixels =
        draw(withAnalyticCoverage(whiteStrands(0.25), Transparency::weighted_blended), lines);
    const Pixels sampled = draw(whiteStrands(0.25), lines);
    int gaps_when_sampled = 0;
    for (const Line& line : lines) {
        const glm::dvec2 root = glm::dvec2(line.root) / double{kPixel} * glm::dvec2(1, -1);
        const glm::dvec2 tip = glm::dvec2(line.tip) / double{kPixel} * glm::dvec2(1, -1);
        // Up to a pixel from the ends, the centre of a pixel may lie beyond them.
        for (double part = 0.05; part < 0.95; part += 0.01) {
            const glm::dvec2 at = root + part * (tip - root) + 0.5 * kSide;
            const std::size_t i =
                4 * (static_cast<std::size_t>(at.y) * kSide + static_cast<std::size_t>(at.x));
            // A pixel that the strand only grazes has less than a step of 8-bit colours, so the
            // test requires the strand to be within half a pixel of the pixel's centre.
            const glm::dvec2 direction = glm::normalize(tip - root);
            const glm::dvec2 offset = glm::floor(at) + 0.5 - at;
            if (std::abs(direction.x * offset.y - direction.y * offset.x) > 0.5) continue;
            EXPECT_GT(pixels[i], 0) << at.x << " " << at.y;
            gaps_when_sampled += sampled[i] == 0;
        }
    }
    EXPECT_GT(gaps_when_sampled, 100);  // the test would detect gaps
}

// Each strand's samples are covered at random by at most 1 of 4 too many or too few, with variance
// f (1 - f) / 16 <= 1 / 64 in each of some 25 * 27.3 * (width + 1.3) pixels; 4 standard deviations.
TEST_F(FanTest, RandomSamplesCoverTheAreaInTheMean) {
    if (!device().supportsSamples(4)) GTEST_SKIP() << "no 4-sample images";
    for (const double width : {0.25, 1.0, 4.0}) {
        Settings settings = whiteStrands(width);
        settings.render.msaa = 4;
        const double pixels = 25 * kLength * (width + 1.3);
        const double random = 4 * std::sqrt(pixels / 64) / area(fan(), width);
        const Settings analytic = withAnalyticCoverage(settings, Transparency::alpha_to_coverage);
        EXPECT_NEAR(covered(draw(analytic, fan())) / area(fan(), width), 1.0, kTolerance + random)
            << width;
    }
}

// The light of a strand thinner than a pixel is the mean over its width. On a cylinder lit from
// the side, the normal at the share h of its width has the component h in that direction. The mean
// of max(h, 0) over [-1, 1] is 1/4, times the cosine of the strand's angle to the vertical.
TEST_F(FanTest, ThinStrandsShowTheMeanOverTheirWidth) {
    std::vector<Line> lines;
    double expected = 0.0;
    for (int i = 0; i < 9; ++i) {
        const double turn = 0.05 * (i - 4) + 0.013;
        const glm::dvec2 half = 25.0 * glm::dvec2(std::sin(turn), std::cos(turn));
        const glm::dvec2 centre(16.0 + 20.1 * i, 96.0);
        lines.push_back({inPlane(centre - half), inPlane(centre + half)});
        expected += 50.0 * 0.25 * std::cos(turn);
    }
    for (const double width : {0.4, 1.0, 3.0}) {
        Settings settings = whiteStrands(width);
        settings.shading.ambient = 0.0f;
        settings.shading.diffuse = 1.0f;
        settings.shading.lights = {{.position = {1000.0f, 0.0f, 0.0f}}};
        const Pixels pixels =
            draw(withAnalyticCoverage(settings, Transparency::weighted_blended), lines);
        // 8-bit values below 0.1 are rounded by up to 2 %, at random.
        EXPECT_NEAR(covered(pixels) / (expected * width), 1.0, 0.03) << width;
    }
}

}  // namespace
}  // namespace hair::rendering
