#include "benchmarks/viewer/player.h"

#include <gtest/gtest.h>

namespace benchmarks::viewer {
namespace {

constexpr double kExactFrame = 1.0 / 64.0;  // simulated s; its sums are exact

std::uint32_t framesOf(Pacer& pacer, int pictures, double seconds, std::optional<double> speed) {
    std::uint32_t frames = 0;
    for (int i = 0; i < pictures; ++i) frames += pacer.framesFor(seconds, kExactFrame, speed);
    return frames;
}

TEST(Pacer, PlaysAFrameForEveryPictureWithoutASpeed) {
    Pacer pacer;
    for (const double seconds : {0.0, 1e-6, 0.5, 100.0})
        EXPECT_EQ(pacer.framesFor(seconds, kExactFrame, std::nullopt), 1u);
    EXPECT_EQ(pacer.framesFor(0.1, 0.0, std::nullopt), 1u);
}

TEST(Pacer, LetsAsMuchTimeGoByAsTheSpeedSays) {
    struct Case {
        double speed, picture;
    };
    for (const Case& each :
         {Case{1.0, kExactFrame},
          {1.0, kExactFrame / 4},
          {1.0, kExactFrame * 4},
          {0.25, kExactFrame},
          {0.5, kExactFrame / 2},
          {2.0, kExactFrame},
          {4.0, kExactFrame * 2}}) {
        Pacer pacer;
        constexpr int kPictures = 256;
        const double simulated = kPictures * each.picture * each.speed;
        EXPECT_EQ(framesOf(pacer, kPictures, each.picture, each.speed), simulated / kExactFrame)
            << each.speed << "x, " << each.picture << " s";
    }
}

TEST(Pacer, KeepsTheRestOfAFrameForTheNextPicture) {
    Pacer pacer;
    EXPECT_EQ(pacer.framesFor(kExactFrame * 0.75, kExactFrame, 1.0), 0u);
    EXPECT_EQ(pacer.framesFor(kExactFrame * 0.75, kExactFrame, 1.0), 1u);
    EXPECT_EQ(pacer.framesFor(kExactFrame * 0.5, kExactFrame, 1.0), 1u);
    EXPECT_EQ(pacer.framesFor(kExactFrame * 0.5, kExactFrame, 1.0), 0u);
}

TEST(Pacer, FallsBehindRatherThanPlayingForever) {
    Pacer pacer;
    EXPECT_EQ(pacer.framesFor(3600.0, kExactFrame, 1.0), Pacer::kMostFrames);
    // It does not catch up later.
    EXPECT_EQ(pacer.framesFor(0.0, kExactFrame, 1.0), 0u);
}

TEST(Pacer, StandsStillAtNoSpeedAndWithoutTime) {
    Pacer pacer;
    EXPECT_EQ(framesOf(pacer, 100, 1.0, 0.0), 0u);
    EXPECT_EQ(framesOf(pacer, 100, 0.0, 4.0), 0u);
    EXPECT_EQ(pacer.framesFor(1.0, 0.0, 1.0), 0u);
}

TEST(Pacer, ForgetsWhatWasDueWhereEveryFrameIsPlayed) {
    Pacer pacer;
    EXPECT_EQ(pacer.framesFor(kExactFrame * 0.75, kExactFrame, 1.0), 0u);
    EXPECT_EQ(pacer.framesFor(kExactFrame, kExactFrame, std::nullopt), 1u);
    EXPECT_EQ(pacer.framesFor(kExactFrame * 0.75, kExactFrame, 1.0), 0u);
}

}  // namespace
}  // namespace benchmarks::viewer
