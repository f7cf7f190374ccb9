#include "hair/rendering/mesh_materials.h"

#include "hair/gpu_structs.h"
#include "hair/rendering/shading_constants.h"
#include "hair/rendering/working_color.h"

namespace hair {

namespace {

VkSamplerAddressMode addressMode(Wrap wrap) {
    switch (wrap) {
    case Wrap::repeat:
        return VK_SAMPLER_ADDRESS_MODE_REPEAT;
    case Wrap::mirror:
        return VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT;
    case Wrap::clamp:
        break;
    }
    return VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
}

MeshLook lookOf(const Mesh& mesh, const Material& material) {
    const bool is_mapped = !mesh.texture_coordinates.empty();
    return {
        .base_color_texture = is_mapped && material.base_color_texture,
        .metallic_roughness_texture = is_mapped && material.metallic_roughness_texture,
        .normal_texture = is_mapped && material.normal_texture,
        .mask = material.cutoff.has_value(),
        .double_sided = material.double_sided};
}

}  // namespace

engine::Constants meshConstants(const MeshLook& look, const Settings& settings) {
    engine::Constants constants{
        {gpu::kBaseColorTextureConstant, look.base_color_texture},
        {gpu::kMetallicRoughnessTextureConstant, look.metallic_roughness_texture},
        {gpu::kNormalTextureConstant, look.normal_texture},
        {gpu::kMaskConstant, look.mask},
        {gpu::kDoubleSidedConstant, look.double_sided}};
    const engine::Constants shading = shadingConstants(settings);
    constants.insert(constants.end(), shading.begin(), shading.end());
    return constants;
}

MeshMaterials::MeshMaterials(
    const engine::Device& device, const RenderSettings& settings, const Mesh& mesh,
    const engine::SampledImage& blank) {
    const engine::Decoding decoding =
        hasLinearLight(settings) ? engine::Decoding::linear : engine::Decoding::none;
    const auto sampled = [&](const MaterialTexture& use, engine::Texels texels) {
        const auto texture = textures_.try_emplace(
            {use.picture, texels}, device, mesh.pictures[use.picture], texels, decoding,
            "mesh texture");
        const auto sampler = samplers_.try_emplace(
            {use.horizontal, use.vertical, use.is_smooth}, device,
            engine::SamplerDescription{
                .filter = use.is_smooth ? VK_FILTER_LINEAR : VK_FILTER_NEAREST,
                .horizontal = addressMode(use.horizontal),
                .vertical = addressMode(use.vertical)});
        return engine::SampledImage{&texture.first->second.image(), &sampler.first->second};
    };
    for (const Material& source : mesh.materials) {
        MeshMaterial& material = materials_.emplace_back(MeshMaterial{
            .look = lookOf(mesh, source),
            .base_color = workingColor(settings, source.base_color),
            .opacity = source.opacity,
            .metallic = source.metallic,
            .roughness = source.roughness,
            .normal_scale = source.normal_scale,
            .cutoff = source.cutoff.value_or(0.0f),
            .images = {blank, blank, blank}});
        if (material.look.base_color_texture)
            material.images[0] = sampled(*source.base_color_texture, engine::Texels::display_color);
        if (material.look.metallic_roughness_texture)
            material.images[1] = sampled(*source.metallic_roughness_texture, engine::Texels::data);
        if (material.look.normal_texture)
            material.images[2] = sampled(*source.normal_texture, engine::Texels::data);
    }
}

}  // namespace hair
