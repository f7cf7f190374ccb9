#include "hair/groom/style/style.h"

#include <gtest/gtest.h>

#include "tests/groom/style/sample_strands.h"

namespace hair::groom {
namespace {

TEST(Taper, FallsFromItsStartToTheTip) {
    Groom before = verticalStrands(2, 5, 0.2, 0.1);
    before.widths.assign(10, 5.0f);
    const Groom after =
        taper(before, {.root_width = 0.0001f, .tip_width = 0.00002f, .start = 0.5f});
    const double expected[] = {0.0001, 0.0001, 0.0001, 0.00006, 0.00002};
    for (std::size_t i = 0; i < 10; ++i)
        EXPECT_NEAR(after.widths[i], expected[i % 5], 1e-11) << i;  // a float of 1e-4: 4e-12
    EXPECT_EQ(after.points, before.points);
}

TEST(Taper, GoesByLengthNotByVertex) {
    Groom before{.strand_count = 1, .vertices_per_strand = 3};
    before.points = {{0, 0, 0}, {0, 0.01f, 0}, {0, 0.1f, 0}};
    const Groom after = taper(before, {.root_width = 0.001f, .tip_width = 0.0f});
    EXPECT_NEAR(after.widths[1], 0.0009, 1e-9);
    EXPECT_EQ(after.widths[2], 0.0f);
}

TEST(Taper, WithAStartOfOneIsTheRootWidthEverywhere) {
    const Groom after = taper(
        verticalStrands(1, 4, 0.2, 0.0), {.root_width = 0.001f, .tip_width = 0.0f, .start = 1.0f});
    for (const float width : after.widths) EXPECT_EQ(width, 0.001f);
}

}  // namespace
}  // namespace hair::groom
