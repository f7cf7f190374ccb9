#pragma once

#include <vector>

#include "engine/frame_loop.h"
#include "engine/target.h"
#include "hair/rendering/renderer.h"
#include "tests/rendering/device_hair.h"

namespace hair::rendering {

// Small pictures in linear light on black, without shadows.
inline Settings linearPicture(std::uint32_t width, std::uint32_t height) {
    Settings settings;
    settings.render.width = width;
    settings.render.height = height;
    settings.render.tone_map = ToneMap::srgb;
    settings.render.background = glm::vec3(0.0f);
    settings.strands.density = 16;
    return settings;
}

// Linear light of a groom, [row][column] RGB.
inline std::vector<float>
drawLinear(const engine::Device& device, const Settings& settings, const groom::Groom& groom) {
    const DeviceHair hair(device, groom, settings);
    Renderer renderer(device, settings, hair.view(), {});
    engine::FrameLoop loop(device, engine::Timing::overlapped);
    loop.frame([&](engine::Passes& passes) { renderer.record(passes, hair.view()); });
    loop.finish();
    return engine::readRadiance(device, renderer.target());
}

}  // namespace hair::rendering
