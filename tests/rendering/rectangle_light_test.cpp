// Rectangles of light against closed forms and sums over their points.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "engine/transfer.h"
#include "hair/reference/fiber.h"
#include "hair/rendering/environment.h"
#include "tests/gpu_fixture.h"
#include "tests/rendering/fiber_rig.h"
#include "tests/rendering/model_probe.h"
#include "tests/rendering/strand_probe.h"
#include "tests/rendering/surface_reference.h"

namespace hair::rendering {
namespace {

using std::numbers::pi;

// ---- References ---------------------------------------------------------------------------------

// A rectangle of radiance 1 in double precision, independent of rectangleFace().
struct Rectangle {
    glm::dvec3 middle;
    glm::dvec3 normal;  // unit; direction of its light
    glm::dvec3 half_width;
    glm::dvec3 half_height;
};

// The integral of `value(direction)` over the solid angle from the origin, by midpoints.
template <class Value>
auto overRectangle(const Rectangle& of, int steps, const Value& value) {
    decltype(value(glm::dvec3())) sum{};
    const double area = 4.0 * glm::length(glm::cross(of.half_width, of.half_height));
    for (int i = 0; i < steps; ++i)
        for (int k = 0; k < steps; ++k) {
            const glm::dvec3 point = of.middle + (2.0 * (i + 0.5) / steps - 1.0) * of.half_width +
                                     (2.0 * (k + 0.5) / steps - 1.0) * of.half_height;
            const double squared = glm::dot(point, point);
            const glm::dvec3 direction = point / std::sqrt(squared);
            const double angle = std::max(-glm::dot(direction, of.normal), 0.0) / squared;
            sum += angle * value(direction);
        }
    return sum * (area / (1.0 * steps * steps));
}

// The form factor of an element before the corner of a rectangle x * distance by y * distance that
// is parallel to it (Howell, Menguec, Daun and Siegel, Thermal Radiation Heat Transfer); odd in
// both.
double beforeCorner(double x, double y) {
    const double by_x = std::sqrt(1 + x * x);
    const double by_y = std::sqrt(1 + y * y);
    return (x / by_x * std::atan(y / by_x) + y / by_y * std::atan(x / by_y)) / (2 * pi);
}

// The form factor of an element at (x, y, 0) before a rectangle of these half sides round (0, 0,
// distance).
double parallelFormFactor(double x, double y, double half_x, double half_y, double distance) {
    const double left = (-half_x - x) / distance;
    const double right = (half_x - x) / distance;
    const double low = (-half_y - y) / distance;
    const double high = (half_y - y) / distance;
    return beforeCorner(right, high) - beforeCorner(left, high) - beforeCorner(right, low) +
           beforeCorner(left, low);
}

// A softbox of 0.4 by 0.2 m at 0.5 m over the plane z = 0. It shines down, and its height is along
// y.
LightSettings softbox() {
    return {
        .type = LightType::rectangle,
        .position = {0, 0, 0.5f},
        .direction = {0, 0, -1},
        .reference_distance = 0.5f,
        .up = {0, 1, 0.3f},
        .width = 0.4f,
        .height = 0.2f};
}

// ---- Matt surfaces ------------------------------------------------------------------------------

class RectangleLight : public GpuTest {
protected:
    // Irradiance over pi at points.
    static std::vector<double>
    irradiances(const LightSettings& light, const std::vector<gpu::ModelProbe>& points) {
        std::vector<double> result;
        for (const gpu::ModelProbe& probe : probeModels(device(), {light}, points))
            result.push_back(double{probe.color.x} * double{probe.matt});
        return result;
    }

