#include "hair/rendering/picture_parameters.h"

#include <cstddef>

#include "hair/rendering/camera.h"

namespace hair {

// Scalar layout aligns 64-bit members to 8, as C++ does.
static_assert(offsetof(gpu::PictureParameters, guides) == 216);
static_assert(sizeof(gpu::PictureParameters) == 336);

gpu::PictureParameters pictureParameters(
    const Settings& settings, const StrandPlan& plan, const StrandView& view,
    std::uint64_t guide_normals) {
    const RenderSettings& render = settings.render;
    const ShadingSettings& shading = settings.shading;
    const float aspect = static_cast<float>(render.width) / static_cast<float>(render.height);
    return {
        .view_projection = viewProjection(settings.camera, aspect),
        .head = view.head,
        .eye = settings.camera.position,
        .lod_near = settings.lod.near_distance,
        .light_position = shading.light.position,
        .lod_far = settings.lod.far_distance,
        .light_color = shading.light.color,
        .lod_maximum_level = settings.lod.maximum_level,
        .hair_color = shading.color,
        .ambient = shading.ambient,
        .diffuse = shading.diffuse,
        .specular = shading.specular,
        .exponent = shading.exponent,
        .root_width = settings.strands.root_width,
        .tip_width = settings.strands.tip_width,
        .taper_start = settings.strands.taper_start,
        .guides = view.guides,
        .root_triangles = view.root_triangles,
        .root_normals = view.root_normals,
        .guide_widths = view.guide_widths,
        .bound_strands = view.bound_strands,
        .guide_normals = guide_normals,
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
        .seed = settings.seed,
        .blend = settings.strands.blend};
}

}  // namespace hair
