#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include <gtest/gtest.h>

#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "engine/pipeline.h"
#include "engine/transfer.h"
#include "hair/reference/fiber.h"
#include "hair/rendering/fiber.h"
#include "hair/simulation/stiffness.h"
#include "tests/gpu_fixture.h"
#include "tests/probe_shaders.h"
#include "tests/rendering/fiber_rig.h"
#include "tests/rendering/published_fiber.h"

namespace hair::rendering {
namespace {

using std::numbers::pi;

// The shaders' answers to probes.
class GpuFiberTest : public GpuTest {
protected:
    static std::vector<gpu::FiberProbe>
    probe(const ShadingSettings& shading, std::span<const gpu::FiberProbe> probes) {
        Settings settings;
        settings.shading = shading;
        const HairOpticsBuffers optics(device(), settings);
        const engine::Buffer buffer = engine::makeBuffer(device(), probes, "fiber probes", "tests");
        probe_shaders::addTo(device());
        const engine::ComputePipeline pipeline(
            device(), {.shader = "probe_fiber.comp", .push_size = sizeof(gpu::ProbeFiberPush)});
        const gpu::ProbeFiberPush push{
            .optics = optics.address(),
            .probes = buffer.address(),
            .count = static_cast<std::uint32_t>(probes.size())};
        runOnce(device(), [&](engine::Commands& commands) {
            commands.bind(pipeline, push);
            commands.dispatchInvocations(push.count, 64);
        });
        return engine::downloadAs<gpu::FiberProbe>(device(), buffer);
    }

    static gpu::FiberProbe asked(
        const glm::dvec3& wo, const glm::dvec3& wi, double h, double strands = 0, double ended = 0,
        double returned = 0) {
        return {
            .to_eye = wo,
            .h = static_cast<float>(h),
            .to_light = wi,
            .strands = static_cast<float>(strands),
            .ended = static_cast<float>(ended),
            .returned = static_cast<float>(returned),
            .bsdf = {},
            .dual_scattering = {}};
    }

