// Tests shadows of lights that have a size, with several maps per light, against closed forms of
// penumbras and against many point lights.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/gpu_fixture.h"
#include "tests/rendering/shadow_probe.h"

namespace hair::rendering {
namespace {

using LightSizeShadow = GpuTest;

// ---- A straight edge ----------------------------------------------------------------------------

constexpr float kSide = 0.1f;  // m: half of the occluder's
constexpr float kReceiver = 0.02f;  // m: distance of the lit surface behind it
constexpr float kLamp = 0.4f;  // m: distance of the lights in front of it

// In the plane z = 0, its edges along x and y.
groom::Mesh occluder() {
    return {
        .positions =
            {{-kSide, -kSide, 0}, {kSide, -kSide, 0}, {kSide, kSide, 0}, {-kSide, kSide, 0}},
        .normals = std::vector<glm::vec3>(4, glm::vec3(0, 0, 1)),
        .triangles = {{0, 1, 2}, {0, 2, 3}},
        .triangle_materials = {0, 0},
        .materials = {{.name = "square"}}};
}

// The lamp is over the middle of the edge x = kSide. Half of a penumbra is half of the light times
// kReceiver / kLamp, 5 mm at most, so the other edges don't reach it.
LightSettings lampOf(LightType type) {
    return {
        .type = type,
        .position = {kSide, 0, kLamp},
        .direction = {0, 0, -1},
        .radius = 0.1f,
        .angular_radius = 12.0f,
        .width = 0.2f,
        .height = 0.12f};
}

// Part of the light beyond x in its plane, which is 1 from its middle to its edge.
double beyond(LightType type, double x) {
    x = std::clamp(x, -1.0, 1.0);
    if (type == LightType::rectangle) return 0.5 * (1 - x);
    return 0.5 - (x * std::sqrt(1 - x * x) + std::asin(x)) / std::numbers::pi;
}

// Half of the penumbra's width on the receiver.
double halfPenumbra(LightType type) {
    const LightSettings lamp = lampOf(type);
    if (type == LightType::directional)
        return kReceiver * std::tan(lamp.angular_radius * std::numbers::pi / 180);
    if (type == LightType::rectangle) return 0.5 * lamp.width * kReceiver / kLamp;
    // The outline of a sphere as seen from the edge's foot.
    const double apart = kLamp + kReceiver;
    const double radius = lamp.radius / std::sqrt(1 - std::pow(lamp.radius / apart, 2));
    return radius * kReceiver / kLamp;
}

// Places from x = -1 to 1 in the penumbra, and a quarter of it beyond.
std::vector<float> penumbraPlaces() {
    std::vector<float> places;
    for (int i = -50; i <= 50; ++i) places.push_back(0.025f * static_cast<float>(i));
    return places;
}

std::vector<double> penumbra(const engine::Device& device, LightType type, std::uint32_t samples) {
    const groom::Mesh mesh = occluder();
    Settings settings;
    settings.render.hair = false;
    settings.shading.lights = {lampOf(type)};
    settings.shading.lights[0].shadow_samples = samples;
    settings.shading.shadows.meshes = true;
    settings.shading.shadows.resolution = 1024;
    settings.shading.shadows.softness = 0.5f;
    std::vector<glm::vec3> points;
    for (const float place : penumbraPlaces())
        points.emplace_back(
            kSide + place * static_cast<float>(halfPenumbra(type)), 0.0f, -kReceiver);
    StrandView bald;
    bald.vertices_per_guide = 2;
    std::vector<double> lit;
    for (const FoundPath& path : findPaths(device, settings, bald, {.head = &mesh}, points))
        lit.push_back(double{path.meshes});
    return lit;
}

double largestError(LightType type, const std::vector<double>& lit) {
    double largest = 0;
    const std::vector<float> places = penumbraPlaces();
    for (std::size_t i = 0; i < lit.size(); ++i)
        largest = std::max(largest, std::abs(lit[i] - (1 - beyond(type, places[i]))));
    return std::ranges::all_of(lit, [](double part) { return std::isfinite(part); }) ? largest : 1;
}

// The part of a disc's N points beyond a line is off by N^-3/4; no set of N points can do better
// (Beck and Chen 1987, Irregularities of distribution). The points of a rectangle are in equal
// steps along its width. The map adds up to half a texel, which is 0.14 mm where the penumbra is at
// least 8 mm wide.
TEST_F(LightSizeShadow, PenumbraOfAnEdgeHasItsWidthAndProfile) {
    for (const LightType type : {LightType::rectangle, LightType::directional, LightType::sphere})
        for (const std::uint32_t samples : {4u, 16u, 64u}) {
            const double count = samples;
            const double points =
                type == LightType::rectangle ? 0.5 / count : std::pow(count, -0.75);
            EXPECT_LT(largestError(type, penumbra(device(), type, samples)), points + 0.0175)
                << static_cast<int>(type) << ' ' << samples;
        }
}

TEST_F(LightSizeShadow, OneSampleIsTheShadowOfTheMiddle) {
    for (const LightType type : {LightType::rectangle, LightType::sphere, LightType::directional}) {
        const std::vector<double> lit = penumbra(device(), type, 1);
        const std::vector<float> places = penumbraPlaces();
        for (std::size_t i = 0; i < lit.size(); ++i) {
            if (std::abs(places[i]) < 0.2f) continue;  // the filter blurs this part
            EXPECT_EQ(lit[i], places[i] > 0 ? 1.0 : 0.0) << i;
        }
    }
}

// ---- Hair ---------------------------------------------------------------------------------------

// Straight strands along y in two planes, on one side of x = 0.
groom::Groom hairWithAnEdge() {
    groom::Groom groom{.vertices_per_strand = 2};
    for (const float depth : {0.0f, 0.008f})
        for (int i = 0; i < 60; ++i) {
            const float x = -0.001f * (static_cast<float>(i) + 0.5f);
            groom.points.emplace_back(x, -0.06f, -depth);
            groom.points.emplace_back(x, 0.06f, -depth);
            groom.root_triangles.push_back(
                {groom.strand_count, groom.strand_count, groom.strand_count});
            ++groom.strand_count;
        }
    return groom;
}

Settings hairSettings(HairShadows shadows) {
    Settings settings;
    settings.strands.backend = Backend::tessellation;
    settings.strands.density = 1;
    settings.strands.tessellation = 1;
    settings.strands.root_width = settings.strands.tip_width = 0.0006f;
    settings.shading.shadows.hair = shadows;
    settings.shading.shadows.resolution = 256;
    settings.shading.shadows.softness = 1.0f;
    return settings;
}

// Points in the plane z = -0.03, from the shadow to the light, a few on each line.
std::vector<glm::vec3> acrossTheEdge() {
    std::vector<glm::vec3> points;
    for (int i = -40; i <= 40; ++i)
        for (int k = -2; k <= 2; ++k)
            points.emplace_back(
                0.0005f * static_cast<float>(i), 0.004f * static_cast<float>(k), -0.03f);
    return points;
}

// The mean visibility of 256 points of the light, in strata, each treated as a separate light.
std::vector<double> manyPoints(
    const engine::Device& device, Settings settings, const LightSettings& lamp,
    const groom::Groom& groom) {
    const std::vector<glm::vec3> points = acrossTheEdge();
    std::vector<double> sum(points.size());
    std::mt19937 random(7);
    const auto number = [&] { return (random() + 0.5) / 4294967296.0; };
    const double apart = glm::length(glm::dvec3(lamp.position));
    const double outline = lamp.radius / std::sqrt(1 - std::pow(lamp.radius / apart, 2));
    for (int row = 0; row < 16; ++row) {
        settings.shading.lights.clear();
        for (int column = 0; column < 16; ++column) {
            const double u = (column + number()) / 16;
            const double v = (row + number()) / 16;
            glm::dvec2 place(lamp.width * (u - 0.5), lamp.height * (v - 0.5));
            if (lamp.type == LightType::sphere) {
                const double radius = outline * std::sqrt(u);
                const double angle = 2 * std::numbers::pi * v;
                place = {radius * std::cos(angle), radius * std::sin(angle)};
            }
            settings.shading.lights.push_back(
                {.position = lamp.position + glm::vec3(place.x, place.y, 0.0f)});
        }
        const DeviceHair hair(device, groom, settings);
        std::vector<gpu::ShadowProbe> probes;
        for (const glm::vec3& point : points)
            for (std::uint32_t light = 0; light < 16; ++light)
                probes.push_back(
                    {.position = point,
                     .light = light,
                     .normal = glm::vec3(0.0f),
                     .tangent = {0, 1, 0},
                     .width = 0.0f});
        const auto paths = findPaths(device, settings, hair.view(), {}, probes);
        for (std::size_t i = 0; i < paths.size(); ++i)
            sum[i / 16] += double{paths[i].visibility} / 256;
    }
    return sum;
}

// Resembles the penumbra of an edge, for light through hair.
TEST_F(LightSizeShadow, OfHairIsTheMeanOverThePointsOfTheLight) {
    const groom::Groom groom = hairWithAnEdge();
    for (const HairShadows shadows : {HairShadows::deep_opacity, HairShadows::deep_shadow})
        for (const LightType type : {LightType::rectangle, LightType::sphere}) {
            Settings settings = hairSettings(shadows);
            LightSettings lamp = lampOf(type);
            lamp.position = {0, 0, kLamp};
            const std::vector<double> expected = manyPoints(device(), settings, lamp, groom);
            for (const std::uint32_t samples : {4u, 16u, 64u}) {
                lamp.shadow_samples = samples;
                settings.shading.lights = {lamp};
                const DeviceHair hair(device(), groom, settings);
                const auto paths = findPaths(device(), settings, hair.view(), {}, acrossTheEdge());
                ASSERT_EQ(paths.size(), expected.size());
                double least = 1, most = 0;
                for (std::size_t i = 0; i < paths.size(); ++i) {
                    ASSERT_NEAR(double{paths[i].visibility}, expected[i], std::pow(samples, -0.75))
                        << samples << ", point " << i;
                    least = std::min(least, expected[i]);
                    most = std::max(most, expected[i]);
                }
                EXPECT_LT(least, 0.6);  // there is a shadow
                EXPECT_EQ(most, 1.0);
            }
        }
}

}  // namespace
}  // namespace hair::rendering