    static gpu::ModelProbe at(const glm::vec3& position, const glm::vec3& normal) {
        return {
            .position = position,
            .normal = normal,
            .exponent = 50.0f,
            .tangent = {1, 0, 0},
            .to_eye = {0, 0, 1}};
    }
};

// Single precision: the contributions of the edges of a rectangle that is seen 0.2 rad wide cancel
// to a fifth.
constexpr double kEdgeRounding = 2e-5;

TEST_F(RectangleLight, HasItsColorAtTheReferenceDistance) {
    for (const float distance : {0.1f, 0.5f, 3.0f}) {
        LightSettings light = softbox();
        light.reference_distance = distance;
        EXPECT_NEAR(
            irradiances(light, {at({0, 0, 0.5f - distance}, {0, 0, 1})})[0], 1.0,
            kEdgeRounding * std::max(1.0f, 10 * distance));
    }
}

TEST_F(RectangleLight, LightsParallelSurfacesByTheFormFactor) {
    std::vector<gpu::ModelProbe> points;
    for (const float x : {0.0f, 0.2f, 0.3f, -0.7f})
        for (const float y : {0.0f, -0.1f, 0.4f}) points.push_back(at({x, y, 0}, {0, 0, 1}));
    const std::vector<double> found = irradiances(softbox(), points);
    const double radiance = 1.0 / parallelFormFactor(0, 0, 0.2, 0.1, 0.5);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double expected =
            radiance *
            parallelFormFactor(points[i].position.x, points[i].position.y, 0.2, 0.1, 0.5);
        EXPECT_NEAR(found[i], expected, kEdgeRounding) << i;
    }
}

// Turned surfaces from 5 cm to 2 m. Their horizon cuts off a part of the light or all of it.
TEST_F(RectangleLight, LightsTurnedSurfacesAsItsPointsDo) {
    std::mt19937 random(11);
    const auto number = [&] { return 2.0 * (random() + 0.5) / 4294967296.0 - 1.0; };
    std::vector<gpu::ModelProbe> points;
    while (points.size() < 200) {
        const glm::dvec3 normal(number(), number(), number());
        if (glm::length(normal) > 1.0 || glm::length(normal) < 0.1) continue;
        points.push_back(
            at({number(), number(), 0.45 - 1.5 * std::abs(number())}, glm::normalize(normal)));
    }
    const std::vector<double> found = irradiances(softbox(), points);
    const double radiance = 1.0 / parallelFormFactor(0, 0, 0.2, 0.1, 0.5);
    int cut = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::dvec3 position(points[i].position);
        const glm::dvec3 normal(points[i].normal);
        const Rectangle rectangle{
            glm::dvec3(0, 0, 0.5) - position, {0, 0, -1}, {0.2, 0, 0}, {0, 0.1, 0}};
        const double expected =
            radiance / pi * overRectangle(rectangle, 150, [&](const glm::dvec3& direction) {
                return std::max(glm::dot(direction, normal), 0.0);
            });
        // The sum's own error: a horizon goes through 150 of 22500 cells.
        EXPECT_NEAR(found[i], expected, 6e-4 * (1 + expected)) << i;
        double least = 1, most = -1;
        for (const double x : {-0.2, 0.2})
            for (const double y : {-0.1, 0.1}) {
                const double height = glm::dot(glm::dvec3(x, y, 0.5) - position, normal);
                least = std::min(least, height);
                most = std::max(most, height);
            }
        if (least < 0 && most > 0) ++cut;
    }
    EXPECT_GT(cut, 20);
}

TEST_F(RectangleLight, ShinesToOneSide) {
    const gpu::ModelProbe behind = at({0.1f, 0, 0.6f}, {0, 0, -1});
    EXPECT_EQ(irradiances(softbox(), {behind})[0], 0.0);
}

TEST_F(RectangleLight, WithoutAReferenceDistanceIsTheSameEverywhereBeforeIt) {
    LightSettings light = softbox();
    light.reference_distance = 0.0f;
    for (const float z : {0.3f, 0.0f, -2.0f})
        EXPECT_NEAR(irradiances(light, {at({0, 0, z}, {0, 0, 1})})[0], 1.0, kEdgeRounding);
}

// ---- Glossy surfaces ----------------------------------------------------------------------------

class GlossyRectangle : public GpuTest {
protected:
    static std::vector<gpu::RectangleProbe> asked(const std::vector<gpu::RectangleProbe>& probes) {
        const engine::Buffer buffer =
            engine::makeBuffer(device(), probes, "rectangle probes", "tests");
        probe_shaders::addTo(device());
        const engine::ComputePipeline pipeline(
            device(),
            {.shader = "probe_rectangle.comp", .push_size = sizeof(gpu::RectangleProbePush)});
        const gpu::RectangleProbePush push{
            .probes = buffer.address(), .count = static_cast<std::uint32_t>(probes.size())};
        runOnce(device(), [&](engine::Commands& commands) {
            commands.bind(pipeline, push);
            commands.dispatch((push.count + 63) / 64, 1);
        });
        return engine::downloadAs<gpu::RectangleProbe>(device(), buffer);
    }
};

