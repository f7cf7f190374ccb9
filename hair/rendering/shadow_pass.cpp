#include "hair/rendering/shadow_pass.h"

#include <algorithm>
#include <cstddef>
#include <string>

#include "engine/error.h"
#include "engine/rendering.h"
#include "hair/rendering/light_view.h"

namespace hair {

namespace {

static_assert(offsetof(gpu::ShadowMap, corner) == 80 && sizeof(gpu::ShadowMap) == 104);
static_assert(offsetof(gpu::ShadowParameters, softness) == 1672);

constexpr VkFormat kLayerFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr VkImageLayout kRead = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;

std::vector<std::uint32_t> shadowingLights(const Settings& settings) {
    const ShadingSettings& shading = settings.shading;
    std::vector<std::uint32_t> lights;
    if (!shading.shadows.meshes && shading.shadows.hair == HairShadows::none) return lights;
    for (std::uint32_t i = 0; i < shading.lights.size(); ++i)
        if (shading.lights[i].shadows) lights.push_back(i);
    return lights;
}

ShadowAtlas
checkedAtlas(const engine::Device& device, std::uint32_t parts, std::uint32_t resolution) {
    const ShadowAtlas atlas{parts, resolution};
    checkAtlas(device, atlas);
    return atlas;
}

engine::Buffer
uploadBuffer(const engine::Device& device, std::size_t size, const std::string& name) {
    return {device, {.size = size, .usage = engine::Usage::upload, .name = name}};
}

engine::Image atlasImage(
    const engine::Device& device, const ShadowAtlas* atlas, VkFormat format,
    VkImageUsageFlags usage, const std::string& name) {
    const VkExtent2D extent = atlas ? atlas->extent() : VkExtent2D{1, 1};
    return {
        device,
        {.format = format,
         .width = extent.width,
         .height = extent.height,
         .usage = usage | VK_IMAGE_USAGE_SAMPLED_BIT,
         .name = name}};
}

void toRead(engine::Commands& commands, const engine::Image& image, VkImageLayout from) {
    const bool was_drawn = from != VK_IMAGE_LAYOUT_UNDEFINED;
    commands.transition(
        image, from, kRead, was_drawn ? engine::Access::attachment : engine::Access::anything,
        engine::Access::graphics_read);
}

// After the last frame's pictures read it.
void toDraw(engine::Commands& commands, const engine::Image& image, VkImageLayout to) {
    commands.transition(
        image, VK_IMAGE_LAYOUT_UNDEFINED, to, engine::Access::graphics_read,
        engine::Access::attachment);
}

}  // namespace

ShadowPass::ShadowPass(
    const engine::Device& device, const Settings& settings, const StrandPlan& plan,
    const RenderAssets& assets)
    : settings_(settings), scene_(settings, assets), lights_(shadowingLights(settings)),
      mesh_maps_(settings.shading.shadows.meshes && !lights_.empty()),
      hair_maps_(
          settings.shading.shadows.hair != HairShadows::none && settings.render.hair &&
          plan.strands() > 0 && !lights_.empty()),
      atlas_(checkedAtlas(
          device, static_cast<std::uint32_t>(lights_.size()), settings.shading.shadows.resolution)),
      mesh_depths_(atlasImage(
          device, mesh_maps_ ? &atlas_ : nullptr, engine::Target::kDepthFormat,
          VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, "depth of meshes")),
      hair_depths_(atlasImage(
          device, hair_maps_ ? &atlas_ : nullptr, engine::Target::kDepthFormat,
          VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, "depth of hair")),
      hair_layers_(atlasImage(
          device, hair_maps_ ? &atlas_ : nullptr, kLayerFormat, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,
          "opacity of hair")),
      sampler_(device, {.filter = VK_FILTER_NEAREST}),
      images_{{&mesh_depths_, &sampler_}, {&hair_depths_, &sampler_}, {&hair_layers_, &sampler_}} {
    for (std::uint32_t slot = 0; slot < engine::FrameLoop::kMaxSlots; ++slot) {
        parameters_[slot] =
            uploadBuffer(device, sizeof(gpu::ShadowParameters), "shadow parameters");
        parameters_[slot].write(gpu::ShadowParameters{});
        pictures_[slot] = uploadBuffer(
            device, std::max<std::size_t>(lights_.size(), 1) * sizeof(gpu::PictureParameters),
            "lights' pictures");
    }
    device.runOnce([&](engine::Commands& commands) {
        for (const engine::SampledImage& sampled : images_)
            toRead(commands, *sampled.image, VK_IMAGE_LAYOUT_UNDEFINED);
    });
    if (!hair_maps_) return;
    if (!device.supportsBlending(kLayerFormat))
        throw engine::Unsupported("/shading/shadows/hair", "the device can't add 32-bit floats");
    const BackendContext context{.device = device, .plan = plan, .strands = settings.strands};
    const auto backend = [&](const StrandOutput& output) {
        BackendContext with_output = context;
        with_output.output = output;
        return makeBackend(settings.strands.backend, with_output);
    };
    depth_ = backend({.geometry = "shadows/hair.geom", .fragment = "shadows/depth.frag"});
    opacity_ = backend(
        {.geometry = "shadows/hair.geom",
         .fragment = "shadows/opacity.frag",
         .colors = {{kLayerFormat, engine::Blend::add}},
         .depth_format = VK_FORMAT_UNDEFINED,
         .sampled_images = 1});
}

std::vector<std::uint64_t> ShadowPass::writeParameters(
    std::uint32_t slot, const StrandView& view, const gpu::PictureParameters& of) {
    const ShadowSettings& shadows = settings_.shading.shadows;
    gpu::ShadowParameters parameters{};
    parameters.side = static_cast<float>(atlas_.side);
    parameters.stopped = shadows.stopped;
    parameters.softness = shadows.softness;
    // What is sampled round a point lies in the map: the filter, and strands a texel wide.
    const float margin = std::max(shadows.softness, 0.5f) + 1.0f;
    const ShadowBounds bounds = scene_.bounds(view);
    std::vector<gpu::PictureParameters> pictures;
    std::vector<std::uint64_t> addresses;
    for (std::uint32_t i = 0; i < lights_.size(); ++i) {
        const std::uint32_t light = lights_[i];
        const LightView seen =
            lightView(settings_.shading.lights[light], bounds, atlas_.side, margin);
        const VkOffset2D corner = atlas_.part(i).offset;
        parameters.maps[light] = {
            .view_projection = seen.view_projection,
            .depth_terms = seen.depth_terms,
            .corner = {corner.x, corner.y},
            .texel_near = seen.texel_near,
            .texel_slope = seen.texel_slope,
            .layer_depth = shadows.layer_depth,
            .casters = (mesh_maps_ ? gpu::kMeshesCast : 0u) | (hair_maps_ ? gpu::kHairCasts : 0u)};
        gpu::PictureParameters& picture = pictures.emplace_back(of);
        picture.view_projection = seen.view_projection;
        picture.eye = seen.eye;
        picture.pixel_near = seen.texel_near;
        picture.pixel_slope = seen.texel_slope;
        if (settings_.render.transparency == Transparency::none) picture.opacity = 1.0f;
        picture.shadows = parameters_[slot].address() + offsetof(gpu::ShadowParameters, maps) +
                          light * sizeof(gpu::ShadowMap);
        addresses.push_back(pictures_[slot].address() + i * sizeof picture);
    }
    parameters_[slot].write(parameters);
    std::ranges::copy(std::as_bytes(std::span(pictures)), pictures_[slot].mapped().begin());
    return addresses;
}

void ShadowPass::drawMeshes(
    engine::Commands& commands, const SceneMeshes& meshes,
    std::span<const std::uint64_t> pictures) const {
    toDraw(commands, mesh_depths_, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL);
    for (std::uint32_t i = 0; i < pictures.size(); ++i) {
        engine::beginRendering(
            commands, {}, engine::Attachment{&mesh_depths_, engine::Load::clear, {1.0f}},
            atlas_.part(i));
        meshes.drawDepth(commands, pictures[i]);
        engine::endRendering(commands);
    }
    toRead(commands, mesh_depths_, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL);
}

void ShadowPass::drawHair(
    engine::Commands& commands, std::span<const std::uint64_t> pictures) const {
    toDraw(commands, hair_depths_, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL);
    for (std::uint32_t i = 0; i < pictures.size(); ++i) {
        engine::beginRendering(
            commands, {}, engine::Attachment{&hair_depths_, engine::Load::clear, {1.0f}},
            atlas_.part(i));
        depth_->draw(commands, pictures[i], {});
        engine::endRendering(commands);
    }
    toRead(commands, hair_depths_, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL);

    toDraw(commands, hair_layers_, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
    const engine::Attachment layers{&hair_layers_, engine::Load::clear, {}};
    for (std::uint32_t i = 0; i < pictures.size(); ++i) {
        engine::beginRendering(commands, std::span(&layers, 1), std::nullopt, atlas_.part(i));
        opacity_->draw(commands, pictures[i], std::span(images_).subspan(1, 1));
        engine::endRendering(commands);
    }
    toRead(commands, hair_layers_, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
}

void ShadowPass::record(
    engine::Passes& passes, const SceneMeshes& meshes, const StrandView& view,
    const gpu::PictureParameters& picture) {
    if (lights_.empty()) return;
    const std::vector<std::uint64_t> pictures = writeParameters(passes.slot(), view, picture);
    if (mesh_maps_) {
        passes.pass("mesh_shadow", engine::PassKind::graphics, [&](engine::Commands& commands) {
            drawMeshes(commands, meshes, pictures);
        });
    }
    if (hair_maps_) {
        passes.pass("hair_shadow", engine::PassKind::graphics, [&](engine::Commands& commands) {
            drawHair(commands, pictures);
        });
    }
}

}  // namespace hair
