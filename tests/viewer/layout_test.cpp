#include "benchmarks/viewer/preferences.h"

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace benchmarks::viewer {
namespace {

constexpr float kLetter = 15.0f;  // px at scale 1

std::vector<Box> boxesOf(const Layout& layout) {
    std::vector<Box> boxes;
    for (const Box& box :
         {layout.left, layout.left_splitter, layout.picture, layout.right_splitter, layout.right,
          layout.play, layout.status})
        if (!box.empty()) boxes.push_back(box);
    return boxes;
}

bool overlap(const Box& a, const Box& b) {
    return a.x < b.right() && b.x < a.right() && a.y < b.bottom() && b.y < a.bottom();
}

struct Window {
    float width, height, letter;
};

std::vector<Window> windows() {
    std::vector<Window> windows;
    for (const float scale : {0.75f, 1.0f, 1.1f, 1.5f, 2.0f, 3.0f})
        for (const auto& [width, height] :
             {std::array{320.0f, 240.0f},
              {640.0f, 480.0f},
              {1280.0f, 720.0f},
              {1281.0f, 723.0f},
              {1920.0f, 1080.0f},
              {2560.0f, 1440.0f},
              {3840.0f, 600.0f},
              {500.0f, 2000.0f}})
            windows.push_back({width, height, kLetter * scale});
    return windows;
}

Layout layoutOf(const Window& window, const Column& left, const Column& right) {
    return arrange(window.width, window.height, 1.5f * window.letter, window.letter, left, right);
}

// The boxes lie inside the window, do not overlap and have its area, so there are no gaps.
TEST(Layout, TilesWindowsOfAnySizeAtAnyScale) {
    for (const Window& window : windows())
        for (const float left : {18.0f, 40.0f, 200.0f})
            for (const float right : {18.0f, 33.3f})
                for (const bool left_shown : {true, false})
                    for (const bool right_shown : {true, false}) {
                        SCOPED_TRACE(
                            std::to_string(window.width) + " x " + std::to_string(window.height) +
                            ", letter " + std::to_string(window.letter) + ", columns " +
                            std::to_string(left) + " " + std::to_string(right));
                        const std::vector<Box> boxes = boxesOf(layoutOf(
                            window, {.width = left, .shown = left_shown},
                            {.width = right, .shown = right_shown}));
                        const float top = 1.5f * window.letter;
                        float area = 0.0f;
                        for (std::size_t i = 0; i < boxes.size(); ++i) {
                            area += boxes[i].width * boxes[i].height;
                            EXPECT_GE(boxes[i].x, 0.0f);
                            EXPECT_GE(boxes[i].y, top);
                            EXPECT_LE(boxes[i].right(), window.width);
                            EXPECT_LE(boxes[i].bottom(), window.height);
                            for (std::size_t j = 0; j < i; ++j)
                                EXPECT_FALSE(overlap(boxes[i], boxes[j])) << i << " and " << j;
                        }
                        // Rounding by a few parts in 2^24.
                        const float whole = window.width * (window.height - top);
                        EXPECT_NEAR(area, whole, 1e-5f * whole);
                    }
}

TEST(Layout, NeverMakesAColumnTooNarrowForItsWidgets) {
    for (const Window& window : windows()) {
        const Layout layout = layoutOf(window, {.width = 5.0f}, {.width = 5.0f});
        for (const Box& column : {layout.left, layout.right}) {
            if (column.empty()) continue;
            EXPECT_GE(column.width, std::floor(kNarrowestColumn * window.letter));
        }
    }
}

TEST(Layout, HasBothColumnsAt1280x720) {
    const Layout layout = layoutOf({1280, 720, kLetter}, {}, {});
    EXPECT_FALSE(layout.merged);
    EXPECT_FALSE(layout.left.empty());
    EXPECT_FALSE(layout.right.empty());
    EXPECT_GE(layout.picture.width, kNarrowestPicture * kLetter);
}

TEST(Layout, MergesColumnsWhereLettersAreTwiceAsLarge) {
    const Layout layout = layoutOf({1280, 720, 2.0f * kLetter}, {}, {});
    EXPECT_TRUE(layout.merged);
    EXPECT_FALSE(layout.left.empty());
    EXPECT_TRUE(layout.right.empty());
    EXPECT_FALSE(layout.picture.empty());
}

TEST(Layout, KeepsTheOnlyColumnWhileEitherIsWanted) {
    const Window small{1280, 720, 2.0f * kLetter};
    EXPECT_FALSE(layoutOf(small, {.shown = false}, {.shown = true}).left.empty());
    EXPECT_FALSE(layoutOf(small, {.shown = true}, {.shown = false}).left.empty());
    EXPECT_TRUE(layoutOf(small, {.shown = false}, {.shown = false}).left.empty());
}

TEST(Layout, GivesAColumnTheWidthThatItAsksForWhereThereIsRoom) {
    const Layout layout = layoutOf({2560, 1440, kLetter}, {.width = 30.0f}, {.width = 24.0f});
    EXPECT_EQ(layout.left.width, 30.0f * kLetter);
    EXPECT_EQ(layout.right.width, 24.0f * kLetter);
}

TEST(Layout, IsTheSameAtAnyScale) {
    const Layout one = layoutOf({1280, 720, kLetter}, {}, {});
    const Layout two = layoutOf({2560, 1440, 2.0f * kLetter}, {}, {});
    const std::vector<Box> small = boxesOf(one), large = boxesOf(two);
    ASSERT_EQ(small.size(), large.size());
    for (std::size_t i = 0; i < small.size(); ++i) {
        // Widths and positions are rounded to whole pixels: each is off by up to half a pixel, and
        // twice that after doubling.
        EXPECT_NEAR(large[i].x, 2.0f * small[i].x, 3.0f);
        EXPECT_NEAR(large[i].width, 2.0f * small[i].width, 3.0f);
        EXPECT_NEAR(large[i].y, 2.0f * small[i].y, 3.0f);
        EXPECT_NEAR(large[i].height, 2.0f * small[i].height, 3.0f);
    }
}

}  // namespace
}  // namespace benchmarks::viewer
