#include "hair/groom/style/style.h"

#include <gtest/gtest.h>

#include "tests/groom/style/sample_strand_set.h"

namespace hair::groom {
namespace {

TEST(PickStrands, TakesAllThatTheyHave) {
    const std::vector<std::uint32_t> indices{2, 0, 2};
    const StrandSet picked = pickStrands(sampleStrandSet(), indices);
    EXPECT_EQ(picked.ends, (std::vector<std::uint32_t>{1, 3, 4}));
    EXPECT_EQ(picked.points, (std::vector<glm::vec3>{{5, 5, 5}, {0, 0, 0}, {0, 1, 0}, {5, 5, 5}}));
    EXPECT_EQ(picked.widths.values, (std::vector<float>{6, 1, 2, 6}));
    EXPECT_EQ(picked.transparencies.everywhere, 0.25f);
    EXPECT_EQ(picked.transparencies.values, std::vector<float>());
    EXPECT_EQ(picked.colors.values[0], glm::vec3(0.6f));
    EXPECT_EQ(picked.colors.values[2], glm::vec3(0.2f));
    EXPECT_EQ(picked.root_uvs, (std::vector<glm::vec2>{{0.3f, 3}, {0.1f, 1}, {0.3f, 3}}));
    EXPECT_EQ(picked.groups, (std::vector<std::int32_t>{6, 4, 6}));
    EXPECT_EQ(picked.guides, (std::vector<std::uint8_t>{1, 1, 1}));
    EXPECT_TRUE(picked.root_triangles.empty());
    EXPECT_EQ(picked.metres_per_unit, 0.01);
    EXPECT_EQ(picked.comment, "sample");
    EXPECT_EQ(picked.warnings, std::vector<std::string>{"odd"});
}

TEST(ScaleLengths, ScalesPointsAndWidthsAlone) {
    const StrandSet scaled = scaleLengths(sampleStrandSet(), 0.5);
    EXPECT_EQ(scaled.points[4], glm::vec3(1.0f, 0.0f, 1.5f));
    EXPECT_EQ(scaled.widths.values, (std::vector<float>{0.5f, 1, 1.5f, 2, 2.5f, 3}));
    EXPECT_EQ(scaled.colors.values, sampleStrandSet().colors.values);
    EXPECT_EQ(scaled.root_uvs, sampleStrandSet().root_uvs);
    StrandSet same_everywhere = sampleStrandSet();
    same_everywhere.widths = {.everywhere = 4.0f};
    EXPECT_EQ(scaleLengths(same_everywhere, 0.5).widths.everywhere, 2.0f);
}

}  // namespace
}  // namespace hair::groom
