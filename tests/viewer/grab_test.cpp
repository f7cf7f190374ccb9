#include "benchmarks/viewer/toolbar.h"

#include <vector>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "benchmarks/viewer/player.h"

namespace benchmarks::viewer {
namespace {

constexpr double kFrame = 1.0 / 60.0;  // s
using Path = std::vector<hair::PullKey>;

Moment after(std::uint32_t frame) { return momentAfter(frame, kFrame, kFrame); }

Path begun(std::uint32_t frame) { return {{after(frame).now, {0, 0, 0}}}; }

void expectAscending(const Path& path) {
    for (std::size_t i = 1; i < path.size(); ++i) EXPECT_LT(path[i - 1].time, path[i].time) << i;
}

TEST(Moment, IsThePlayersTimeToTheLastBit) {
    for (std::uint32_t frame = 0; frame < 2000; ++frame)
        ASSERT_EQ(after(frame).next, after(frame + 1).now) << frame;
    EXPECT_EQ(after(59).now, 1.0f);
}

TEST(Moment, AscendsWhereNoTimePassesAndWhereFloatsEnd) {
    const Moment still = momentAfter(7, 0.0, 0.01);
    EXPECT_EQ(still.now, 0.0f);
    EXPECT_LT(still.now, still.next);
    EXPECT_LT(still.next, still.later);
    const Moment late = momentAfter(4'000'000'000u, 1e-5, 1e-3);  // floats are 0.004 apart there
    EXPECT_LT(late.now, late.next);
    EXPECT_LT(late.next, late.later);
}

TEST(HandPath, IsWhereTheMouseWasAtTheNextFrame) {
    Path path = begun(9);
    for (std::uint32_t i = 0; i < 5; ++i)
        moveHand(path, after(9 + i), {0.1f * static_cast<float>(i + 1), 0, 0});
    release(path, after(14));
    expectAscending(path);
    for (std::uint32_t i = 0; i <= 5; ++i)
        EXPECT_NEAR(handAt(path, after(9 + i).now).x, 0.1f * static_cast<float>(i), 1e-6f) << i;
    EXPECT_EQ(path.back().time, after(14).now);
}

TEST(HandPath, NeverChangesWhatWasPlayed) {
    Path path = begun(0);
    std::vector<std::pair<float, glm::vec3>> seen;
    std::uint32_t frame = 0;
    // Pictures of the window with no, one or several played frames.
    for (const std::uint32_t frames : {1u, 0u, 0u, 1u, 3u, 16u, 0u, 1u, 2u}) {
        moveHand(path, after(frame), {0.01f * static_cast<float>(frame * frame), 0.3f, 0});
        moveHand(path, after(frame), {0.02f * static_cast<float>(frame + 1), 0.2f, 0.1f});
        expectAscending(path);
        for (std::uint32_t i = 0; i < frames; ++i) {
            ++frame;
            ASSERT_LE(after(frame).now, path.back().time);  // still pulling
            seen.emplace_back(after(frame).now, handAt(path, after(frame).now));
        }
    }
    release(path, after(frame));
    expectAscending(path);
    EXPECT_EQ(path.back().time, after(frame).now);
    for (const auto& [time, position] : seen)
        EXPECT_LT(glm::length(handAt(path, time) - position), 1e-6f) << time;
}

TEST(HandPath, HoldsForAllFramesThatOnePictureMayPlay) {
    Path path = begun(3);
    moveHand(path, after(3), {1, 0, 0});
    EXPECT_GT(path.back().time, after(3 + Pacer::kMostFrames).now);
    EXPECT_EQ(handAt(path, after(3 + Pacer::kMostFrames).now), glm::vec3(1, 0, 0));
}

TEST(HandPath, NeedsFewKeysWhileTheHandRests) {
    Path path = begun(0);
    for (std::uint32_t frame = 0; frame < 500; ++frame) moveHand(path, after(frame), {0, 1, 0});
    EXPECT_LE(path.size(), 6u);
    EXPECT_EQ(handAt(path, after(400).now), glm::vec3(0, 1, 0));
    release(path, after(500));
    EXPECT_EQ(path.back().time, after(500).now);
}

TEST(HandPath, PullsForTheNextFrameIfNoneWasPlayed) {
    Path path = begun(20);
    moveHand(path, after(20), {0.3f, 0, 0});
    moveHand(path, after(20), {0.5f, 0, 0});
    release(path, after(20));
    ASSERT_EQ(path.size(), 2u);
    EXPECT_EQ(path.front().time, after(20).now);
    EXPECT_EQ(path.back().time, after(21).now);
    EXPECT_EQ(path.back().position, glm::vec3(0.5f, 0, 0));
}

TEST(HandPath, IsGoneWhereTimeWasSetBack) {
    Path path = begun(20);
    moveHand(path, after(20), {0.3f, 0, 0});
    release(path, after(4));
    EXPECT_TRUE(path.empty());
}

TEST(HandPath, EndsWhereThereIsNoRoom) {
    Path path = begun(0);
    std::uint32_t frame = 0;
    while (hasRoom(path)) {
        moveHand(path, after(frame), {static_cast<float>(frame) * 1e-3f, 0, 0});
        ++frame;
    }
    EXPECT_LE(path.size(), 10'000u);  // limit of the table in hair/simulation_settings.h
    release(path, after(frame));
    EXPECT_LE(path.size(), 10'000u);
    expectAscending(path);
}

}  // namespace
}  // namespace benchmarks::viewer
