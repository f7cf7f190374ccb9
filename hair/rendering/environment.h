#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "engine/float_pictures.h"
#include "engine/pipeline.h"
#include "hair/gpu_structs.h"
#include "hair/rendering/render_assets.h"
#include "hair/settings.h"
#include "hair/shading_settings.h"

// The camera and the lights of a picture as shaders read them.

namespace hair::rendering {

// World -> Vulkan clip space: y down, depth from engine::kNearDepth to engine::kFarDepth.
glm::mat4 viewProjection(const CameraSettings& camera, float aspect);

// The lights as shaders read them, in the settings' order.
std::vector<gpu::Light> makeLights(const Settings& settings);

// The face of a rectangle light.
struct RectangleFace {
    glm::vec3 normal;  // unit length; the direction of its light
    glm::vec3 half_width;  // m, from the middle of the face to the middle of a side
    glm::vec3 half_height;  // m
};

RectangleFace rectangleFace(const LightSettings& light);

// Returns irradiance / pi, for a radiance of 1, on a surface that faces a rectangle's middle at its
// reference_distance. It is the form factor of a rectangle and a parallel element on its axis: four
// times that of an element in front of a corner (Howell, Menguec, Daun and Siegel, Thermal
// Radiation Heat Transfer).
double rectangleFormFactor(const LightSettings& light);

// Number of shadow maps of each kind that a light has, if there are shadows. 1 without a size.
std::uint32_t shadowMaps(const LightSettings& light);

// The value of kLightKinds in shading/options.glsl.
std::uint32_t lightKinds(const Settings& settings);

// Light from all around: the background, and the irradiance of matt surfaces.
// shaders/environment/radiance.glsl defines how its picture lies; /render/environment_turn turns it
// about +y, by the right-hand rule. Without a tone map, the background and the light are converted
// to display colours and clipped.
class EnvironmentPass {
public:
    EnvironmentPass(
        const engine::Device& device, const Settings& settings, const RenderAssets& assets);

    // An environment also has texels, as many as its picture.
    static engine::MemoryRows rows() {
        return {"shading", {{"environment parameters", sizeof(gpu::EnvironmentParameters)}}};
    }

    // Address of gpu::EnvironmentParameters; 0 if there is no environment.
    std::uint64_t address() const { return parameters_.address(); }

    // Draws the background into the target that is being rendered to, where nothing is drawn yet.
    // Does nothing without an environment.
    void draw(engine::Commands& commands, std::uint64_t picture) const;

private:
    engine::Buffer texels_;
    engine::Buffer parameters_;
    std::optional<engine::GraphicsPipeline> background_;
};

// Returns the spherical harmonics of irradiance / pi under a latitude-longitude picture of light,
// turned by `turn` radians about +y: l = 0 to 2, m = -l to l, real and orthonormal as in
// Ramamoorthi and Hanrahan 2001, An Efficient Representation for Irradiance Environment Maps (their
// eq. 3). shaders/environment/radiance.glsl defines how the picture lies round +y.
std::array<glm::dvec3, 9> irradianceHarmonics(const engine::FloatPixels& picture, double turn);

// Returns at most `count` directional lights that stand for a picture of light, turned and scaled
// as the settings say, the strongest first. Each is a disc with all light of some directions: in
// the direction that their irradiance comes from, and just wide enough to give the same irradiance.
// The parts are chosen so that light is as near as possible to the middle of its part. If all of it
// is near enough, fewer lights are returned. A black picture has none.
std::vector<LightSettings> environmentLights(
    const engine::FloatPixels& picture, const RenderSettings& render, std::uint32_t count);

}  // namespace hair::rendering
