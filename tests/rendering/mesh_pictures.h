#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/frame_loop.h"
#include "hair/rendering/renderer.h"
#include "tests/rendering/device_hair.h"
#include "tests/rendering/pictures.h"

namespace hair::rendering {

using Rgb = std::array<int, 3>;

inline constexpr Rgb kBackground{64, 38, 46};

// A square of 1 m in the plane z = 0 that faces +z, with the texture coordinates of glTF: (0, 0) is
// at the top left.
inline groom::Mesh quad(const groom::Material& material = {}) {
    return {
        .positions =
            {{-0.5f, -0.5f, 0.0f}, {0.5f, -0.5f, 0.0f}, {0.5f, 0.5f, 0.0f}, {-0.5f, 0.5f, 0.0f}},
        .normals = std::vector<glm::vec3>(4, {0.0f, 0.0f, 1.0f}),
        .texture_coordinates = {{0, 1}, {1, 1}, {1, 0}, {0, 0}},
        .triangles = {{0, 1, 2}, {0, 2, 3}},
        .triangle_materials = {0, 0},
        .materials = {material}};
}

// The square fills the picture, `side` pixels wide. A white, matt surface shows the ambient light
// alone.
inline Settings quadSettings(std::uint32_t side) {
    Settings settings;
    settings.render.width = settings.render.height = side;
    settings.render.hair = false;
    settings.camera.field_of_view = 90.0f;
    settings.camera.position = {0.0f, 0.0f, 0.5f};
    settings.shading.ambient = 1.0f;
    settings.shading.diffuse = 0.0f;
    return settings;
}

// The same settings with linear light: the light is behind the square, and the ambient light is
// white.
inline Settings linearSettings(std::uint32_t side) {
    Settings settings = quadSettings(side);
    settings.render.tone_map = ToneMap::srgb;
    settings.shading.lights = {{.type = LightType::directional, .direction = {0.0f, 0.0f, 1.0f}}};
    return settings;
}

// Only one light, which shines opposite to this direction.
inline void lightFrom(Settings& settings, const glm::vec3& to_light) {
    settings.shading.ambient = 0.0f;
    settings.shading.diffuse = 1.0f;
    settings.shading.lights = {{.type = LightType::directional, .direction = -to_light}};
}

inline Pixels drawScene(
    const engine::Device& device, const Settings& settings, const RenderAssets& assets,
    const glm::mat4& head = glm::mat4(1.0f),
    const groom::Groom& groom = oneTriangle(std::vector{
        glm::vec3(0, 0, 5), glm::vec3(0, 0.1, 5)})) {
    const DeviceHair hair(device, groom, settings);
    StrandView view = hair.view();
    view.head = head;
    Renderer renderer(device, settings, view, assets);
    engine::FrameLoop loop(device, engine::Timing::overlapped);
    loop.frame([&](engine::Passes& passes) { renderer.record(passes, view); });
    loop.finish();
    return engine::readOutput(device, renderer.target());
}

inline Pixels
drawQuad(const engine::Device& device, const Settings& settings, const groom::Mesh& mesh) {
    return drawScene(device, settings, {.head = &mesh});
}

inline Rgb at(const Pixels& pixels, std::uint32_t width, std::uint32_t x, std::uint32_t y) {
    const std::size_t first = 4 * (std::size_t{y} * width + x);
    return {pixels[first], pixels[first + 1], pixels[first + 2]};
}

// IEC 61966-2-1: linear light as a byte of the picture.
inline double displayByte(double linear) {
    return 255.0 *
           (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055);
}

}  // namespace hair::rendering
