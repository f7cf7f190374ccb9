// Compares Phong and Kajiya-Kay on the device with values computed by hand.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/rendering/model_probe.h"

namespace hair::rendering {
namespace {

// Some ten roundings; powers multiply them by up to 50.
constexpr double kModelRounding = 1e-4;

glm::vec3 atDegrees(double from_z, double turn = 0.0) {
    const double a = from_z * std::numbers::pi / 180.0;
    const double b = turn * std::numbers::pi / 180.0;
    return {std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)};
}

class ShadingModels : public GpuTest {
protected:
    // A light from `to_light` on a normal or a tangent along +z.
    static gpu::ModelProbe
    probe(const glm::vec3& to_light, const glm::vec3& to_eye, float exponent) {
        return probeModels(
                   device(), {{.type = LightType::directional, .direction = -to_light}},
                   {{.normal = {0, 0, 1},
                     .exponent = exponent,
                     .tangent = {0, 0, 1},
                     .to_eye = to_eye}})
            .front();
    }
};

TEST_F(ShadingModels, PhongIsThesisEquations5And6) {
    // Light 60 degrees from the normal, the eye in the mirrored direction: cos 60 and 1.
    const gpu::ModelProbe mirrored = probe(atDegrees(60), atDegrees(60, 180), 50.0f);
    EXPECT_NEAR(mirrored.phong_diffuse, 0.5, kModelRounding);
    EXPECT_NEAR(mirrored.phong_specular, 1.0, kModelRounding);
    // The eye is 10 degrees off: cos(10)^50 = 0.98480775^50 = 0.465128.
    const gpu::ModelProbe off = probe(atDegrees(60), atDegrees(50, 180), 50.0f);
    EXPECT_NEAR(off.phong_specular, 0.465128, kModelRounding);
    // Light from behind.
    const gpu::ModelProbe behind = probe(atDegrees(120), atDegrees(60, 180), 50.0f);
    EXPECT_EQ(behind.phong_diffuse, 0.0f);
    EXPECT_EQ(behind.phong_specular, 0.0f);
}

// Angles are from the strand's direction. Light 30 degrees from it is mirrored in a cone 150
// degrees from it.
TEST_F(ShadingModels, KajiyaKayIsTheirEquations) {
    for (const double turn : {0.0, 77.0, 180.0}) {  // the eye may be anywhere on the cone
        const gpu::ModelProbe mirrored = probe(atDegrees(30), atDegrees(150, turn), 20.0f);
        EXPECT_NEAR(mirrored.kajiya_kay_diffuse, 0.5, kModelRounding) << turn;  // sin 30
        EXPECT_NEAR(mirrored.kajiya_kay_specular, 1.0, kModelRounding) << turn;
    }
    // 140 degrees is 10 degrees off the cone; cos(10)^20 = 0.736257. Perpendicular is 60 off:
    // 0.5^20.
    EXPECT_NEAR(
        probe(atDegrees(30), atDegrees(140, 20), 20.0f).kajiya_kay_specular, 0.736257,
        kModelRounding);
    EXPECT_NEAR(
        probe(atDegrees(30), atDegrees(90, 20), 2.0f).kajiya_kay_specular, 0.25, kModelRounding);
    // More than a right angle off gives nothing.
    EXPECT_EQ(probe(atDegrees(30), atDegrees(40), 2.0f).kajiya_kay_specular, 0.0f);
    // Light along the strand doesn't light it.
    const gpu::ModelProbe along = probe(atDegrees(0), atDegrees(90), 20.0f);
    EXPECT_NEAR(along.kajiya_kay_diffuse, 0.0, 1e-3);  // the square root of a rounding error
}

}  // namespace
}  // namespace hair::rendering
