// Tests models in pictures of one strand as wide as the picture, upright in front of the eye.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <glm/exponential.hpp>
#include <gtest/gtest.h>

#include "hair/rendering/render_assets.h"
#include "tests/gpu_fixture.h"
#include "tests/rendering/linear_picture.h"

namespace hair::rendering {
namespace {

constexpr std::uint32_t kWidth = 64;  // px, of the strand too

// Light from `azimuth` degrees to the right of the eye, in the plane across the strand.
Settings wideStrand(ShadingModel model, double azimuth) {
    Settings settings = linearPicture(kWidth, 4);
    settings.strands.density = 1;
    settings.strands.root_width = settings.strands.tip_width = 0.1f;
    settings.camera.position = {0, 0, 10};
    // The strand is 0.1 m wide at 10 m.
    settings.camera.field_of_view =
        static_cast<float>(360.0 / std::numbers::pi * std::atan(0.5 * 0.1 / 10.0 * 4.0 / kWidth));
    settings.shading.model = model;
    settings.shading.ambient = 0.0f;
    const double angle = azimuth * std::numbers::pi / 180.0;
    settings.shading.lights = {
        {.type = LightType::directional, .direction = {-std::sin(angle), 0.0, -std::cos(angle)}}};
    return settings;
}

class ShadingModelPictures : public GpuTest {
protected:
    // Green along a row of pixels that shows a strand, 2 m long, with this direction up.
    static std::vector<double>
    across(const Settings& settings, const glm::vec3& up = {0.0f, 1.0f, 0.0f}) {
        const groom::Groom groom = oneTriangle({-up, glm::vec3(0.0f), up});
        const std::vector<float> light = drawLinear(device(), settings, groom);
        std::vector<double> row;
        for (std::uint32_t x = 0; x < kWidth; ++x) row.push_back(light[3 * (2 * kWidth + x) + 1]);
        return row;
    }

    // Place of a pixel's middle, -1 to 1 from left to right.
    static double place(std::size_t x) { return (2.0 * static_cast<double>(x) + 1.0) / kWidth - 1; }

