#include "hair/rendering/shadow_pass.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <string>

#include <glm/common.hpp>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>

#include "engine/error.h"
#include "engine/pipeline.h"
#include "engine/target.h"
#include "engine/transfer.h"
#include "hair/rendering/environment.h"
#include "hair/rendering/fiber.h"
#include "hair/rendering/strand_structure.h"

namespace hair::rendering {
namespace {

Sphere boundsOf(std::span<const glm::vec3> points) {
    if (points.empty()) return {};
    glm::vec3 least = points.front();
    glm::vec3 most = points.front();
    for (const glm::vec3& point : points) {
        least = glm::min(least, point);
        most = glm::max(most, point);
    }
    Sphere sphere{.centre = 0.5f * (least + most)};
    for (const glm::vec3& point : points)
        sphere.radius = std::max(sphere.radius, glm::distance(point, sphere.centre));
    return sphere;
}

// The bounds of a mesh under any rotation about its origin.
Sphere boundsOf(const groom::Mesh& mesh, const MeshSettings& placed) {
    const Sphere sphere = boundsOf(mesh.positions);
    return {
        .centre = placed.translation,
        .radius = placed.scale * (glm::length(sphere.centre) + sphere.radius)};
}

Sphere moved(const glm::mat4& rigid, const Sphere& sphere) {
    return {glm::vec3(rigid * glm::vec4(sphere.centre, 1.0f)), sphere.radius};
}

// ---- Views of lights ----------------------------------------------------------------------------

// The view of a light: orthographic for a directional light, perspective otherwise.
struct LightView {
    glm::mat4 view_projection;  // world -> clip; reversed depth as in viewProjection()
    glm::vec3 eye;  // m; far away for a directional light
    glm::vec4 depth_terms;  // as in gpu::ShadowMap
    float texel_near;  // m, as in gpu::ShadowMap
    float texel_slope;
};

constexpr float kMostHalfAngle = 75.0f;  // degrees
constexpr float kNearest = 0.01f;  // as a fraction of the far end's distance
constexpr float kLeastRadius = 0.001f;  // m: gives a view even if there is nothing to see
// Strands face a directional light as if it were a point this many radii of the map away: at most
// 0.001 rad off.
constexpr float kFarAway = 1000.0f;

// Returns the direction with length 1; downward if it has no length.
glm::vec3 unit(const glm::vec3& direction) {
    const float length = glm::length(direction);
    return length > 0.0f ? direction / length : glm::vec3(0.0f, -1.0f, 0.0f);
}

glm::mat4 looking(const glm::vec3& from, const glm::vec3& axis) {
    const glm::vec3 up = std::abs(axis.y) > 0.9f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    return glm::lookAtRH(from, from + axis, up);
}

LightView
parallelView(const glm::vec3& axis, const ShadowBounds& bounds, float radius, float texels) {
    const Sphere& range = bounds.range;
    const float start = glm::dot(range.centre - bounds.receivers.centre, axis) - range.radius;
    const glm::mat4 projection = glm::orthoRH_ZO(
        -radius, radius, -radius, radius, 2.0f * std::max(range.radius, kLeastRadius), 0.0f);
    return {
        .view_projection = projection * looking(bounds.receivers.centre + start * axis, axis),
        .eye = bounds.receivers.centre - kFarAway * radius * axis,
        .depth_terms = {-projection[2][2], projection[3][2], 0.0f, 1.0f},
        .texel_near = 2.0f * radius / texels,
        .texel_slope = 0.0f};
}

LightView perspectiveView(
    const glm::vec3& eye, const glm::vec3& axis, const Sphere& range, float slope, float texels) {
    const float middle = glm::dot(range.centre - eye, axis);
    const float far = std::max(middle + range.radius, kLeastRadius);
    const float near = std::max(middle - range.radius, kNearest * far);
    const float side = slope * far;
    const glm::mat4 projection = glm::frustumRH_ZO(-side, side, -side, side, far, near);
    return {
        .view_projection = projection * looking(eye, axis),
        .eye = eye,
        .depth_terms = {-projection[2][2], projection[3][2], 1.0f, 0.0f},
        .texel_near = 0.0f,
        .texel_slope = 2.0f * slope / texels};
}

// A map of side x side texels shows bounds.receivers and `margin` texels round it. If the light
// is inside bounds.receivers, or sees it at an angle of more than 150 degrees, the map shows 150
// degrees round its centre, and nothing beyond casts a shadow. Nor does anything nearer to a point
// light than a hundredth of the far end of bounds.range, because depth would be too coarse.
LightView lightView(
    const LightSettings& light, const ShadowBounds& bounds, std::uint32_t side, float margin) {
    const auto texels = static_cast<float>(side);
    const float widened = texels / (texels - 2.0f * margin);
    const float radius = std::max(bounds.receivers.radius, kLeastRadius);
    if (light.type == LightType::directional)
        return parallelView(unit(light.direction), bounds, widened * radius, texels);
    const glm::vec3 to_centre = bounds.receivers.centre - light.position;
    const float most = std::sin(glm::radians(kMostHalfAngle));
    const float sine = std::min(radius / std::max(glm::length(to_centre), radius), most);
    const float slope = sine / std::sqrt(1.0f - sine * sine);
    return perspectiveView(light.position, unit(to_centre), bounds.range, widened * slope, texels);
}

// Returns a point of an even distribution over the disc of radius 1 (Vogel 1979, A better way to
// construct the sunflower head).
glm::vec2 onDisc(std::uint32_t index, std::uint32_t count) {
    const float radius = std::sqrt((static_cast<float>(index) + 0.5f) / static_cast<float>(count));
    const float angle = 2.39996323f * static_cast<float>(index);
    return radius * glm::vec2(std::cos(angle), std::sin(angle));
}

// Returns a point of an even distribution over the square from -1 to 1: x in equal steps, y by the
// golden section.
glm::vec2 onSquare(std::uint32_t index, std::uint32_t count) {
    const float place = static_cast<float>(index) + 0.5f;
    return 2.0f * glm::vec2(place / static_cast<float>(count), glm::fract(place * 0.618033989f)) -
           1.0f;
}

// The mean base colour of the head's triangles by area, as working colour and without textures.
// Black without a head.
glm::vec3 meanColor(const Settings& settings, const RenderAssets& assets) {
    if (!assets.head || !settings.render.head) return glm::vec3(0.0f);
    const groom::Mesh& mesh = *assets.head;
    glm::vec3 sum(0.0f);
    float areas = 0.0f;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto [a, b, c] = mesh.triangles[i];
        const float area = glm::length(glm::cross(
            mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]));
        sum += area *
               workingColor(settings.render, mesh.materials[mesh.triangle_materials[i]].base_color);
        areas += area;
    }
    return areas > 0.0f ? sum / areas : glm::vec3(0.0f);
}

