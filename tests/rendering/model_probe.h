#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "engine/pipeline.h"
#include "engine/transfer.h"
#include "hair/rendering/environment.h"
#include "tests/gpu_fixture.h"
#include "tests/probe_shaders.h"

namespace hair::rendering {

// The answers of the device's functions of lights and models at points, for these lights.
inline std::vector<gpu::ModelProbe> probeModels(
    const engine::Device& device, const std::vector<LightSettings>& lights,
    std::vector<gpu::ModelProbe> probes) {
    static_assert(offsetof(gpu::ProbeModelsPush, count) == 16);
    Settings settings;
    settings.render.tone_map = ToneMap::srgb;  // linear colours
    settings.shading.lights = lights;
    probe_shaders::addTo(device);
    const engine::ComputePipeline pipeline(
        device, {.shader = "probe_models.comp", .push_size = sizeof(gpu::ProbeModelsPush)});
    const engine::Buffer light_buffer =
        engine::makeBuffer(device, makeLights(settings), "lights", "tests");
    const engine::Buffer buffer = engine::makeBuffer(device, probes, "probes", "tests");
    const auto count = static_cast<std::uint32_t>(probes.size());
    runOnce(device, [&](engine::Commands& commands) {
        commands.bind(
            pipeline,
            gpu::ProbeModelsPush{
                .lights = light_buffer.address(), .probes = buffer.address(), .count = count});
        commands.dispatch((count + 63) / 64, 1);
    });
    return engine::downloadAs<gpu::ModelProbe>(device, buffer);
}

}  // namespace hair::rendering