    // Random directions and places; half of the lights are near a lobe.
    static std::vector<gpu::FiberProbe> randomProbes(const Fiber& fiber, std::uint32_t count) {
        std::vector<gpu::FiberProbe> probes;
        for (std::uint32_t i = 0; i < count; ++i) {
            const auto u = [&](std::uint32_t number) { return double{random01(3, i, number)}; };
            const glm::dvec3 wo = direction(2 * u(0) - 1, 2 * pi * u(1));
            const double h = 2 * u(2) - 1;
            const glm::dvec3 wi =
                i % 2 == 0
                    ? direction(2 * u(3) - 1, 2 * pi * u(4))
                    : reference::sampleDirection(fiber, wo, h, std::array{u(3), u(4), u(5), u(6)});
            const double ended = i % 5 < 2 ? 0 : u(8);
            probes.push_back(
                asked(wo, wi, h, i % 8 < 2 ? 0 : 12 * u(7) * u(7), ended, ended * u(9)));
        }
        return probes;
    }
};

void expectNear(
    const glm::vec3& value, const glm::dvec3& expected, double relative, double absolute,
    std::size_t index) {
    for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(value[c], expected[c], relative * expected[c] + absolute)
            << "probe " << index << ", channel " << c;
}

TEST_F(GpuFiberTest, HoldsInTheWhiteFurnace) {
    for (const float m : kRoughnesses) {
        for (const float n : kRoughnesses) {
            std::vector<gpu::FiberProbe> probes;
            for (const FiberSample& sample : uniformSamples(m, n))
                probes.push_back(asked(direction(0.3, 2.0), sample.wi, sample.h));
            double sum = 0;
            for (const gpu::FiberProbe& answer : probe(whiteFiber(m, n), probes))
                sum += answer.bsdf.g;
            const double scattered = sum * 4 * pi / static_cast<double>(probes.size());
            EXPECT_GT(scattered, 0.95) << m << ' ' << n;
            EXPECT_LT(scattered, 1.05) << m << ' ' << n;
        }
    }
}

// Floats are off by 1e-7 in an angle's sine and 1e-6 in atan(): over the narrowest widths here,
// 0.02 along (TT at beta_m = 0.1: sigma = 0.04) and 0.024 across, less than 1e-3 of a value.
TEST_F(GpuFiberTest, AgreesWithTheReference) {
    for (const float m : kRoughnesses) {
        for (const float n : {0.1f, 0.3f, 0.9f}) {
            ShadingSettings shading = brownFiber();
            shading.longitudinal_roughness = m;
            shading.azimuthal_roughness = n;
            const Fiber fiber = makeFiber(shading);
            const std::vector<gpu::FiberProbe> answers = probe(shading, randomProbes(fiber, 2000));
            for (std::size_t i = 0; i < answers.size(); ++i) {
                const gpu::FiberProbe& answer = answers[i];
                expectNear(
                    answer.bsdf,
                    reference::scattering(fiber, answer.to_eye, answer.to_light, double{answer.h}),
                    1e-3, 1e-5, i);
            }
        }
    }
}

// The tolerance is that of AgreesWithTheReference; the table of averages is linear between 64
// angles.
TEST_F(GpuFiberTest, AgreesWithTheReferenceOfDualScattering) {
    for (const float m : {0.1f, 0.3f, 0.7f}) {
        ShadingSettings shading = brownFiber();
        shading.model = ShadingModel::dual_scattering;
        shading.longitudinal_roughness = m;
        const Fiber fiber = makeFiber(shading);
        const std::vector<gpu::FiberProbe> answers = probe(shading, randomProbes(fiber, 400));
        for (std::size_t i = 0; i < answers.size(); ++i) {
            const gpu::FiberProbe& answer = answers[i];
            expectNear(
                answer.dual_scattering,
                reference::dualScattering(
                    fiber, double{shading.density_factor}, answer.to_eye, answer.to_light,
                    double{answer.h},
                    {.strands = double{answer.strands},
                     .ended = double{answer.ended},
                     .returned = double{answer.returned}}),
                5e-3, 1e-4, i);
        }
    }
}

// Like AgreesWithTheReference, but from the papers' equations and not from the source of the
// device's parameters. Their sums are correct to 1e-6 of a value or better.
TEST_F(GpuFiberTest, AgreesWithThePublishedEquations) {
    for (const float m : kRoughnesses) {
        for (const float n : {0.1f, 0.3f, 0.9f}) {
            ShadingSettings shading = brownFiber();
            shading.longitudinal_roughness = m;
            shading.azimuthal_roughness = n;
            shading.pheomelanin = 0.1f;
            shading.cuticle_tilt = 3.0f;
            const published::Fiber fiber = published::makeFiber(shading);
            const auto answers = probe(shading, randomProbes(makeFiber(shading), 300));
            ASSERT_EQ(answers.size(), 300u);
            for (std::size_t i = 0; i < answers.size(); ++i) {
                const gpu::FiberProbe& answer = answers[i];
                const auto view = published::viewOf(answer.to_eye, answer.to_light);
                expectNear(
                    answer.bsdf, published::scattering(fiber, view, double{answer.h}), 1e-3, 1e-5,
                    i);
            }
        }
    }
}

// As AgreesWithTheReferenceOfDualScattering. Sums over half turns end within a part of 0.008 rad
// of N_p, which is 0.12 wide: the middles of parts are off there by its square over 24, 2e-4.
TEST_F(GpuFiberTest, AgreesWithThePublishedEquationsOfDualScattering) {
    for (const float m : {0.1f, 0.3f, 0.7f}) {
        ShadingSettings shading = brownFiber();
        shading.model = ShadingModel::dual_scattering;
        shading.longitudinal_roughness = m;
        const published::Fiber fiber = published::makeFiber(shading);
        const auto answers = probe(shading, randomProbes(makeFiber(shading), 64));
        ASSERT_EQ(answers.size(), 64u);
        for (std::size_t i = 0; i < answers.size(); ++i) {
            const gpu::FiberProbe& answer = answers[i];
            const auto view = published::viewOf(answer.to_eye, answer.to_light);
            expectNear(
                answer.dual_scattering,
                published::dualScattering(
                    fiber, double{shading.density_factor}, view, double{answer.h},
                    double{answer.strands}, double{answer.ended}, double{answer.returned}),
                5e-3, 1e-4, i);
        }
    }
}

TEST_F(GpuFiberTest, IsFiniteAtTheEdges) {
    std::vector<gpu::FiberProbe> probes;
    for (const double h : {-1.0, 0.0, 0.5, 1.0})
        for (const double o : {-1.0, -0.9999999, 0.3, 1.0})
            for (const double i : {-1.0, -0.3, 0.9999999, 1.0})
                for (const double phi : {0.0, pi / 2, pi})
                    for (const double strands : {0.0, 1e-9, 0.5, 1e4})
                        probes.push_back(asked(direction(o, 0), direction(i, phi), h, strands));
    for (const float roughness : {0.05f, 0.3f, 1.0f}) {
        for (const float eta : {1.01f, 1.55f, 3.0f}) {
            ShadingSettings shading = whiteFiber(roughness, roughness);
            shading.model = ShadingModel::dual_scattering;
            shading.cuticle_tilt = 10.0f;
            shading.refractive_index = eta;
            for (const gpu::FiberProbe& answer : probe(shading, probes)) {
                for (int c = 0; c < 3; ++c) {
                    ASSERT_TRUE(std::isfinite(answer.bsdf[c]) && answer.bsdf[c] >= 0);
                    ASSERT_TRUE(
                        std::isfinite(answer.dual_scattering[c]) && answer.dual_scattering[c] >= 0);
                }
            }
        }
    }
}

}  // namespace
}  // namespace hair::rendering
