#include "hair/groom/mesh/gltf_materials.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "engine/error.h"
#include "hair/groom/mesh/gltf_accessors.h"
#include "hair/groom/mesh/gltf_images.h"

namespace hair {
namespace {

constexpr std::size_t kMostPixels = std::size_t{1} << 27;

// glTF's factors are linear, ours are display RGB; IEC 61966-2-1.
float encodeSrgb(double linear) {
    return static_cast<float>(
        linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055);
}

float share(double value, const char* name) {
    if (value >= 0.0 && value <= 1.0) return static_cast<float>(value);
    throw engine::Error(name, "is outside [0, 1]");
}

Wrap toWrap(int mode) {
    switch (mode) {
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
        return Wrap::clamp;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
        return Wrap::mirror;
    default:
        return Wrap::repeat;
    }
}

class MaterialReader {
public:
    MaterialReader(
        const tinygltf::Model& model, Textures textures, const std::filesystem::path& folder)
        : model_(model), textures_(textures), folder_(folder) {}

    Material read(const tinygltf::Material& source) {
        const tinygltf::PbrMetallicRoughness& surface = source.pbrMetallicRoughness;
        Material material{
            .name = source.name,
            .metallic = share(surface.metallicFactor, "metallicFactor"),
            .roughness = share(surface.roughnessFactor, "roughnessFactor"),
            .normal_scale = static_cast<float>(source.normalTexture.scale),
            .cutoff = {},
            .double_sided = source.doubleSided,
            .base_color_texture = texture(surface.baseColorTexture, "baseColorTexture"),
            .metallic_roughness_texture =
                texture(surface.metallicRoughnessTexture, "metallicRoughnessTexture"),
            .normal_texture = texture(source.normalTexture, "normalTexture")};
        const std::vector<double>& color = surface.baseColorFactor;
        if (color.size() >= 3)
            material.base_color = {
                encodeSrgb(color[0]), encodeSrgb(color[1]), encodeSrgb(color[2])};
        if (color.size() >= 4) material.opacity = share(color[3], "baseColorFactor");
        if (source.alphaMode == "MASK") material.cutoff = static_cast<float>(source.alphaCutoff);
        if (source.alphaMode == "BLEND") material.cutoff = 0.5f;
        return material;
    }

    std::vector<engine::Pixels> takePictures() { return std::move(pictures_); }

private:
    template <class Info>
    std::optional<MaterialTexture> texture(const Info& info, const char* name) {
        if (info.index < 0 || textures_ == Textures::skipped) return {};
        try {
            return textureOf(info);
        } catch (const engine::Error& error) {
            throw engine::Error(name, error.what());
        }
    }

    template <class Info>
    MaterialTexture textureOf(const Info& info) {
        if (info.texCoord != 0) {
            throw engine::Error(
                "TEXCOORD_" + std::to_string(info.texCoord) + " is not supported, TEXCOORD_0 is");
        }
        if (info.extensions.contains("KHR_texture_transform"))
            throw engine::Error("KHR_texture_transform is not supported");
        const tinygltf::Texture& source = at(model_.textures, info.index, "texture");
        MaterialTexture texture{.picture = picture(source.source)};
        if (source.sampler >= 0) {
            const tinygltf::Sampler& sampler = at(model_.samplers, source.sampler, "sampler");
            texture.horizontal = toWrap(sampler.wrapS);
            texture.vertical = toWrap(sampler.wrapT);
            texture.is_smooth = sampler.magFilter != TINYGLTF_TEXTURE_FILTER_NEAREST;
        }
        return texture;
    }

    // Each image once.
    std::uint32_t picture(int image) {
        const auto [known, is_new] =
            numbers_.try_emplace(image, static_cast<std::uint32_t>(pictures_.size()));
        if (!is_new) return known->second;
        const engine::Pixels& added =
            pictures_.emplace_back(decodeGltfImage(model_, image, folder_));
        pixels_ += added.rgba.size() / 4;
        if (pixels_ > kMostPixels)
            throw engine::Error("the images have more than 2^27 pixels in all");
        return known->second;
    }

    const tinygltf::Model& model_;
    Textures textures_;
    const std::filesystem::path& folder_;
    std::map<int, std::uint32_t> numbers_;  // of images among the pictures
    std::vector<engine::Pixels> pictures_;
    std::size_t pixels_ = 0;
};

}  // namespace

GltfMaterials readMaterials(
    const tinygltf::Model& model, Textures textures, const std::filesystem::path& folder) {
    MaterialReader reader(model, textures, folder);
    std::vector<Material> materials{{.name = "default"}};
    for (std::size_t i = 0; i < model.materials.size(); ++i) {
        try {
            materials.push_back(reader.read(model.materials[i]));
        } catch (const engine::Error& error) {
            throw engine::Error("material " + std::to_string(i), error.what());
        }
    }
    return {std::move(materials), reader.takePictures()};
}

}  // namespace hair
