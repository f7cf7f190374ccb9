#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "engine/pictures.h"
#include "engine/pipeline.h"
#include "hair/rendering/render_assets.h"
#include "hair/settings.h"
#include "hair/shading_settings.h"

namespace hair::rendering {

// Light from all around: the background that it is, and what matt surfaces get of it.
// shaders/environment/radiance.glsl says which way its picture lies; /render/environment_turn turns
// it about +y, by the right-hand rule. Where there is no tone map, what is seen of it and what it
// lights are turned into display colours, clipped.
class EnvironmentPass {
public:
    EnvironmentPass(
        const engine::Device& device, const Settings& settings, const RenderAssets& assets);

    // Address of gpu::EnvironmentParameters; 0 where there is no environment.
    std::uint64_t address() const { return parameters_.address(); }

    // Into the target that is being rendered to, behind everything: where nothing is drawn yet.
    // Nothing where there is no environment.
    void draw(engine::Commands& commands, std::uint64_t picture) const;

private:
    engine::Buffer texels_;
    engine::Buffer parameters_;
    std::optional<engine::GraphicsPipeline> background_;
};

// Spherical harmonics of irradiance / pi under a latitude-longitude picture of light, turned by so
// many radians about +y: l = 0 to 2, m = -l to l, real and orthonormal as in Ramamoorthi and
// Hanrahan 2001, An Efficient Representation for Irradiance Environment Maps (their eq. 3).
// shaders/environment/radiance.glsl says which way the picture lies round +y.
std::array<glm::dvec3, 9> irradianceHarmonics(const engine::FloatPixels& picture, double turn);

// So many directional lights that stand for a picture of light: each in the middle of its part of
// all directions, those that are nearest to it, somewhat wider, and with all light of it. It
// is turned and scaled as the settings say. Their middles are on a Fibonacci spiral, but 12 are the
// corners of an icosahedron: means of harmonics up to l = 5 are exact there.
std::vector<LightSettings> environmentLights(
    const engine::FloatPixels& picture, const RenderSettings& render, std::uint32_t count);

}  // namespace hair::rendering
