#pragma once

#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/float_pictures.h"
#include "engine/pictures.h"
#include "engine/target.h"
#include "hair/groom/mesh/mesh.h"
#include "hair/settings.h"
#include "hair/shading_settings.h"

// The contents of a picture beside the hair, and its working colours.
namespace hair::rendering {

// The contents of a picture beside the hair, as read from files.
struct RenderAssets {
    const groom::Mesh* head = nullptr;  // the mesh that the hair grows on; null: none
    std::vector<groom::Mesh> meshes;  // of /render/meshes, in their order
    // The meshes of /simulation/distance_fields, if bodies are drawn.
    std::vector<groom::Mesh> field_meshes;
    std::optional<engine::Pixels> strand_texture;  // of /strands/texture
    std::optional<engine::FloatPixels> environment;  // of /render/environment
};

// Whether a picture is computed in linear RGB with sRGB's primaries. Otherwise it is computed in
// display RGB, as in the thesis.
inline bool hasLinearLight(const RenderSettings& render) {
    return render.tone_map != ToneMap::none;
}

// The transfer curve of sRGB (IEC 61966-2-1), channel by channel.
glm::dvec3 toLinear(const glm::dvec3& display);
glm::dvec3 toDisplay(const glm::dvec3& linear);

// Converts a setting's display RGB to the picture's working colour.
glm::vec3 workingColor(const RenderSettings& render, const glm::vec3& display);

// Format of the colours that a picture is rendered to.
inline VkFormat colorFormat(const RenderSettings& render) {
    return hasLinearLight(render) ? VK_FORMAT_R16G16B16A16_SFLOAT : VK_FORMAT_R8G8B8A8_UNORM;
}

inline engine::TargetDescription targetDescription(const RenderSettings& render) {
    return {
        .width = render.width,
        .height = render.height,
        .msaa = render.msaa,
        .ssaa = render.ssaa,
        .color_format = colorFormat(render)};
}

// The colour of a mass of hair and the absorption in a fibre determine each other: Chiang et al.
// 2016, A practical and controllable hair and fur model for production path tracing, equation (9).

// Returns sigma_a per radius of a fibre, for red, green and blue: from the pigments, or from the
// colour /shading/color that a mass of hair has. Linear colours below 1e-4 count as 1e-4.
glm::dvec3 absorption(const ShadingSettings& shading);

// Returns the linear RGB of a mass of hair.
glm::dvec3 linearColor(const ShadingSettings& shading);

}  // namespace hair::rendering