    static double brightestPlace(const Settings& settings) {
        const std::vector<double> row = across(settings);
        EXPECT_GT(std::ranges::max(row), 0.0) << "nothing is lit";
        return place(static_cast<std::size_t>(std::ranges::max_element(row) - row.begin()));
    }
};

// The strand may have any direction. If it is level or upright, the ends of its quads lie along
// rows of samples.
TEST_F(ShadingModelPictures, NoneHasAHoleInAStrandThatFillsThePicture) {
    Settings settings = wideStrand(ShadingModel::phong, 0.0);
    settings.strands.root_width = settings.strands.tip_width = 0.3f;
    settings.shading.ambient = 1.0f;
    for (const Backend backend :
         {Backend::tessellation, Backend::pulling_geometry, Backend::pulling, Backend::expanded,
          Backend::software}) {
        settings.strands.backend = backend;
        for (int turn = 0; turn < 16; ++turn) {
            // Exact if the strand is level or upright.
            const int x = turn % 8 < 4 ? turn % 4 : 4 - turn % 4;
            const int y = turn % 8 < 4 ? 4 - turn % 4 : -(turn % 4);
            const glm::vec3 up = (turn < 8 ? 0.25f : -0.25f) * glm::vec3(x, y, 0.0f);
            for (const double value : across(settings, up))
                ASSERT_GT(value, 0.1) << backendName(backend) << ' ' << up.x << ' ' << up.y;
        }
    }
}

// n . l of a cylinder: cos(azimuth - arc sine of the place).
TEST_F(ShadingModelPictures, PhongIsMattOnACylinder) {
    Settings settings = wideStrand(ShadingModel::phong, 60.0);
    settings.shading.color = glm::vec3(1.0f);
    settings.shading.diffuse = 0.75f;
    settings.shading.specular = 0.0f;
    const std::vector<double> row = across(settings);
    for (std::size_t x = 1; x + 1 < row.size(); ++x) {
        const double cosine = std::cos(std::numbers::pi / 3 - std::asin(place(x)));
        // A hundredth of a pixel's step of `across` there, and a half float's rounding.
        EXPECT_NEAR(row[x], 0.75 * std::max(cosine, 0.0), 2e-3) << x;
    }
}

// Equal from edge to edge: sin(T, L) = 1.
TEST_F(ShadingModelPictures, KajiyaKayIsFlatAcrossTheStrand) {
    Settings settings = wideStrand(ShadingModel::kajiya_kay, 60.0);
    settings.shading.color = glm::vec3(1.0f);
    settings.shading.diffuse = 0.25f;
    settings.shading.specular = 0.5f;
    for (const double value : across(settings)) EXPECT_NEAR(value, 0.75, 1e-3);
}

// Black fibres scatter only the surface's mirror image of the light. It lies at the normal halfway
// between eye and light: at sin(azimuth / 2), on the light's side. A lobe is 0.03 rad wide (s of
// beta_n = 0.1: 0.0240); two of them are 4 px here, and Fresnel's factor grows towards the edge.
TEST_F(ShadingModelPictures, FibresMirrorTheLightOnItsSide) {
    for (const ShadingModel model : {ShadingModel::marschner, ShadingModel::dual_scattering}) {
        for (const double azimuth : {60.0, -40.0}) {
            Settings settings = wideStrand(model, azimuth);
            settings.shading.color_from = ColorSource::melanin;
            settings.shading.eumelanin = 100.0f;
            settings.shading.azimuthal_roughness = 0.1f;
            EXPECT_NEAR(
                brightestPlace(settings), std::sin(azimuth * std::numbers::pi / 360.0), 0.06)
                << azimuth;
        }
    }
}

// Black fibres show only their surface's reflection. It is light that has not been in the fibre, so
// the strand's own colour does not change it. Less than exp(-40) of other light comes through.
TEST_F(ShadingModelPictures, OwnColorsLeaveTheSurfacesReflection) {
    for (const ShadingModel model : {ShadingModel::marschner, ShadingModel::dual_scattering}) {
        Settings settings = wideStrand(model, 60.0);
        settings.shading.color_from = ColorSource::melanin;
        settings.shading.eumelanin = 100.0f;
        const std::vector<double> one_color = across(settings);
        settings.shading.strand_variation = 0.2f;
        settings.shading.tip_lightening = 0.2f;
        const std::vector<double> own = across(settings);
        for (std::size_t x = 0; x < own.size(); ++x)
            EXPECT_NEAR(own[x], one_color[x], 1e-3 * one_color[x]) << x;  // a step of half floats
    }
}

// In its middle, a strand with tips lighter by 1/2 has the power 3/4. It looks like hair of the
// colour c^(3/4): by equation (9) of Chiang et al. 2016, hair of 9/16 of the absorption. The
// picture shows 1/300 of the strand's length, in which the power changes by 1/600. The light that
// comes through then changes by 1 %, with an absorption of at most 2.7 here.
TEST_F(ShadingModelPictures, OwnColorsAreThoseOfHairWithTheirAbsorption) {
    const glm::vec3 color(0.5f, 0.16f, 0.07f);
    for (const ShadingModel model : {ShadingModel::marschner, ShadingModel::dual_scattering}) {
        for (const double azimuth : {20.0, 150.0}) {
            Settings settings = wideStrand(model, azimuth);
            settings.shading.color = color;
            settings.shading.tip_lightening = 0.5f;
            const std::vector<double> own = across(settings);
            settings.shading.tip_lightening = 0.0f;
            settings.shading.color = toDisplay(glm::pow(toLinear(color), glm::dvec3(0.75)));
            const std::vector<double> expected = across(settings);
            for (std::size_t x = 0; x < own.size(); ++x)
                EXPECT_NEAR(own[x], expected[x], 0.01 * expected[x] + 1e-4)
                    << static_cast<int>(model) << ' ' << azimuth << ' ' << x;
        }
    }
}

// A clear fibre bends light from behind like a lens: seen from the front, light from behind on the
// right comes out on the left.
TEST_F(ShadingModelPictures, FibresLetLightThroughOnTheOtherSide) {
    Settings settings = wideStrand(ShadingModel::marschner, 150.0);
    settings.shading.color = glm::vec3(1.0f);
    settings.shading.azimuthal_roughness = 0.1f;
    EXPECT_LT(brightestPlace(settings), -0.1);
}

// A white furnace: under radiance 1 from everywhere a white fibre shows 1. Light of colour 1 has
// the irradiance pi, so over directions spread evenly over the sphere the mean is 1 / 4. 128
// directions sample lobes of this width to 1 %, and pixels sample the strand's width to 1 %. The
// model loses up to 5 %, as much as pbrt's tests of it allow.
TEST_F(ShadingModelPictures, WhiteFibresReturnAllLight) {
    constexpr int kDirections = 128;
    Settings settings = wideStrand(ShadingModel::marschner, 0.0);
    settings.shading.color = glm::vec3(1.0f);
    settings.shading.cuticle_tilt = 0.0f;
    settings.shading.longitudinal_roughness = 0.7f;
    settings.shading.azimuthal_roughness = 0.7f;
    double sum = 0.0;
    for (int first = 0; first < kDirections; first += 16) {
        settings.shading.lights.clear();
        for (int i = first; i < first + 16; ++i) {
            const double y = (2.0 * i + 1.0) / kDirections - 1.0;
            const double turn = i * std::numbers::pi * (3.0 - std::sqrt(5.0));  // Fibonacci lattice
            const double ring = std::sqrt(1.0 - y * y);
            settings.shading.lights.push_back(
                {.type = LightType::directional,
                 .direction = {ring * std::cos(turn), y, ring * std::sin(turn)}});
        }
        for (const double value : across(settings)) sum += value;
    }
    EXPECT_NEAR(sum / (kDirections * kWidth), 0.25, 0.25 * 0.05);
}

}  // namespace
}  // namespace hair::rendering