// ---- Images and buffers -------------------------------------------------------------------------

static_assert(offsetof(gpu::ShadowMap, corner) == 80 && sizeof(gpu::ShadowMap) == 116);
static_assert(offsetof(gpu::ShadowParameters, softness) == 192 * 116 + 4);

constexpr VkImageLayout kRead = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;

// The maps of a light are consecutive.
std::vector<MapOfLight> mapsOfLights(const Settings& settings) {
    const ShadingSettings& shading = settings.shading;
    std::vector<MapOfLight> maps;
    if (!shading.shadows.meshes && shading.shadows.hair == HairShadows::none) return maps;
    for (std::uint32_t i = 0; i < shading.lights.size(); ++i) {
        if (!shading.lights[i].shadows) continue;
        for (std::uint32_t k = 0; k < shadowMaps(shading.lights[i]); ++k) maps.push_back({i, k});
    }
    return maps;
}

ShadowAtlas
checkedAtlas(const engine::Device& device, std::uint32_t parts, std::uint32_t resolution) {
    const ShadowAtlas atlas{parts, resolution};
    checkAtlas(device, atlas);
    return atlas;
}

engine::ImageDescription atlasImage(
    const ShadowAtlas* atlas, VkFormat format, VkImageUsageFlags usage, const std::string& name) {
    const VkExtent2D extent = atlas ? atlas->extent() : VkExtent2D{1, 1};
    return {
        .format = format,
        .width = extent.width,
        .height = extent.height,
        .usage = usage | VK_IMAGE_USAGE_SAMPLED_BIT,
        .name = name,
        .purpose = "shadows"};
}

