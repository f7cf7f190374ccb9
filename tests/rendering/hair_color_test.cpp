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

// By hand for the index 1.55 in water of 1.333, with p = 1 - 1 / 1.333^2 = 0.437219: a mass of hair
// of the albedo 0.5 becomes 0.562781 * 0.5 / (1 - 0.2186095) = 0.360115. Water reflects
// (0.333 / 2.333)^2 = 0.0203733 and hair in it (0.217 / 2.883)^2 = 0.00566539, together 0.0258107,
// which is the reflectance of the index 1.160657 / 0.839343 = 1.382816. s is 0.217 / 0.55 =
// 0.394545.
TEST(WetHair, IsDarkerAndSmoother) {
    Settings settings;
    settings.shading.color = toDisplay(glm::dvec3(0.5));
    settings.simulation.material.water = 1.0f;  // more than fills all gaps
    const ShadingSettings wet = wetted(settings).shading;
    expectNear(linearColor(wet), glm::dvec3(0.360115), 1e-6);
    EXPECT_NEAR(wet.refractive_index, 1.382816, 1e-5);
    EXPECT_NEAR(wet.longitudinal_roughness, 0.3 * 0.394545, 1e-6);
    EXPECT_NEAR(wet.cuticle_tilt, 2.0 * 0.394545, 1e-5);
    EXPECT_NEAR(wet.exponent, 50.0 / (0.394545 * 0.394545), 1e-2);
    // Hair reflects (0.55 / 2.55)^2 = 0.0465206 when it is dry.
    EXPECT_NEAR(wet.specular, 0.5 * 0.0258107 / 0.0465206 / 0.394545, 1e-5);
    EXPECT_EQ(wet.azimuthal_roughness, settings.shading.azimuthal_roughness);
}

// Half of the water that fills the gaps, (4 / pi - 1) 1000 / 1320 / 2 = 0.103500, throws half of
// the light back.
TEST(WetHair, IsWetByItsWater) {
    Settings settings;
    settings.shading.color = toDisplay(glm::dvec3(0.5));
    const ShadingSettings dry = wetted(settings).shading;
    EXPECT_EQ(dry.color, settings.shading.color);
    EXPECT_EQ(dry.refractive_index, settings.shading.refractive_index);
    settings.simulation.material.water = 0.1035f;
    const ShadingSettings wet = wetted(settings).shading;
    expectNear(linearColor(wet), glm::dvec3(0.438641), 1e-5);
    EXPECT_NEAR(wet.longitudinal_roughness, 0.3 * (1.0 + 0.394545) / 2.0, 1e-5);
}

// White hair stays white and black hair black, and pigments give the colour of dry hair.
TEST(WetHair, KeepsWhiteAndBlack) {
    Settings settings;
    settings.simulation.material.water = 1.0f;
    settings.shading.color = {0.0f, 1.0f, 1.0f};
    expectNear(linearColor(wetted(settings).shading), {0.0, 1.0, 1.0}, 1e-6);
    settings.shading.color_from = ColorSource::melanin;
    settings.shading.eumelanin = 0.0f;
    settings.shading.pheomelanin = 0.0f;
    expectNear(linearColor(wetted(settings).shading), glm::dvec3(1.0), 1e-6);
    settings.shading.eumelanin = 0.3f;
    const glm::dvec3 dry = linearColor(settings.shading);
    const glm::dvec3 wet = linearColor(wetted(settings).shading);
    for (int i = 0; i < 3; ++i) EXPECT_LT(wet[i], 0.75 * dry[i]);
}

}  // namespace
}  // namespace hair::rendering
