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

// Returns the settings with the look of wet hair, which holds the water of /simulation/material.
// Without water they are the same. c is the part of the hair that water covers, with the index n_w
// = 1.333: 1 if it fills the gaps of hairs that lie side by side in a square lattice, 4 / pi - 1 of
// their volume. All changes grow with c.
//
// * A mass of hair with the albedo a: water's surface throws p = 1 - 1 / n_w^2 of the light that
//   comes out of the mass back into it, so that it is (1 - p) a / (1 - p a) (Angstrom 1925, The
//   albedo of various surfaces of ground; Lekner and Dorf 1988, Why some things are darker when
//   wet). The absorption of fibres follows from this colour.
// * A fibre reflects like a film of water on hair of the index n, R_1 + (1 - R_1)^2 R_2 / (1 - R_1
//   R_2) with the normal reflectances of air on water and of water on hair: its refractive index is
//   that of such a surface.
// * The surface that scatters is that of hair in water. It deflects light by
//   s = (n - n_w) / (n - 1) of what it does in air, so that longitudinal roughness and
//   tilt of the cuticle are s times as great.
//   Models without a fibre have a highlight s times as wide, with the light of that reflectance.
Settings wetted(Settings settings);

}  // namespace hair::rendering
