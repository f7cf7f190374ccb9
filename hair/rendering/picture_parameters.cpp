#include "hair/rendering/picture_parameters.h"

#include <cmath>
#include <cstddef>

#include <glm/trigonometric.hpp>

#include "hair/rendering/camera.h"
#include "hair/rendering/hair_color.h"
#include "hair/rendering/working_color.h"

namespace hair {

// Scalar layout aligns 64-bit members to 8, as C++ does.
static_assert(offsetof(gpu::PictureParameters, lights) == 224);
static_assert(sizeof(gpu::PictureParameters) == 392);

namespace {

glm::vec3 hairColor(const Settings& settings) {
    if (settings.shading.color_from == ColorSource::rgb)
        return workingColor(settings.render, settings.shading.color);
    return workingColor(settings.render, toDisplay(linearColor(settings.shading)));
}

}  // namespace

gpu::PictureParameters pictureParameters(
    const Settings& settings, const StrandPlan& plan, const StrandView& view,
    const PictureBuffers& buffers) {
    const RenderSettings& render = settings.render;
    const ShadingSettings& shading = settings.shading;
    const float aspect = static_cast<float>(render.width) / static_cast<float>(render.height);
    const float view_height = 2.0f * std::tan(glm::radians(settings.camera.field_of_view) / 2.0f);
    return {
        .view_projection = viewProjection(settings.camera, aspect),
        .head = view.head,
        .eye = settings.camera.position,
        .lod_eye = settings.camera.position,
        .lod_near = settings.lod.near_distance,
        .lod_far = settings.lod.far_distance,
        .lod_maximum_level = settings.lod.maximum_level,
        .pixel_near = 0.0f,
        .pixel_slope = view_height / static_cast<float>(render.height * render.ssaa),
        .hair_color = hairColor(settings),
        .ambient = shading.ambient,
        .diffuse = shading.diffuse,
        .specular = shading.specular,
        .exponent = shading.exponent,
        .root_width = settings.strands.root_width,
        .tip_width = settings.strands.tip_width,
        .taper_start = settings.strands.taper_start,
        .opacity = settings.strands.opacity,
        .light_count = static_cast<std::uint32_t>(shading.lights.size()),
        .lights = buffers.lights,
        .optics = buffers.optics,
        .shadows = buffers.shadows,
        .environment = buffers.environment,
        .fragments = buffers.fragments,
        .guides = view.guides,
        .root_triangles = view.root_triangles,
        .root_normals = view.root_normals,
        .guide_widths = view.guide_widths,
        .bound_strands = view.bound_strands,
        .guide_normals = buffers.guide_normals,
        .contacts = view.contacts,
        .root_pattern = view.root_pattern,
        .offsets = view.offsets,
        .offset_profiles = view.offset_profiles,
        .offset_samples = view.offset_samples,
        .vertices_per_guide = view.vertices_per_guide,
        .density = plan.density,
        .tessellation = plan.tessellation,
        .patches_per_triangle = plan.patches_per_triangle,
        .strands_per_patch = plan.strands_per_patch,
        .forced_density = plan.forced_density,
        .forced_tessellation = plan.forced_tessellation,
        .forced_level = plan.forced_level,
        .forced_scale = plan.forced_scale,
        .least_density_scale =
            view.greatest_width_scale > 0.0f ? 1.0f / view.greatest_width_scale : 0.0f,
        .seed = settings.seed,
        .blend = settings.strands.blend};
}

}  // namespace hair