// `atlas` is null if there are no such maps.
engine::ImageDescription depthOfMeshes(const ShadowAtlas* atlas) {
    return atlasImage(
        atlas, engine::Target::kDepthFormat, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
        "depth of meshes");
}
engine::ImageDescription depthOfHair(const Settings& settings, const ShadowAtlas* atlas) {
    if (drawsMapsInCompute(settings.strands.backend))
        return atlasImage(
            atlas, MapRasterizer::kDepthFormat, VK_IMAGE_USAGE_STORAGE_BIT, "depth of hair");
    return atlasImage(
        atlas, engine::Target::kDepthFormat, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
        "depth of hair");
}
engine::ImageDescription opacityOfHair(const Settings& settings, const ShadowAtlas* atlas) {
    const bool computes = drawsMapsInCompute(settings.strands.backend);
    return atlasImage(
        atlas, MapRasterizer::kLayerFormat,
        computes ? VK_IMAGE_USAGE_STORAGE_BIT : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,
        "opacity of hair");
}

void toRead(engine::Commands& commands, const engine::Image& image, VkImageLayout from) {
    commands.transition(image, from, kRead);
}

// Prepares the image for the next draws, after the last frame's pictures have read it.
void toDraw(engine::Commands& commands, const engine::Image& image, VkImageLayout to) {
    commands.transition(image, VK_IMAGE_LAYOUT_UNDEFINED, to);
}

}  // namespace

// ---- Bounds of shadow maps ---------------------------------------------------------------------

Sphere strandBounds(const groom::Groom& groom, const StrandSettings& settings) {
    if (groom.strand_count == 0) return {};
    glm::vec3 least(std::numeric_limits<float>::max());
    glm::vec3 most(std::numeric_limits<float>::lowest());
    for (std::uint32_t i = 0; i < groom.strand_count; ++i) {
        least = glm::min(least, groom.strand(i)[0]);
        most = glm::max(most, groom.strand(i)[0]);
    }
    Sphere bounds{.centre = 0.5f * (least + most)};
    for (std::uint32_t i = 0; i < groom.strand_count; ++i) {
        const auto strand = groom.strand(i);
        float reach = glm::distance(bounds.centre, strand[0]);
        for (std::size_t k = 1; k < strand.size(); ++k)
            reach += glm::distance(strand[k - 1], strand[k]);
        bounds.radius = std::max(bounds.radius, reach);
    }
    float beside = settings.curl.radius + settings.variation.amplitude;
    for (const groom::StrandBinding& binding : groom.bindings)
        if (!binding.followsHead()) beside = std::max(beside, glm::length(binding.offset));
    bounds.radius += beside;
    for (std::size_t i = 0; i < groom.bound_ends.size(); ++i) {
        if (!groom.bindings[i].followsHead()) continue;
        for (const glm::vec3& point : groom.boundStrand(i))
            bounds.radius = std::max(bounds.radius, glm::distance(bounds.centre, point));
    }
    return bounds;
}

LightSettings
lightSample(const LightSettings& light, const glm::vec3& receiver, std::uint32_t index) {
    const std::uint32_t count = shadowMaps(light);
    LightSettings sample = light;
    if (count == 1) return sample;
    // A sphere is sampled on the disc bounded by its outline as seen from `receiver`. A disc at
    // infinity is sampled on its projection, where equal parts give equal light to a surface that
    // faces its middle.
    const bool directional = light.type == LightType::directional;
    const glm::vec3 axis = unit(directional ? light.direction : receiver - light.position);
    const glm::mat4 view = looking(glm::vec3(0.0f), axis);
    const glm::vec3 right(view[0][0], view[1][0], view[2][0]);
    const glm::vec3 up(view[0][1], view[1][1], view[2][1]);
    const float apart = glm::distance(receiver, light.position);
    const float ratio = std::min(light.radius / std::max(apart, kLeastRadius), 0.95f);
    const float radius = light.radius / std::sqrt(1.0f - ratio * ratio);
    const float sine = std::sin(glm::radians(light.angular_radius));
    const glm::vec2 disc = onDisc(index, count);
    const glm::vec3 offset = disc.x * right + disc.y * up;
    if (light.type == LightType::rectangle) {
        const RectangleFace face = rectangleFace(light);
        const glm::vec2 place = onSquare(index, count);
        sample.position += place.x * face.half_width + place.y * face.half_height;
    } else if (directional) {
        const float cosine = std::sqrt(1.0f - sine * sine * glm::dot(disc, disc));
        sample.direction = cosine * axis + sine * offset;
    } else {
        sample.position += radius * offset;
    }
    return sample;
}

Sphere enclosing(const Sphere& a, const Sphere& b) {
    const float apart = glm::distance(a.centre, b.centre);
    if (b.radius == 0.0f || apart + b.radius <= a.radius) return a;
    if (a.radius == 0.0f || apart + a.radius <= b.radius) return b;
    const float radius = 0.5f * (apart + a.radius + b.radius);
    return {a.centre + (radius - a.radius) / apart * (b.centre - a.centre), radius};
}

