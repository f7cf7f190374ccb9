#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/extension.h"

// Lighting of strands. settings.h has the other parameters and says how to add one.
namespace hair {

class Table;

enum class LightType { point, directional, sphere, rectangle };

// A light's colour is the colour of a white matt surface that faces the light at
// reference_distance, or at any distance if reference_distance is 0, as in the thesis.
struct LightSettings {
    LightType type = LightType::point;
    glm::vec3 position{5.0f, 5.0f, 5.0f};
    glm::vec3 direction{0.0f, -1.0f, 0.0f};
    glm::vec3 color{1.0f, 1.0f, 1.0f};
    float strength = 1.0f;
    float reference_distance = 0.0f;
    float radius = 0.1f;
    float angular_radius = 0.0f;
    glm::vec3 up{0.0f, 1.0f, 0.0f};
    float width = 0.5f;
    float height = 0.5f;
    bool shadows = true;
    std::uint32_t shadow_samples = 1;
};

const Table& tableOf(const LightSettings*);

enum class HairShadows { none, deep_opacity, deep_shadow, rays };

struct ShadowSettings {
    bool meshes = false;
    HairShadows hair = HairShadows::none;
    std::uint32_t resolution = 1024;
    float layer_depth = 0.01f;
    float stopped = 0.5f;
    float softness = 1.0f;
};

const Table& tableOf(const ShadowSettings*);

// Whether lights' maps have hair.
inline bool hasHairMaps(const ShadowSettings& shadows) {
    return shadows.hair == HairShadows::deep_opacity || shadows.hair == HairShadows::deep_shadow;
}

// extension: the model in model_file.
enum class ShadingModel { phong, kajiya_kay, marschner, dual_scattering, extension };
enum class ColorSource { rgb, melanin };

// Hair's colour is that of a mass of hair after all scattering.
struct ShadingSettings {
    ShadingModel model = ShadingModel::phong;
    std::string model_file;
    ExtensionParameters model_parameters;
    ColorSource color_from = ColorSource::rgb;
    glm::vec3 color{0.95f, 0.9f, 0.625f};
    float eumelanin = 1.3f;
    float pheomelanin = 0.0f;
    float strand_variation = 0.0f;
    float tip_lightening = 0.0f;
    float ambient = 0.5f;
    float diffuse = 0.5f;
    float specular = 0.5f;
    float exponent = 50.0f;
    float longitudinal_roughness = 0.3f;
    float azimuthal_roughness = 0.3f;
    float cuticle_tilt = 2.0f;
    float refractive_index = 1.55f;
    float density_factor = 0.99f;
    float orientation_spread = 0.0f;
    bool far_field = false;
    std::vector<LightSettings> lights{LightSettings{}};
    std::uint32_t environment_lights = 12;
    bool indirect = false;
    float skin_scattering = 0.0f;
    ShadowSettings shadows;
};

const Table& tableOf(const ShadingSettings*);

}  // namespace hair
