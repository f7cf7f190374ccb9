#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "engine/pipeline.h"
#include "engine/transfer.h"
#include "hair/simulation/stiffness.h"
#include "tests/gpu_fixture.h"
#include "tests/probe_shaders.h"
#include "tests/rendering/surface_reference.h"

namespace hair::rendering {
namespace {

using gpu::SurfaceProbe;

static_assert(offsetof(SurfaceProbe, f) == 56 && sizeof(SurfaceProbe) == 68);

constexpr double kPi = std::numbers::pi;
constexpr glm::vec3 kUp(0.0f, 0.0f, 1.0f);

SurfaceProbe probeOf(
    float albedo, float metallic, float roughness, const glm::vec3& to_eye,
    const glm::vec3& to_light) {
    return {
        .base_color = glm::vec3(albedo),
        .metallic = metallic,
        .roughness = roughness,
        .normal = kUp,
        .to_eye = to_eye,
        .to_light = to_light,
        .f = {}};
}

glm::vec3 direction(double cosine, double azimuth) {
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    return {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine};
}

class SurfaceBrdfTest : public GpuTest {
protected:
    static std::vector<SurfaceProbe> asked(const std::vector<SurfaceProbe>& probes) {
        const engine::Buffer buffer =
            engine::makeBuffer(device(), probes, "surface probes", "tests");
        probe_shaders::addTo(device());
        const engine::ComputePipeline pipeline(
            device(), {.shader = "probe_surface.comp", .push_size = sizeof(gpu::SurfaceProbePush)});
        const gpu::SurfaceProbePush push{
            .probes = buffer.address(), .count = static_cast<std::uint32_t>(probes.size())};
        runOnce(device(), [&](engine::Commands& commands) {
            commands.bind(pipeline, push);
            commands.dispatchInvocations(push.count, 64);
        });
        return engine::downloadAs<SurfaceProbe>(device(), buffer);
    }
};

// Eye and light straight above: F = F0, D = 1 / (pi alpha^2), G = 1. With roughness 1 that is f =
// (1 - 0.04) c / pi + 0.04 / (4 pi) for a dielectric and c / (4 pi) for a metal.
TEST_F(SurfaceBrdfTest, HasItsValuesStraightAbove) {
    const auto probes = asked(
        {probeOf(0.5f, 0.0f, 1.0f, kUp, kUp), probeOf(0.5f, 1.0f, 1.0f, kUp, kUp),
         probeOf(0.5f, 1.0f, 0.5f, kUp, kUp)});
    // A few roundings of float.
    EXPECT_NEAR(probes[0].f.x, 0.96 * 0.5 / kPi + 0.01 / kPi, 1e-6);
    EXPECT_NEAR(probes[1].f.x, 0.5 / (4.0 * kPi), 1e-6);
    EXPECT_NEAR(probes[2].f.x, 16.0 * 0.5 / (4.0 * kPi), 1e-5);
}

// surface_reference.h has the same equations in double precision, in another form.
TEST_F(SurfaceBrdfTest, FollowsTheEquations) {
    std::mt19937 random(5);
    const auto number = [&] { return static_cast<float>(random() >> 8u) * 0x1p-24f; };
    std::vector<SurfaceProbe> probes;
    for (int i = 0; i < 4000; ++i)
        probes.push_back(probeOf(
            number(), number(), 0.1f + 0.9f * number(),
            direction(0.02 + 0.98 * number(), 6 * number()),
            direction(2.0 * number() - 1.0, 6 * number())));
    for (const SurfaceProbe& probe : asked(probes)) {
        const glm::dvec3 expected = reference::surfaceBrdf(
            {probe.base_color, probe.metallic, probe.roughness}, probe.normal, probe.to_eye,
            probe.to_light);
        // D loses 1 / alpha^2 of float's 6e-8 for narrow lobes: alpha = 0.01 at least.
        EXPECT_NEAR(probe.f.x, expected.x, 1e-6 + 1e-3 * expected.x);
    }
}

TEST_F(SurfaceBrdfTest, IsReciprocal) {
    const glm::vec3 one = direction(0.3, 1.0);
    const glm::vec3 other = direction(0.8, 4.0);
    const auto probes =
        asked({probeOf(0.7f, 0.4f, 0.6f, one, other), probeOf(0.7f, 0.4f, 0.6f, other, one)});
    EXPECT_NEAR(probes[0].f.x, probes[1].f.x, 1e-6);
}

TEST_F(SurfaceBrdfTest, ReflectsNoLightFromBehind) {
    const auto probes = asked({probeOf(1.0f, 0.5f, 0.5f, kUp, direction(-0.1, 0.0))});
    EXPECT_EQ(probes[0].f, glm::vec3(0.0f));
}

// The part of light from all around that a white surface sends to the eye: midpoints of strata of
// the projected hemisphere.
class SurfaceFurnaceTest : public SurfaceBrdfTest {
protected:
    static double albedo(float metallic, float roughness, double eye) {
        constexpr int kSide = 128;
        std::vector<SurfaceProbe> probes;
        for (int i = 0; i < kSide * kSide; ++i) {
            const double squared = (i / kSide + 0.5) / kSide;
            const double azimuth = 2.0 * kPi * (i % kSide + 0.5) / kSide;
            probes.push_back(probeOf(
                1.0f, metallic, roughness, direction(eye, 0.0),
                direction(std::sqrt(squared), azimuth)));
        }
        double sum = 0.0;
        for (const SurfaceProbe& probe : asked(probes)) sum += probe.f.x;
        return kPi * sum / (kSide * kSide);
    }
};

// With alpha = 1, D = 1 / pi. Seen from straight above, f = 1 / (2 pi (1 + cos)), so the whole is
// the integral of cos / (1 + cos) over cos in [0, 1]: 1 - ln 2. Several facets reflect the rest of
// the light, which the model leaves out.
TEST_F(SurfaceFurnaceTest, IsKnownForTheRoughestMetal) {
    // The integrand in cos^2 is smooth except at 0, where a stratum is 1/128 wide.
    EXPECT_NEAR(albedo(1.0f, 1.0f, 1.0), 1.0 - std::numbers::ln2, 1e-3);
}

// A white sphere in even light of 1 shows about 1. It reflects less because facets' second
// reflections are missing, and more near the horizon because glTF takes 1 - F at the facet. Mitsuba
// 3.9.1's `principled` with the base colour that hairbench exports, 0.96, shows the values here
// within 0.98 of the radius. Its matt part (Burley 2012) returns more of grazing light, by up to
// twice the roughness. This makes the difference of up to 2 % for roughness 0.5 and 6 % for 1.
TEST_F(SurfaceFurnaceTest, OfAWhiteSphereIsMitsubas) {
    struct Traced {
        float roughness;
        double mean;
        double difference;
    };
    for (const Traced& traced :
         {Traced{0.3f, 1.0208, 0.02}, Traced{0.5f, 1.0232, 0.02}, Traced{1.0f, 1.0311, 0.06}}) {
        constexpr int kRings = 12;
        double mean = 0.0;
        for (int i = 0; i < kRings; ++i)
            mean += albedo(0.0f, traced.roughness, std::sqrt(1.0 - 0.96 * (i + 0.5) / kRings));
        mean /= kRings;
        EXPECT_NEAR(mean, 1.0, 0.03) << traced.roughness;
        EXPECT_NEAR(mean, traced.mean, traced.difference) << traced.roughness;
    }
}

// The sum may be off by half a percent. For dielectrics this holds only for an eye up to 45
// degrees off the normal. glTF scatters 1 - F of the reflecting facet. Near the horizon the sum of
// that and the reflected light exceeds 1 (in double precision 1.069 with roughness 0.5 at cos 0.2),
// which is the model's fault.
TEST_F(SurfaceFurnaceTest, IsNotMoreThanAllLight) {
    for (const float roughness : {0.5f, 0.7f, 1.0f}) {
        for (const double eye : {1.0, 0.7, 0.2}) {
            EXPECT_LT(albedo(1.0f, roughness, eye), 1.005) << roughness << ' ' << eye;
            if (eye < 0.7) continue;
            EXPECT_LT(albedo(0.0f, roughness, eye), 1.005) << roughness << ' ' << eye;
        }
    }
}

}  // namespace
}  // namespace hair::rendering