ShadowScene::ShadowScene(const Settings& settings, const RenderAssets& assets) {
    if (assets.head && settings.render.head) head_ = boundsOf(assets.head->positions);
    for (std::size_t i = 0; i < assets.meshes.size(); ++i)
        others_ = enclosing(others_, boundsOf(assets.meshes[i], settings.render.meshes[i]));
}

ShadowBounds ShadowScene::bounds(const StrandView& view) const {
    const Sphere hair{view.centre, view.radius};
    ShadowBounds bounds{.receivers = moved(view.head, enclosing(hair, head_))};
    if (bounds.receivers.radius == 0.0f) bounds.receivers = others_;
    bounds.range = enclosing(bounds.receivers, others_);
    return bounds;
}

// ---- The atlas ----------------------------------------------------------------------------------

std::uint32_t ShadowAtlas::columns() const {
    std::uint32_t columns = 1;
    while (columns * columns < parts) ++columns;
    return columns;
}

VkExtent2D ShadowAtlas::extent() const {
    const std::uint32_t rows = (parts + columns() - 1) / columns();
    return {side * columns(), side * rows};
}

VkRect2D ShadowAtlas::part(std::uint32_t index) const {
    return {
        {static_cast<std::int32_t>(side * (index % columns())),
         static_cast<std::int32_t>(side * (index / columns()))},
        {side, side}};
}

bool hasHairMaps(const Settings& settings) {
    return hair::hasHairMaps(settings.shading.shadows) && settings.render.hair &&
           !mapsOfLights(settings).empty();
}

void checkAtlas(const engine::Device& device, const ShadowAtlas& atlas) {
    const VkPhysicalDeviceLimits& limits = device.info().limits;
    const std::uint32_t most = std::min(
        {limits.maxImageDimension2D, limits.maxFramebufferWidth, limits.maxFramebufferHeight});
    const std::uint32_t width = atlas.extent().width;
    if (width > most) {
        throw engine::Unsupported(
            "/shading/shadows/resolution",
            std::to_string(atlas.parts) + " lights' maps of " + std::to_string(atlas.side) +
                " px need an image of " + std::to_string(width) +
                " px; the device supports at most " + std::to_string(most));
    }
}

// ---- The pass -----------------------------------------------------------------------------------

engine::MemoryRows ShadowPass::rows(const Settings& settings, const StrandPlan& plan) {
    const std::uint32_t slots = engine::FrameLoop::kMaxSlots * motions(settings.copies);
    constexpr engine::Usage kUpload = engine::Usage::upload;
    const std::size_t maps = mapsOfLights(settings).size();
    const ShadowAtlas atlas{static_cast<std::uint32_t>(maps), settings.shading.shadows.resolution};
    const bool has_meshes = settings.shading.shadows.meshes && maps > 0;
    const bool has_hair = hasHairMaps(settings) && plan.strands() > 0;
    engine::MemoryRows rows(
        "shadows",
        {{"shadow parameters", sizeof(gpu::ShadowParameters), slots, kUpload},
         {"lights' pictures", std::max<std::size_t>(maps, 1) * kPictureStride, slots, kUpload}});
    rows.add(depthOfMeshes(has_meshes ? &atlas : nullptr));
    rows.add(depthOfHair(settings, has_hair ? &atlas : nullptr));
    rows.add(opacityOfHair(settings, has_hair ? &atlas : nullptr));
    if (has_hair && drawsMapsInCompute(settings.strands.backend))
        rows.add(MapRasterizer::rows(atlas.side));
    return rows;
}

