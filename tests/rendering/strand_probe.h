#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "engine/pipeline.h"
#include "engine/transfer.h"
#include "hair/rendering/environment.h"
#include "hair/rendering/fiber.h"
#include "hair/shader_codes.h"
#include "tests/gpu_fixture.h"
#include "tests/probe_shaders.h"

namespace hair::rendering {

// The device's shading of points of strands at the origin, 0.1 mm wide and without shadows. With a
// far field, pixels are this wide, m.
inline std::vector<gpu::StrandProbe> shadeStrands(
    const engine::Device& device, const Settings& settings,
    const std::vector<gpu::StrandProbe>& probes, float pixel = 0.0f) {
    static_assert(sizeof(gpu::StrandProbe) == 52 && sizeof(gpu::ProbeStrandPush) == 20);
    const HairOpticsBuffers optics(device, settings);
    const engine::Buffer lights =
        engine::makeBuffer(device, makeLights(settings), "lights", "tests");
    gpu::PictureParameters picture{};
    picture.hair_color = settings.shading.color;
    picture.ambient = settings.shading.ambient;
    picture.diffuse = settings.shading.diffuse;
    picture.specular = settings.shading.specular;
    picture.exponent = settings.shading.exponent;
    picture.light_count = static_cast<std::uint32_t>(settings.shading.lights.size());
    picture.lights = lights.address();
    picture.optics = optics.address();
    picture.pixel_near = pixel;
    const engine::Buffer parameters =
        engine::makeBuffer(device, std::array{picture}, "picture", "tests");
    const engine::Buffer buffer = engine::makeBuffer(device, probes, "strand probes", "tests");
    probe_shaders::addTo(device);
    const engine::ComputePipeline pipeline(
        device, {.shader = "probe_strand.comp",
                 .constants =
                     {{gpu::kModelConstant, shaderCode(settings.shading.model)},
                      {gpu::kLightCountConstant, picture.light_count},
                      {gpu::kLightKindsConstant, lightKinds(settings)},
                      {gpu::kFarFieldConstant, settings.shading.far_field}},
                 .push_size = sizeof(gpu::ProbeStrandPush)});
    const auto count = static_cast<std::uint32_t>(probes.size());
    runOnce(device, [&](engine::Commands& commands) {
        commands.bind(
            pipeline,
            gpu::ProbeStrandPush{
                .picture = parameters.address(), .probes = buffer.address(), .count = count});
        commands.dispatch((count + 63) / 64, 1);
    });
    return engine::downloadAs<gpu::StrandProbe>(device, buffer);
}

}  // namespace hair::rendering
