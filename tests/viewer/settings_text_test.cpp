#include "benchmarks/viewer/settings_panel.h"

#include <cstdio>

#include <gtest/gtest.h>

#include "hair/fields.h"
#include "hair/settings.h"

namespace benchmarks::viewer {
namespace {

TEST(SettingNames, AreShownAsPeopleReadThem) {
    EXPECT_EQ(shownName("field_of_view"), "Field of view");
    EXPECT_EQ(shownName("seed"), "Seed");
    EXPECT_EQ(shownName("msaa"), "MSAA");
    EXPECT_EQ(shownName(""), "");
}

TEST(SettingNames, AreFoundBothAsWrittenAndAsShown) {
    EXPECT_EQ(searchable("field_of_view"), searchable("Field of view"));
}

TEST(Units, AreShownWithTheirSigns) {
    EXPECT_EQ(shownUnit("m/s^2"), "m/s²");
    EXPECT_EQ(shownUnit("kg/m^3"), "kg/m³");
    EXPECT_EQ(shownUnit("m^2/s^2"), "m²/s²");
    EXPECT_EQ(shownUnit("deg"), "°");
    EXPECT_EQ(shownUnit("1"), "");
    EXPECT_EQ(shownUnit("count"), "");
    EXPECT_EQ(shownUnit("1/s^2"), "1/s²");
}

TEST(NumberFormat, WritesANumberAndItsUnit) {
    const auto written = [](const std::string& format, double number) {
        char text[64];
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
        std::snprintf(text, sizeof text, format.c_str(), number);
#pragma GCC diagnostic pop
        return std::string(text);
    };
    EXPECT_EQ(written(numberFormat("%.5g", "m/s^2"), 9.8), "9.8 m/s²");
    EXPECT_EQ(written(numberFormat("%.5g", "deg"), 100.0), "100°");
    EXPECT_EQ(written(numberFormat("%.5g", "1"), 0.25), "0.25");
    EXPECT_EQ(written(numberFormat("%.5g", "%"), 5.0), "5 %");
}

TEST(DragSpeed, MovesDigitsThatMatter) {
    // A pixel is 1 % of a number in a range of twelve decades. In a small range, a panel's few
    // hundred pixels reach every value.
    EXPECT_DOUBLE_EQ(dragSpeed(3.9e9, 1.0, 1e12), 3.9e7);
    EXPECT_DOUBLE_EQ(dragSpeed(0.0, 0.0, 1.0), 1.0 / 400.0);
    EXPECT_GT(dragSpeed(0.0, 0.0, 1e6), 0.0);
    EXPECT_DOUBLE_EQ(dragSpeed(-50.0, -100.0, 100.0), 0.5);
}

TEST(ListPages, HaveEveryElementOnce) {
    for (const std::size_t count : {0, 1, 9, 10, 11, 500, 65536}) {
        std::size_t next = 0;
        for (std::size_t page = 0; next < count; ++page) {
            const ElementRange range = elementsOf(page, count);
            ASSERT_EQ(range.first, next);
            ASSERT_GT(range.last, range.first);
            next = range.last;
        }
        EXPECT_EQ(next, count);
    }
}

TEST(ListPages, EndWithTheLastElement) {
    const ElementRange last = elementsOf(1000, 25);
    EXPECT_EQ(last.first, 20u);
    EXPECT_EQ(last.last, 25u);
    EXPECT_EQ(elementsOf(3, 0).last, 0u);
}

TEST(Differ, LooksIntoGroupsAndLists) {
    const hair::Settings settings;
    hair::Settings other = settings;
    EXPECT_FALSE(hair::differ(settings, other));
    other.simulation.wind.direction.z = 0.5f;
    EXPECT_TRUE(hair::differ(settings, other));
    EXPECT_TRUE(hair::differ(settings.simulation, other.simulation));
    EXPECT_FALSE(hair::differ(settings.render, other.render));

    other = settings;
    other.simulation.colliders.resize(2);
    EXPECT_TRUE(hair::differ(settings, other));
    hair::Settings third = other;
    EXPECT_FALSE(hair::differ(other, third));
    third.simulation.colliders[1].radius *= 2.0f;
    EXPECT_TRUE(hair::differ(other, third));
}

}  // namespace
}  // namespace benchmarks::viewer
