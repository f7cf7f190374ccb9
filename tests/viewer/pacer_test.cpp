#include "benchmarks/viewer/player.h"

#include <gtest/gtest.h>

namespace benchmarks::viewer {
namespace {

constexpr double kFrame = 1.0 / 64.0;  // simulated s; sums of it are exact

std::uint32_t framesOf(Pacer& pacer, int pictures, double seconds, std::optional<double> speed) {
    std::uint32_t frames = 0;
    for (int i = 0; i < pictures; ++i) frames += pacer.framesFor(seconds, kFrame, speed);
    return frames;
}

TEST(Pacer, PlaysAFrameForEveryPictureWithoutASpeed) {
    Pacer pacer;
    for (const double seconds : {0.0, 1e-6, 0.5, 100.0})
        EXPECT_EQ(pacer.framesFor(seconds, kFrame, std::nullopt), 1u);
    EXPECT_EQ(pacer.framesFor(0.1, 0.0, std::nullopt), 1u);
}

TEST(Pacer, LetsAsMuchTimeGoByAsTheSpeedSays) {
    struct Case {
        double speed, picture;
    };
    for (const Case& each :
         {Case{1.0, kFrame},
          {1.0, kFrame / 4},
          {1.0, kFrame * 4},
          {0.25, kFrame},
          {0.5, kFrame / 2},
          {2.0, kFrame},
          {4.0, kFrame * 2}}) {
        Pacer pacer;
        constexpr int kPictures = 256;
        const double simulated = kPictures * each.picture * each.speed;
        EXPECT_EQ(framesOf(pacer, kPictures, each.picture, each.speed), simulated / kFrame)
            << each.speed << "x, " << each.picture << " s";
    }
}

TEST(Pacer, KeepsTheRestOfAFrameForTheNextPicture) {
    Pacer pacer;
    EXPECT_EQ(pacer.framesFor(kFrame * 0.75, kFrame, 1.0), 0u);
    EXPECT_EQ(pacer.framesFor(kFrame * 0.75, kFrame, 1.0), 1u);
    EXPECT_EQ(pacer.framesFor(kFrame * 0.5, kFrame, 1.0), 1u);
    EXPECT_EQ(pacer.framesFor(kFrame * 0.5, kFrame, 1.0), 0u);
}

TEST(Pacer, FallsBehindRatherThanPlayingForever) {
    Pacer pacer;
    EXPECT_EQ(pacer.framesFor(3600.0, kFrame, 1.0), Pacer::kMostFrames);
    // And does not make up for it.
    EXPECT_EQ(pacer.framesFor(0.0, kFrame, 1.0), 0u);
}

TEST(Pacer, StandsStillAtNoSpeedAndWithoutTime) {
    Pacer pacer;
    EXPECT_EQ(framesOf(pacer, 100, 1.0, 0.0), 0u);
    EXPECT_EQ(framesOf(pacer, 100, 0.0, 4.0), 0u);
    EXPECT_EQ(pacer.framesFor(1.0, 0.0, 1.0), 0u);
}

TEST(Pacer, ForgetsWhatWasDueWhereEveryFrameIsPlayed) {
    Pacer pacer;
    EXPECT_EQ(pacer.framesFor(kFrame * 0.75, kFrame, 1.0), 0u);
    EXPECT_EQ(pacer.framesFor(kFrame, kFrame, std::nullopt), 1u);
    EXPECT_EQ(pacer.framesFor(kFrame * 0.75, kFrame, 1.0), 0u);
}

}  // namespace
}  // namespace benchmarks::viewer
