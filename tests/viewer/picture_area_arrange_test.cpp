#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "benchmarks/viewer/picture_area.h"

namespace benchmarks::viewer {
namespace {

// Corners are sums of a few floats up to some thousand px, exact to about 2^-12.
constexpr float kPixelTolerance = 0.01f;  // px

const glm::vec2 kRooms[] = {{1600, 900}, {900, 1600}, {640, 641},      {300, 1200},
                            {40, 30},    {2000, 20},  {500.5f, 333.3f}};
const glm::vec2 kPictures[] = {{1280, 720}, {720, 1280}, {64, 64}, {1, 1}, {8192, 16}};

glm::vec2 endOf(const PictureRect& rect) { return rect.corner + rect.size; }

void expectInside(const PictureRect& inner, const PictureRect& outer) {
    EXPECT_GE(inner.corner.x, outer.corner.x - kPixelTolerance);
    EXPECT_GE(inner.corner.y, outer.corner.y - kPixelTolerance);
    EXPECT_LE(endOf(inner).x, endOf(outer).x + kPixelTolerance);
    EXPECT_LE(endOf(inner).y, endOf(outer).y + kPixelTolerance);
}

void expectMiddle(float from, float to, const PictureRect& room, int axis) {
    EXPECT_NEAR(from + to, room.corner[axis] * 2 + room.size[axis], 2 * kPixelTolerance);
}

TEST(ArrangeOne, FillsTheRoomAlongOneAxisInTheMiddle) {
    for (const glm::vec2 size : kRooms) {
        for (const glm::vec2 pixels : kPictures) {
            const PictureRect room{{17, 5}, size};
            const PictureRect rect = arrangeOne(room, pixels, {}).picture;
            expectInside(rect, room);
            EXPECT_TRUE(
                std::abs(rect.size.x - size.x) < kPixelTolerance ||
                std::abs(rect.size.y - size.y) < kPixelTolerance);
            EXPECT_NEAR(rect.size.x / pixels.x, rect.size.y / pixels.y, 1e-4f * rect.size.x);
            for (const int axis : {0, 1})
                expectMiddle(rect.corner[axis], endOf(rect)[axis], room, axis);
        }
    }
}

TEST(ArrangeTwo, KeepsOneScaleAndTheGapAndTheMiddle) {
    constexpr float kGap = 8.0f;
    for (const glm::vec2 size : kRooms) {
        for (const glm::vec2 a : kPictures) {
            for (const glm::vec2 b : kPictures) {
                const PictureRect room{{17, 5}, size};
                const auto [first, second] = arrangeTwo(room, {a, b}, kGap, {});
                expectInside(first.picture, room);
                expectInside(second.picture, room);
                const float scale = first.picture.size.x / a.x;
                const float tolerance = 1e-4f * size.x;
                EXPECT_NEAR(first.picture.size.y, a.y * scale, tolerance);
                EXPECT_NEAR(second.picture.size.x, b.x * scale, tolerance);
                EXPECT_NEAR(second.picture.size.y, b.y * scale, tolerance);
                const glm::vec2 apart = second.picture.corner - endOf(first.picture);
                const int along = std::abs(apart.x - kGap) < kPixelTolerance ? 0 : 1;
                EXPECT_NEAR(apart[along], kGap, kPixelTolerance);
                expectMiddle(
                    first.picture.corner[along], endOf(second.picture)[along], room, along);
            }
        }
    }
}

TEST(ArrangeTwo, ChoosesTheWayInWhichTheyAreLarger) {
    const std::array<glm::vec2, 2> wide{glm::vec2(200, 100), glm::vec2(200, 100)};
    // 400 x 100 side by side: scale 2. Stacked, 200 x 200: scale 1.
    const auto [left, right] = arrangeTwo({{0, 0}, {800, 200}}, wide, 0.0f, {});
    EXPECT_EQ(left.picture.corner, glm::vec2(0, 0));
    EXPECT_EQ(right.picture.corner, glm::vec2(400, 0));
    EXPECT_EQ(right.picture.size, glm::vec2(400, 200));
    // In 400 x 400 it is reversed: 1 and 2.
    const auto [above, below] = arrangeTwo({{0, 0}, {400, 400}}, wide, 0.0f, {});
    EXPECT_EQ(above.picture.corner, glm::vec2(0, 0));
    EXPECT_EQ(below.picture.corner, glm::vec2(0, 200));
    EXPECT_EQ(below.picture.size, glm::vec2(400, 200));
}

TEST(ArrangeTwo, GivesMagnifiedPicturesPanesThatDoNotOverlap) {
    const PictureRect room{{10, 20}, {408, 100}};
    const std::array<glm::vec2, 2> pixels{glm::vec2(500, 100), glm::vec2(300, 50)};
    const auto [a, b] = arrangeTwo(room, pixels, 8.0f, {.scale = 4.0f});
    EXPECT_EQ(a.picture.size, pixels[0] * 4.0f);
    EXPECT_EQ(b.picture.size, pixels[1] * 4.0f);
    const bool across = b.pane.corner.y == a.pane.corner.y;
    const int along = across ? 0 : 1;
    EXPECT_NEAR(b.pane.corner[along] - endOf(a.pane)[along], 8.0f, kPixelTolerance);
    EXPECT_EQ(a.pane.size, b.pane.size);
    expectInside(a.pane, room);
    expectInside(b.pane, room);
}

TEST(ArrangeOne, LeavesNoPartOfThePaneEmptyWherePicturesAreLarger) {
    const PictureRect room{{3, 4}, {100, 60}};
    for (const float x : {-5.0f, 0.0f, 0.3f, 1.0f, 7.0f}) {
        for (const float y : {0.0f, 0.5f, 1.0f}) {
            const Placed placed = arrangeOne(room, {64, 20}, {.scale = 2.0f, .focus = {x, y}});
            EXPECT_EQ(placed.picture.size, glm::vec2(128, 40));
            // 128 px cover 100 px; 40 px are centred in 60 px.
            EXPECT_LE(placed.picture.corner.x, room.corner.x);
            EXPECT_GE(endOf(placed.picture).x, endOf(room).x - 1.0f);  // rounded to screen pixels
            EXPECT_EQ(placed.picture.corner.y, 14.0f);
        }
    }
}

TEST(ArrangeOne, PutsTheFocusInTheMiddleOnWholePixels) {
    const PictureRect room{{0.5f, 0.5f}, {100, 100}};
    const Placed placed = arrangeOne(room, {1000, 1000}, {.scale = 8.0f, .focus = {0.25f, 0.5f}});
    for (const int axis : {0, 1})
        EXPECT_EQ(placed.picture.corner[axis], std::floor(placed.picture.corner[axis]));
    // Off by less than a screen pixel.
    EXPECT_NEAR(placed.picture.share({50.5f, 50.5f}).x, 0.25f, 1.0f / 8000.0f);
    EXPECT_NEAR(placed.picture.share({50.5f, 50.5f}).y, 0.5f, 1.0f / 8000.0f);
}

TEST(Arrange, KnowsWhichShareIsSeenAndWhatCanBeInTheMiddle) {
    const Placed placed{{{0, 0}, {100, 100}}, {{0, 0}, {400, 50}}};
    EXPECT_EQ(visibleShare(placed), glm::vec2(0.25f, 1.0f));
    EXPECT_EQ(reachableFocus({0.0f, 0.0f}, {0.25f, 1.0f}), glm::vec2(0.125f, 0.5f));
    EXPECT_EQ(reachableFocus({0.6f, 0.9f}, {0.25f, 1.0f}), glm::vec2(0.6f, 0.5f));
    EXPECT_EQ(reachableFocus({2.0f, 0.9f}, {0.25f, 1.0f}), glm::vec2(0.875f, 0.5f));
}

TEST(Arrange, FindsWhatTwoRectsHaveInCommon) {
    const PictureRect a{{0, 0}, {10, 10}};
    const PictureRect both = common(a, {{6, -4}, {10, 8}});
    EXPECT_EQ(both.corner, glm::vec2(6, 0));
    EXPECT_EQ(both.size, glm::vec2(4, 4));
    EXPECT_EQ(common(a, {{20, 2}, {5, 5}}).size.x, 0.0f);
}

}  // namespace
}  // namespace benchmarks::viewer