gpu::RectangleProbe probeOf(const Rectangle& of, float metallic, float roughness, double eye) {
    gpu::RectangleProbe probe{
        .base_color = glm::vec3(0.8f),
        .metallic = metallic,
        .roughness = roughness,
        .normal = {0, 0, 1},
        .to_eye = {-std::sqrt(1 - eye * eye), 0, eye},
        .corners = {},
        .diffuse = {},
        .glossy = {}};
    probe.corners[0] = of.middle - of.half_width - of.half_height;
    probe.corners[1] = of.middle + of.half_width - of.half_height;
    probe.corners[2] = of.middle + of.half_width + of.half_height;
    probe.corners[3] = of.middle - of.half_width + of.half_height;
    return probe;
}

// A rectangle of these half sides that faces the origin from a direction, at a distance of 1 m.
Rectangle facing(const glm::dvec3& from, double half_width, double half_height, double turn) {
    const glm::dvec3 side = glm::normalize(glm::cross(from, glm::dvec3(0.1, 0.9, 0.3)));
    const glm::dvec3 up = glm::cross(side, from);
    // cross(half_width, half_height) is along `from`.
    const glm::dvec3 u = std::cos(turn) * side + std::sin(turn) * up;
    const glm::dvec3 v = glm::cross(from, u);
    return {from, -from, half_width * u, half_height * v};
}

struct Difference {
    double largest = 0;  // over the greatest value
    double mean = 0;  // mean of absolute values, over the mean
};

class Differences {
public:
    void add(double found, double expected) {
        largest_ = std::isfinite(found) ? std::max(largest_, std::abs(found - expected)) : 1e30;
        greatest_ = std::max(greatest_, expected);
        sizes_ += std::abs(found - expected);
        expected_ += expected;
    }
    Difference result() const { return {largest_ / greatest_, sizes_ / expected_}; }

private:
    double largest_ = 0, greatest_ = 0, sizes_ = 0, expected_ = 0;
};

// A metal under a rectangle 2 * size by 0.6 * size at 1 m, from 18 directions, seen from three.
std::pair<std::vector<gpu::RectangleProbe>, std::vector<Rectangle>>
metals(double size, float roughness) {
    std::pair<std::vector<gpu::RectangleProbe>, std::vector<Rectangle>> result;
    for (const double eye : {0.95, 0.6, 0.25})
        for (const double lean : {-1.2, -0.6, 0.0, 0.5, 1.0, 1.4})
            for (const double aside : {0.0, 0.25}) {
                const glm::dvec3 from =
                    glm::normalize(glm::dvec3(std::sin(lean), aside, std::cos(lean)));
                result.second.push_back(facing(from, size, 0.3 * size, 0.4));
                result.first.push_back(probeOf(result.second.back(), 1.0f, roughness, eye));
            }
    return result;
}

double reflectedSum(const gpu::RectangleProbe& probe, const Rectangle& rectangle, int steps) {
    return overRectangle(rectangle, steps, [&](const glm::dvec3& direction) {
        if (direction.z <= 0) return 0.0;
        const reference::Surface surface{probe.base_color, probe.metallic, probe.roughness};
        return direction.z *
               reference::surfaceBrdf(surface, probe.normal, probe.to_eye, direction).x;
    });
}

// The distribution of facets is exact, except for the curvature of a side's half vectors.
// Fresnel's reflectance and shadowing are those of one facet; their error grows with the width of
// light and lobe. So the tolerances of the largest and the mean difference grow with the
// rectangle, which is seen 11, 44 and 90 degrees long. The sums' own errors are below 1e-3.
TEST_F(GlossyRectangle, ReflectsAsTheSumOverItsPoints) {
    struct Row {
        double size;
        double largest;
        double mean;
    };
    for (const Row& row : {Row{0.1, 0.04, 0.015}, Row{0.4, 0.09, 0.03}, Row{1.0, 0.16, 0.08}})
        for (const float roughness : {0.15f, 0.4f, 0.7f, 1.0f}) {
            const auto [probes, rectangles] = metals(row.size, roughness);
            const auto found = asked(probes);
            Differences differences;
            for (std::size_t i = 0; i < probes.size(); ++i)
                differences.add(
                    double{found[i].diffuse.x} + double{found[i].glossy.x},
                    reflectedSum(probes[i], rectangles[i], roughness < 0.2f ? 240 : 60));
            EXPECT_LT(differences.result().largest, row.largest) << row.size << ' ' << roughness;
            EXPECT_LT(differences.result().mean, row.mean) << row.size << ' ' << roughness;
        }
}

