#include <gtest/gtest.h>

#include "hair/rendering/render_assets.h"

namespace hair::rendering {
namespace {

void expectNear(const glm::dvec3& value, const glm::dvec3& expected, double tolerance) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(value[i], expected[i], tolerance) << "channel " << i;
}

TEST(HairColor, AbsorbsByItsPigments) {
    ShadingSettings shading;
    shading.color_from = ColorSource::melanin;
    shading.eumelanin = 1.0f;
    shading.pheomelanin = 0.0f;
    expectNear(absorption(shading), {0.419, 0.697, 1.37}, 1e-12);
    shading.eumelanin = 0.0f;
    shading.pheomelanin = 2.0f;
    expectNear(absorption(shading), {0.374, 0.8, 2.1}, 1e-12);
    shading.eumelanin = 0.5f;
    expectNear(absorption(shading), {0.5835, 1.1485, 2.785}, 1e-12);
}

// Chiang et al. 2016, equation (9), by hand for beta_n = 0.5: the denominator is 5.969 - 0.1075 +
// 0.633 - 1.34125 + 0.348375 + 0.00765625 = 5.50928125; ln 0.5 = -0.693147181.
TEST(HairColor, AbsorbsByTheColorOfMuchHair) {
    ShadingSettings shading;
    shading.azimuthal_roughness = 0.5f;
    shading.color = toDisplay(glm::dvec3(0.5));
    expectNear(absorption(shading), glm::dvec3(0.0158292), 1e-6);  // float's 0.5 in display RGB
    shading.color = glm::vec3(1.0f);
    expectNear(absorption(shading), glm::dvec3(0), 1e-12);
    shading.color = glm::vec3(0.0f);  // counts as 1e-4, with the logarithm -9.210340372
    expectNear(absorption(shading), glm::dvec3(2.794868), 1e-5);
}

TEST(HairColor, IsLinearAndComesBackFromPigments) {
    ShadingSettings shading;
    expectNear(linearColor(shading), toLinear(shading.color), 1e-12);
    for (const float roughness : {0.05f, 0.3f, 1.0f}) {
        shading.azimuthal_roughness = roughness;
        shading.color_from = ColorSource::melanin;
        shading.eumelanin = 0.3f;
        shading.pheomelanin = 0.2f;
        const glm::dvec3 absorbed = absorption(shading);
        const glm::dvec3 color = linearColor(shading);
        shading.color_from = ColorSource::rgb;
        shading.color = toDisplay(color);
        // A colour's rounding to float is below 1e-7, its logarithm's below 1e-5 for these colours.
        expectNear(absorption(shading), absorbed, 2e-5);
    }
}

}  // namespace
}  // namespace hair::rendering
