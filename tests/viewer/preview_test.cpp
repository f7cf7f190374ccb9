#include "benchmarks/viewer/player.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "hair/fields.h"
#include "hair/settings.h"

namespace benchmarks::viewer {
namespace {

constexpr double kAim = PreviewControl::kAim;

// A scene whose whole picture takes `whole` ms. Each level takes `ratio` times as long as the next
// coarser one.
struct Device {
    double whole = 0.0;
    double ratio = 2.0;

    double took(unsigned level) const {
        return whole / std::pow(ratio, static_cast<double>(level));
    }
};

// Returns the levels of pictures drawn during motion.
std::vector<unsigned> levelsWhileMoving(PreviewControl& control, const Device& device, int count) {
    std::vector<unsigned> levels;
    for (int i = 0; i < count; ++i) {
        levels.push_back(control.moving());
        control.drawn(levels.back(), device.took(levels.back()));
    }
    return levels;
}

int changesOf(const std::vector<unsigned>& levels) {
    int changes = 0;
    for (std::size_t i = 1; i < levels.size(); ++i) changes += levels[i] != levels[i - 1];
    return changes;
}

// ---- Choice of the level

TEST(PreviewControl, DrawsAllOfASceneThatIsFastEnough) {
    PreviewControl control;
    for (const unsigned level : levelsWhileMoving(control, {.whole = kAim}, 50))
        EXPECT_EQ(level, 0u);
}

TEST(PreviewControl, GetsWithinItsAimAfterOnePictureOfAScene) {
    for (const double times : {1.5, 3.0, 7.0, 15.0}) {
        PreviewControl control;
        const Device device{.whole = times * kAim};
        control.drawn(0, device.took(0));
        EXPECT_LE(device.took(control.moving()), kAim) << times;
        // No coarser than necessary.
        EXPECT_GT(device.took(control.moving() - 1), kAim) << times;
    }
}

// The level for motion keeps to the aim by an estimate from the first picture: a level should take
// at most twice as long as the next coarser one.
TEST(PreviewControl, LearnsFromACoarseFirstPicture) {
    for (const double times : {0.5, 3.0, 7.0, 100.0}) {
        PreviewControl control;
        const Device device{.whole = times * kAim};
        control.drawn(PreviewControl::kFirst, device.took(PreviewControl::kFirst));
        const unsigned level = control.moving();
        EXPECT_LE(level, PreviewControl::kFirst);
        if (level < PreviewControl::kFirst) {
            EXPECT_LE(device.took(level), kAim) << times;
        }
        if (level > 0) {
            EXPECT_GT(device.took(level - 1), kAim) << times;
        }
    }
}

TEST(PreviewControl, DrawsTheCoarsestWhereNoneIsFastEnough) {
    PreviewControl control;
    control.drawn(0, 26000.0);
    EXPECT_EQ(control.moving(), kCoarsestPreview);
    for (const unsigned level : levelsWhileMoving(control, {.whole = 26000.0}, 20))
        EXPECT_EQ(level, kCoarsestPreview);
}

// As the header says: two consecutive coarsest pictures over a second.
TEST(PreviewControl, CrawlsWhereTwoCoarsestPicturesTakeOverASecond) {
    PreviewControl control;
    control.drawn(0, 60000.0);
    control.drawn(kCoarsestPreview, 1500.0);
    EXPECT_FALSE(control.crawls());
    control.drawn(kCoarsestPreview, 900.0);
    control.drawn(kCoarsestPreview, 1500.0);
    EXPECT_FALSE(control.crawls());
    control.drawn(kCoarsestPreview, 1500.0);
    EXPECT_TRUE(control.crawls());
    control.drawn(kCoarsestPreview, 900.0);
    EXPECT_FALSE(control.crawls());
}

// A first picture may be slow because it includes set-up.
TEST(PreviewControl, ComesBackFromASingleSlowPicture) {
    PreviewControl control;
    control.drawn(0, 20000.0);
    const std::vector<unsigned> levels = levelsWhileMoving(control, {.whole = 20.0}, 40);
    EXPECT_EQ(levels.front(), kCoarsestPreview);
    EXPECT_EQ(levels.back(), 0u);
    EXPECT_TRUE(std::ranges::is_sorted(levels, std::ranges::greater{}));
}

// If a level takes up to 2.5 times as long as the next one, a finer level is tried only if it fits.
TEST(PreviewControl, HoldsItsLevelBetweenTooSlowAndTooCoarse) {
    for (const double ratio : {1.5, 2.0, 2.5}) {
        for (double whole = 20.0; whole < 1500.0; whole *= 1.1) {
            PreviewControl control;
            const std::vector<unsigned> levels =
                levelsWhileMoving(control, {.whole = whole, .ratio = ratio}, 200);
            const std::vector<unsigned> later(levels.begin() + 60, levels.end());
            EXPECT_EQ(changesOf(later), 0) << whole << " " << ratio;
        }
    }
}

// With larger steps than expected, the finer level is always too slow and is tried less often each
// time.
TEST(PreviewControl, TriesAFinerLevelThatIsTooSlowLessAndLessOften) {
    PreviewControl control;
    const Device device{.whole = 400.0, .ratio = 20.0};
    const auto tried = [&](int pictures) {
        const std::vector<unsigned> levels = levelsWhileMoving(control, device, pictures);
        return std::ranges::count(levels, 0u);
    };
    const auto early = tried(100), late = tried(1000);
    EXPECT_GE(early, 2);
    EXPECT_LE(late, early);
}

TEST(PreviewControl, FollowsASceneThatBecomesFaster) {
    PreviewControl control;
    levelsWhileMoving(control, {.whole = 1500.0}, 20);
    EXPECT_EQ(control.moving(), 4u);
    levelsWhileMoving(control, {.whole = 60.0}, 40);
    EXPECT_EQ(control.moving(), 0u);
}

TEST(PreviewControl, TakesNothingThatIsNoTimeForOne) {
    PreviewControl control;
    control.drawn(0, 0.0);  // nothing was drawn
    control.drawn(0, -1.0);
    control.drawn(0, std::nan(""));
    control.drawn(kCoarsestPreview + 1, 5000.0);
    EXPECT_EQ(control.moving(), 0u);
    EXPECT_EQ(control.expected(0), 0.0);
}

// ---- Refinement

TEST(PreviewControl, KeepsWholePicturesThatStandStill) {
    PreviewControl control;
    control.drawn(0, 13000.0);
    EXPECT_EQ(control.still(0, 1000.0), 0u);
}

TEST(PreviewControl, RefinesAtOnceWhatIsHardlyNoticed) {
    PreviewControl control;
    control.drawn(0, 200.0);
    EXPECT_EQ(control.still(1, 0.0), 1u);  // motion may continue
    EXPECT_EQ(control.still(1, 0.2), 0u);
    EXPECT_EQ(control.still(4, 0.2), 0u);
}

// Goes through every level. The last one takes long, so it comes only after a while.
TEST(PreviewControl, RefinesByLevelsWhatTakesLong) {
    PreviewControl control;
    const Device device{.whole = 13000.0};
    control.drawn(0, device.took(0));
    control.drawn(4, device.took(4));
    double seconds = 0.0;
    unsigned shown = 4;
    double before = 0.0;
    while (shown > 0) {
        const unsigned next = control.still(shown, seconds);
        if (next == shown) {
            seconds += 0.01;
            ASSERT_LE(seconds, 3.02);
            continue;
        }
        EXPECT_EQ(next, shown - 1);
        EXPECT_GE(seconds, before);
        before = seconds;
        control.drawn(next, device.took(next));
        shown = next;
    }
    EXPECT_GE(seconds, 2.9);
}

TEST(PreviewControl, ExpectsWhatItKnowsAndTwiceAsMuchForEachFinerLevel) {
    PreviewControl control;
    control.drawn(2, 30.0);
    EXPECT_EQ(control.expected(2), 30.0);
    EXPECT_EQ(control.expected(1), 60.0);
    EXPECT_EQ(control.expected(0), 120.0);
    control.drawn(0, 500.0);
    EXPECT_EQ(control.expected(0), 500.0);
}

// ---- Levels

TEST(PreviewSettings, DifferInLevelOfDetailAndPixelsAlone) {
    hair::Settings settings;
    settings.render.width = 1280;
    settings.render.height = 720;
    settings.render.msaa = 4;
    settings.lod.level = 1.0f;
    EXPECT_FALSE(hair::differ(previewSettings(settings, 0), settings));
    hair::Settings coarse = previewSettings(settings, 3);
    EXPECT_EQ(coarse.lod.level, 4.0f);
    EXPECT_EQ(coarse.render.width, 480u);
    EXPECT_EQ(coarse.render.height, 270u);
    EXPECT_EQ(coarse.render.msaa, 1u);
    coarse.lod = settings.lod;
    coarse.render.width = settings.render.width;
    coarse.render.height = settings.render.height;
    coarse.render.msaa = settings.render.msaa;
    EXPECT_FALSE(hair::differ(coarse, settings));
}

TEST(PreviewSettings, AreWithinWhatScenesAllow) {
    hair::Settings settings;
    settings.render.width = settings.render.height = 1;
    settings.lod.level = 7.5f;
    const hair::Settings coarse = previewSettings(settings, kCoarsestPreview);
    EXPECT_EQ(coarse.render.width, 1u);
    EXPECT_EQ(coarse.render.height, 1u);
    EXPECT_EQ(coarse.lod.level, 8.0f);
}

// Half way on the logarithmic scale of distance: hair/settings.h.
TEST(PreviewSettings, AddToTheLevelAtTheCamerasTarget) {
    hair::Settings settings;
    settings.lod = {
        .mode = hair::LodMode::distance,
        .near_distance = 0.5f,
        .far_distance = 8.0f,
        .maximum_level = 4.0f};
    settings.camera.target = {0, 0, 0};
    settings.camera.position = {0, 0, 2};
    const hair::Settings coarse = previewSettings(settings, 1);
    EXPECT_EQ(coarse.lod.mode, hair::LodMode::forced);
    EXPECT_NEAR(coarse.lod.level, 3.0f, 1e-5f);
    settings.camera.position = {0, 0, 0.25f};
    EXPECT_EQ(previewSettings(settings, 1).lod.level, 1.0f);
    settings.camera.position = {0, 0, 100};
    EXPECT_EQ(previewSettings(settings, 1).lod.level, 5.0f);
}

TEST(PreviewText, SaysLevelStrandsAndPixels) {
    EXPECT_EQ(
        previewText(3, 0.124, 480, 270), "preview, level 3 of 7: 12 % of strands at 480 × 270");
    EXPECT_EQ(
        previewText(4, 0.004, 320, 180),
        "preview, level 4 of 7: under 1 % of strands at 320 × 180");
}

}  // namespace
}  // namespace benchmarks::viewer
