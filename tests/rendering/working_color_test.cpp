#include "hair/rendering/render_assets.h"

#include <gtest/gtest.h>

namespace hair::rendering {
namespace {

// IEC 61966-2-1: the ends, the joint of its two parts from both sides, and the middle.
TEST(WorkingColor, LinearIsByTheStandard) {
    const glm::dvec3 linear = toLinear({0.0, 1.0, 0.5});
    EXPECT_EQ(linear.x, 0.0);
    EXPECT_EQ(linear.y, 1.0);
    EXPECT_NEAR(linear.z, 0.21404114, 1e-8);  // as printed
    const glm::dvec3 joint = toLinear({0.04045, 0.0404501, 0.04045});
    EXPECT_NEAR(joint.x, 0.0031308, 1e-7);
    EXPECT_NEAR(joint.y, joint.x, 1e-7);
}

TEST(WorkingColor, DisplayUndoesLinear) {
    for (const double value : {0.0, 0.01, 0.04, 0.041, 0.3, 1.0, 2.5})
        // The standard's two parts meet to 1e-7.
        EXPECT_NEAR(toDisplay(toLinear(glm::dvec3(value))).y, value, 1e-6);
}

TEST(WorkingColor, OfTheThesisIsWhatDisplaysShow) {
    RenderSettings render;
    EXPECT_EQ(workingColor(render, {0.5f, 0.2f, 1.0f}), glm::vec3(0.5f, 0.2f, 1.0f));
    render.tone_map = ToneMap::aces;
    EXPECT_NEAR(workingColor(render, glm::vec3(0.5f)).x, 0.21404114f, 1e-7f);
}

}  // namespace
}  // namespace hair::rendering
