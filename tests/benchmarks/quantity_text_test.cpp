#include "benchmarks/report/text.h"

#include <gtest/gtest.h>

namespace benchmarks {
namespace {

TEST(QuantityText, GroupsDigitsByThree) {
    EXPECT_EQ(report::countText(0), "0");
    EXPECT_EQ(report::countText(999), "999");
    EXPECT_EQ(report::countText(1000), "1,000");
    EXPECT_EQ(report::countText(1234567), "1,234,567");
    EXPECT_EQ(report::countText(1, "strand"), "1 strand");
    EXPECT_EQ(report::countText(2000, "strand"), "2,000 strands");
}

TEST(QuantityText, WritesNoZerosAtTheEnd) {
    EXPECT_EQ(report::plainNumber(0.01), "0.01");
    EXPECT_EQ(report::plainNumber(16.0), "16");
    EXPECT_EQ(report::plainNumber(0.1f), "0.1");
}

TEST(QuantityText, TakesTheUnitThatReadsWell) {
    EXPECT_EQ(report::lengthText(0.0), "0 m");
    EXPECT_EQ(report::lengthText(1.5), "1.50 m");
    EXPECT_EQ(report::lengthText(0.3), "300 mm");
    EXPECT_EQ(report::lengthText(-0.0012), "-1.20 mm");
    EXPECT_EQ(report::lengthText(70e-6), "70.0 µm");
    EXPECT_EQ(report::lengthText(2e-12), "0.00200 nm");
    EXPECT_EQ(report::lengthText(25000.0), "25.0 km");
}

TEST(QuantityText, CountsBytesByThousands) {
    EXPECT_EQ(report::sizeText(12), "12 bytes");
    EXPECT_EQ(report::sizeText(999), "999 bytes");
    EXPECT_EQ(report::sizeText(1000), "1.00 kB");
    EXPECT_EQ(report::sizeText(1'234'567), "1.23 MB");
    EXPECT_EQ(report::sizeText(192'000'128), "192 MB");
}

}  // namespace
}  // namespace benchmarks