ShadowPass::ShadowPass(
    const engine::Device& device, const Settings& settings, const StrandPlan& plan,
    const RenderAssets& assets, const PointsPass* points, const StrandStructure* structure)
    : settings_(settings), scene_(settings, assets), maps_(mapsOfLights(settings)),
      mesh_maps_(settings.shading.shadows.meshes && !maps_.empty()),
      hair_maps_(hasHairMaps(settings) && plan.strands() > 0),
      structure_(tracesShadows(settings) ? structure : nullptr),
      atlas_(checkedAtlas(
          device, static_cast<std::uint32_t>(maps_.size()), settings.shading.shadows.resolution)),
      mesh_depths_(device, depthOfMeshes(mesh_maps_ ? &atlas_ : nullptr)),
      hair_depths_(device, depthOfHair(settings, hair_maps_ ? &atlas_ : nullptr)),
      hair_layers_(device, opacityOfHair(settings, hair_maps_ ? &atlas_ : nullptr)),
      sampler_(device, {.filter = VK_FILTER_NEAREST}),
      images_{{&mesh_depths_, &sampler_}, {&hair_depths_, &sampler_}, {&hair_layers_, &sampler_}},
      mesh_color_(meanColor(settings, assets)),
      transmittance_(surfaceTransmittance(settings.shading)),
      written_(maps_.size() * kPictureStride) {
    const engine::MemoryRows rows = ShadowPass::rows(settings, plan);
    light_pictures_.reserve(maps_.size());
    const std::size_t places = place(0, motions(settings.copies));
    for (std::size_t i = 0; i < places; ++i) {
        parameters_.emplace_back(device, rows["shadow parameters"]);
        parameters_.back().write(gpu::ShadowParameters{});
        pictures_.emplace_back(device, rows["lights' pictures"]);
    }
    runOnce(device, [&](engine::Commands& commands) {
        for (const engine::SampledImage& sampled : images_)
            toRead(commands, *sampled.image, VK_IMAGE_LAYOUT_UNDEFINED);
    });
    if (!hair_maps_) return;
    const BackendContext context{
        .device = device, .plan = plan, .strands = settings.strands, .points = points};
    if (drawsMapsInCompute(settings.strands.backend)) {
        rasterizer_.emplace(context, atlas_.side);
        return;
    }
    device.require(engine::Feature::float_blend, "/shading/shadows/hair");
    const auto backend = [&](const StrandOutput& output) {
        BackendContext with_output = context;
        with_output.output = output;
        return makeBackend(settings.strands.backend, with_output);
    };
    depth_ = backend({.quads = QuadKind::light, .fragment = "shadows/depth.frag"});
    opacity_ = backend(
        {.quads = QuadKind::light,
         .fragment = "shadows/opacity.frag",
         .colors = {{MapRasterizer::kLayerFormat, engine::Blend::add}},
         .depth_format = VK_FORMAT_UNDEFINED,
         .sampled_images = 2});
}

void ShadowPass::writeParameters(
    std::size_t place, const StrandView& view, const gpu::PictureParameters& of) {
    const ShadowSettings& shadows = settings_.shading.shadows;
    gpu::ShadowParameters parameters{};
    parameters.side = static_cast<float>(atlas_.side);
    parameters.softness = shadows.softness;
    parameters.transmittance = transmittance_;
    parameters.mesh_color = mesh_color_;
    // The map has room for samples round a point: those of the filter, and strands a texel wide.
    const float margin = std::max(shadows.softness, 0.5f) + 1.0f;
    const ShadowBounds bounds = scene_.bounds(view);
    parameters.reach = 2.0f * bounds.range.radius;
    if (structure_) structure_->describe(parameters);
    light_pictures_.clear();
    std::uint32_t further = gpu::kMostLights;
    for (std::uint32_t i = 0; i < maps_.size(); ++i) {
        const auto [light, sample] = maps_[i];
        const LightSettings& whole = settings_.shading.lights[light];
        const LightSettings point = lightSample(whole, bounds.receivers.centre, sample);
        const LightView light_view = lightView(point, bounds, atlas_.side, margin);
        const VkOffset2D corner = atlas_.part(i).offset;
        const std::uint32_t map = sample == 0 ? light : further++;
        parameters.maps[map] = {
            .view_projection = light_view.view_projection,
            .depth_terms = light_view.depth_terms,
            .corner = {corner.x, corner.y},
            .texel_near = light_view.texel_near,
            .texel_slope = light_view.texel_slope,
            .layer_depth = shadows.layer_depth,
            .ends_at_meshes = mesh_maps_ && shadows.hair == HairShadows::deep_shadow ? 1u : 0u,
            .casters = (mesh_maps_ ? gpu::kMeshesCast : 0u) |
                       (hair_maps_ || structure_ ? gpu::kHairCasts : 0u),
            .further = further,
            .further_count = shadowMaps(whole) - 1u};
        parameters.sources[map] = point.type == LightType::directional
                                      ? glm::vec4(-unit(point.direction), 0.0f)
                                      : glm::vec4(point.position, 1.0f);
        gpu::PictureParameters picture = of;
        picture.view_projection = light_view.view_projection;
        picture.eye = light_view.eye;
        // Deep shadow maps trace rays through texels, so strands keep their width.
        const bool widens = shadows.hair != HairShadows::deep_shadow;
        picture.pixel_near = widens ? light_view.texel_near : 0.0f;
        picture.pixel_slope = widens ? light_view.texel_slope : 0.0f;
        if (settings_.render.transparency == Transparency::none) picture.opacity = 1.0f;
        picture.shadows = parameters_[place].address() + offsetof(gpu::ShadowParameters, maps) +
                          map * sizeof(gpu::ShadowMap);
        const std::size_t offset = i * kPictureStride;
        std::memcpy(&written_[offset], &picture, sizeof picture);
        light_pictures_.push_back({pictures_[place].address() + offset, picture});
    }
    parameters_[place].write(parameters);
    pictures_[place].write(std::span<const std::byte>(written_));
}