// A smooth surface mirrors the radiance of a light that fills most of the sky. A light from below
// gives 0, and no NaN.
TEST_F(GlossyRectangle, MirrorsItsRadiance) {
    const Rectangle wide = facing({0, 0, 1}, 10, 10, 0);
    const Rectangle below = facing(glm::normalize(glm::dvec3(0.3, 0, -1)), 0.1, 0.1, 0);
    const auto found = asked({probeOf(wide, 1.0f, 0.1f, 0.9), probeOf(below, 1.0f, 0.1f, 0.9)});
    // For F0 = 0.8, Schlick's F is 0.800002 at 26 degrees; shadowing removes less than 1e-4 of it.
    EXPECT_NEAR(found[0].glossy.x, 0.8, 2e-3);
    EXPECT_EQ(found[1].glossy.x + found[1].diffuse.x, 0.0f);
}

// ---- Fibres -------------------------------------------------------------------------------------

class RectangleOnFiber : public GpuTest {
protected:
    // The difference for a fibre with these roughnesses under a rectangle of these half sides at 1
    // m; the second side is along the fibre.
    static Difference differenceOf(float roughness, const glm::vec2& half) {
        Settings settings;
        settings.render.tone_map = ToneMap::srgb;
        settings.shading = brownFiber();
        settings.shading.model = ShadingModel::marschner;
        settings.shading.longitudinal_roughness = roughness;
        settings.shading.azimuthal_roughness = roughness;
        const Fiber fiber = makeFiber(settings.shading);
        Differences differences;
        for (const double theta : {0.0, 0.5, -0.9}) {
            const glm::dvec3 from = direction(std::sin(theta), 0.7);
            const glm::dvec3 along = glm::normalize(glm::dvec3(1, 0, 0) - from.x * from);
            const glm::dvec3 across = glm::cross(along, from);
            settings.shading.lights = {
                {.type = LightType::rectangle,
                 .position = from,
                 .direction = -from,
                 .reference_distance = 1.0f,
                 .up = along,
                 .width = 2 * half.x,
                 .height = 2 * half.y}};
            const Rectangle rectangle{from, -from, double{half.x} * across, double{half.y} * along};
            const double radiance = 1.0 / parallelFormFactor(0, 0, half.x, half.y, 1);
            for (const gpu::StrandProbe& probe : shadeStrands(device(), settings, viewsOfFiber()))
                differences.add(
                    probe.color.g,
                    radiance * overRectangle(rectangle, 24, [&](const glm::dvec3& wi) {
                        return reference::scattering(fiber, probe.to_eye, wi, probe.across).g;
                    }));
        }
        return differences.result();
    }

    static std::vector<gpu::StrandProbe> viewsOfFiber() {
        std::vector<gpu::StrandProbe> probes;
        for (const double sin_o : {-0.8, -0.4, 0.0, 0.3, 0.7})
            for (const double phi : {0.7, 1.5, 2.5, 3.6, 4.6, 5.6})
                for (const float h : {-0.8f, -0.3f, 0.1f, 0.6f})
                    probes.push_back(
                        {.tangent = {1, 0, 0},
                         .to_eye = direction(sin_o, phi),
                         .across = h,
                         .normal = {},
                         .color = {}});
        return probes;
    }
};

// The remaining error comes from the shape of a rectangle's part: a box, not a bell. A part
// reaches up to 1.5 standard deviations of the narrowest lobe to each side, as long as four parts
// a side are enough (half a side of 0.87 m at a roughness of 0.3; of 0.4 m at 0.2).
TEST_F(RectangleOnFiber, ScattersAsTheSumOverItsPoints) {
    struct Row {
        float roughness;
        glm::vec2 half;
        double largest;
        double mean;
    };
    for (const Row& row :
         {Row{0.2f, {0.3f, 0.3f}, 0.10, 0.05}, Row{0.2f, {0.5f, 0.1f}, 0.13, 0.08},
          Row{0.3f, {0.1f, 0.1f}, 0.06, 0.05}, Row{0.3f, {0.3f, 0.3f}, 0.08, 0.05},
          Row{0.3f, {0.5f, 0.1f}, 0.06, 0.05}, Row{0.3f, {0.1f, 0.5f}, 0.06, 0.05},
          Row{0.3f, {0.6f, 0.6f}, 0.16, 0.08}, Row{0.5f, {0.3f, 0.3f}, 0.08, 0.06},
          Row{0.5f, {0.6f, 0.6f}, 0.16, 0.08}}) {
        const Difference found = differenceOf(row.roughness, row.half);
        EXPECT_LT(found.largest, row.largest) << row.roughness << ' ' << row.half.x;
        EXPECT_LT(found.mean, row.mean) << row.roughness << ' ' << row.half.x;
    }
}

}  // namespace
}  // namespace hair::rendering
