#include "hair/rendering/strand_plan.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace hair::rendering {
namespace {

// Guides from the origin to points on a sphere have half of their points on it. The root of the
// mean square distance from the mean, the centre, is the sphere's radius over sqrt(2).
groom::Groom hedgehog(float radius, std::uint32_t guides) {
    groom::Groom groom{.strand_count = guides, .vertices_per_strand = 2};
    for (std::uint32_t i = 0; i < guides; ++i) {
        const float angle =
            2.0f * std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(guides);
        groom.points.emplace_back(0.0f);
        groom.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0f);
    }
    return groom;
}

TEST(LodBound, LetsTheOutlineGrowByItsPart) {
    const float radius = 0.2f / std::sqrt(2.0f);
    const float scale =
        greatestWidthScale(hedgehog(0.2f, 100), {.root_width = 0.003f, .tip_width = 0.001f});
    EXPECT_NEAR((scale - 1.0f) * 0.002f / radius, kOutlineGrowth, 1e-5f);
}

TEST(LodBound, KnowsTheTaperAndTheGroomsWidths) {
    groom::Groom groom = hedgehog(0.2f, 10);
    const auto bound = [&](const StrandSettings& strands) {
        return greatestWidthScale(groom, strands) - 1.0f;
    };
    // The first half of the strand is 3 mm wide, the second 2 mm on average: 2.5 mm instead of 2.
    const float plain = bound({.root_width = 0.003f, .tip_width = 0.001f});
    const float late = bound({.root_width = 0.003f, .tip_width = 0.001f, .taper_start = 0.5f});
    EXPECT_NEAR(plain / late, 2.5f / 2.0f, 1e-4f);
    groom.widths.assign(20, 0.004f);
    EXPECT_NEAR(plain / bound({.width = WidthSource::groom}), 2.0f, 1e-4f);
}

TEST(LodBound, IsNoneOfStrandsWithoutWidth) {
    EXPECT_TRUE(
        std::isinf(greatestWidthScale(hedgehog(0.2f, 10), {.root_width = 0, .tip_width = 0})));
    EXPECT_TRUE(std::isinf(greatestWidthScale({}, {})));
}

}  // namespace
}  // namespace hair::rendering