void ShadowPass::drawMeshes(engine::Commands& commands, const SceneMeshes& meshes) const {
    toDraw(commands, mesh_depths_, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL);
    engine::beginRendering(
        commands, {}, engine::Attachment{&mesh_depths_, engine::Load::clear, {engine::kFarDepth}});
    for (std::uint32_t i = 0; i < light_pictures_.size(); ++i) {
        engine::setArea(commands, atlas_.part(i));
        meshes.drawDepth(commands, light_pictures_[i].address);
    }
    engine::endRendering(commands);
    toRead(commands, mesh_depths_, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL);
}

void ShadowPass::drawHair(engine::Commands& commands) const {
    const auto drawn = [&](const LightPicture& picture, std::size_t images) {
        return StrandPicture{
            .address = picture.address,
            .parameters = picture.parameters,
            .images = std::span(images_).first(images)};
    };
    for (const LightPicture& picture : light_pictures_) {
        depth_->prepare(commands, drawn(picture, 0));
        opacity_->prepare(commands, drawn(picture, 2));
    }
    toDraw(commands, hair_depths_, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL);
    engine::beginRendering(
        commands, {}, engine::Attachment{&hair_depths_, engine::Load::clear, {engine::kFarDepth}});
    for (std::uint32_t i = 0; i < light_pictures_.size(); ++i) {
        engine::setArea(commands, atlas_.part(i));
        depth_->draw(commands, drawn(light_pictures_[i], 0));
    }
    engine::endRendering(commands);
    toRead(commands, hair_depths_, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL);

    toDraw(commands, hair_layers_, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
    const engine::Attachment layers{&hair_layers_, engine::Load::clear, {}};
    engine::beginRendering(commands, std::span(&layers, 1), std::nullopt);
    for (std::uint32_t i = 0; i < light_pictures_.size(); ++i) {
        engine::setArea(commands, atlas_.part(i));
        opacity_->draw(commands, drawn(light_pictures_[i], 2));
    }
    engine::endRendering(commands);
    toRead(commands, hair_layers_, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
}

void ShadowPass::rasterizeHair(engine::Commands& commands) const {
    toDraw(commands, hair_depths_, VK_IMAGE_LAYOUT_GENERAL);
    toDraw(commands, hair_layers_, VK_IMAGE_LAYOUT_GENERAL);
    for (const LightPicture& picture : light_pictures_)
        rasterizer_->record(
            commands,
            {.address = picture.address,
             .parameters = picture.parameters,
             .images = std::span(images_).first(1)},
            hair_depths_, hair_layers_);
    toRead(commands, hair_depths_, VK_IMAGE_LAYOUT_GENERAL);
    toRead(commands, hair_layers_, VK_IMAGE_LAYOUT_GENERAL);
}

void ShadowPass::record(
    engine::Passes& passes, const SceneMeshes& meshes, const StrandView& view,
    const gpu::PictureParameters& picture, std::uint32_t motion) {
    if (maps_.empty()) return;
    writeParameters(place(passes.slot(), motion), view, picture);
    if (mesh_maps_) {
        passes.pass("mesh_shadow", engine::PassKind::graphics, [&](engine::Commands& commands) {
            drawMeshes(commands, meshes);
        });
    }
    if (!hair_maps_) return;
    const engine::PassKind kind = rasterizer_ ? engine::PassKind::compute : depth_->passKind();
    passes.pass("hair_shadow", kind, [&](engine::Commands& commands) {
        if (rasterizer_)
            rasterizeHair(commands);
        else
            drawHair(commands);
    });
}

}  // namespace hair::rendering
