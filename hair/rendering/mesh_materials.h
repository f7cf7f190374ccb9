#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <map>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/commands.h"
#include "engine/pipeline.h"
#include "engine/sampler.h"
#include "engine/texture.h"
#include "hair/groom/mesh/mesh.h"
#include "hair/settings.h"

namespace hair {

// What mesh shaders sample, at these bindings: base colour, metallic and roughness, normals, then
// ShadowPass::images().
inline constexpr std::uint32_t kMaterialImages = 3;
inline constexpr std::uint32_t kMeshImages = kMaterialImages + 3;

// What a material needs a pipeline of its own for.
struct MeshLook {
    bool base_color_texture = false;
    bool metallic_roughness_texture = false;
    bool normal_texture = false;
    bool mask = false;
    bool double_sided = false;

    auto operator<=>(const MeshLook&) const = default;
};

// The specialization constants of shaders/scene/options.glsl and shading/options.glsl.
engine::Constants meshConstants(const MeshLook& look, const Settings& settings);

// A material as shaders read it.
struct MeshMaterial {
    MeshLook look;
    glm::vec3 base_color;  // working colours
    float opacity;
    float metallic;
    float roughness;
    float normal_scale;
    float cutoff;
    std::array<engine::SampledImage, kMaterialImages> images;
};

// A mesh's materials, with their textures on the device. Textures of a mesh without texture
// coordinates are left out.
class MeshMaterials {
public:
    // `blank` is what is bound where a material has no texture.
    MeshMaterials(
        const engine::Device& device, const RenderSettings& settings, const Mesh& mesh,
        const engine::SampledImage& blank);

    // In the mesh's order.
    std::span<const MeshMaterial> materials() const { return materials_; }

private:
    // Their elements stay where they are.
    std::map<std::pair<std::uint32_t, engine::Texels>, engine::Texture> textures_;
    std::map<std::tuple<Wrap, Wrap, bool>, engine::Sampler> samplers_;
    std::vector<MeshMaterial> materials_;
};

}  // namespace hair
