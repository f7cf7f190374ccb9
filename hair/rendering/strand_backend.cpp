#include "hair/rendering/strand_backend.h"

#include <array>
#include <cmath>
#include <cstddef>

#include <glm/trigonometric.hpp>

#include "engine/error.h"
#include "hair/extension.h"
#include "hair/rendering/environment.h"
#include "hair/rendering/render_assets.h"
#include "hair/rendering/strand_offsets.h"
#include "hair/shader_codes.h"

namespace hair::rendering {
namespace {

constexpr std::uint32_t pushSize(const StrandStages& stages) {
    return stages.watched ? std::uint32_t{sizeof(gpu::WatchedPush)}
                          : std::uint32_t{sizeof(gpu::StrandPush)};
}

glm::vec3 hairColor(const Settings& settings) {
    if (settings.shading.color_from == ColorSource::rgb)
        return workingColor(settings.render, settings.shading.color);
    return workingColor(settings.render, toDisplay(linearColor(settings.shading)));
}

}  // namespace

// ---- Parameters of a picture --------------------------------------------------------------------

static_assert(offsetof(gpu::PictureParameters, lights) == 228);
static_assert(sizeof(gpu::PictureParameters) == 452);

gpu::PictureParameters pictureParameters(
    const Settings& settings, const StrandPlan& plan, const StrandView& view,
    const PictureBuffers& buffers, const glm::vec3& offset) {
    CameraSettings camera = settings.camera;
    camera.position -= offset;
    camera.target -= offset;
    const RenderSettings& render = settings.render;
    const ShadingSettings& shading = settings.shading;
    const float aspect = static_cast<float>(render.width) / static_cast<float>(render.height);
    const float view_height = 2.0f * std::tan(glm::radians(camera.field_of_view) / 2.0f);
    return {
        .view_projection = viewProjection(camera, aspect),
        .head = view.head,
        .eye = camera.position,
        .lod_eye = camera.position,
        .lod_near = settings.lod.near_distance,
        .lod_far = settings.lod.far_distance,
        .lod_maximum_level = settings.lod.maximum_level,
        .pixel_near = 0.0f,
        .pixel_slope = view_height / static_cast<float>(render.height * render.ssaa),
        .hair_color = hairColor(settings),
        .strand_variation = settings.shading.strand_variation,
        .tip_lightening = settings.shading.tip_lightening,
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
        .guide_turns = buffers.guide_turns,
        .residuals = view.residuals,
        .contacts = view.contacts,
        .bodies = view.bodies,
        .root_pattern = view.root_pattern,
        .offsets = view.offsets,
        .group_shades = view.group_shades,
        .root_corrections = buffers.root_corrections,
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
        .blend = settings.strands.blend,
        .cluster_levels = buffers.cluster_levels,
        .strand_order = buffers.strand_order};
}

// ---- Pipelines of strands -----------------------------------------------------------------------

engine::GraphicsDescription strandPipeline(const BackendContext& context) {
    const StrandOutput& output = context.output;
    const StrandStages& stages = context.stages;
    std::vector<engine::ColorTarget> colors = output.colors;
    if (stages.last != StrandStage::fragment)
        for (engine::ColorTarget& color : colors) color.blend = engine::Blend::keep;
    engine::Constants constants = strandConstants(context.strands, context.plan);
    constants.emplace_back(gpu::kPixelSamplesConstant, output.samples);
    constants.insert(constants.end(), output.shading.begin(), output.shading.end());
    engine::ShaderExtensions extensions = strandExtensions(context.strands);
    extensions.insert(extensions.end(), output.extensions.begin(), output.extensions.end());
    return {
        .constants = constants,
        .extensions = extensions,
        .push_size = pushSize(stages),
        .colors = colors,
        .depth_format = output.depth_format,
        .samples = output.samples,
        .depth_write = output.depth_write,
        .discard = discards(stages),
        .sampled_images = output.sampled_images};
}

void declareStrands(
    engine::Commands& commands, const gpu::PictureParameters& picture, engine::Access access) {
    commands.uses(
        {{picture.guides, access},
         {picture.contacts, access},
         {picture.guide_normals, access},
         {picture.guide_turns, access},
         {picture.root_corrections, access},
         {picture.cluster_levels, access}});
}

namespace {

std::array<const ExtensionParameters*, 2> extensionsOf(const StrandSettings& strands) {
    return {&strands.offset_parameters, &strands.curve_parameters};
}

}  // namespace

engine::Constants strandConstants(const StrandSettings& strands, const StrandPlan& plan) {
    if (strands.curve == Curve::extension && !strands.curve_parameters.file)
        throw engine::Error("/strands/curve", "names a file that was not read");
    engine::Constants constants{
        {gpu::kCurveConstant, shaderCode(strands.curve)},
        {gpu::kTaperConstant, shaderCode(strands.taper)},
        {gpu::kLodModeConstant, shaderCode(plan.lod_mode)},
        {gpu::kSourceConstant, shaderCode(strands.source)},
        {gpu::kWidthConstant, shaderCode(strands.width)},
        {gpu::kOffsetsConstant, hasOffsets(strands)},
        {gpu::kInterpolationConstant, shaderCode(strands.interpolation)},
        {gpu::kCollisionRuleConstant, strands.collision_rule},
        {gpu::kStrandCollisionConstant, shaderCode(strands.collision)},
        {gpu::kRandomnessConstant, shaderCode(strands.randomness)},
        {gpu::kLodMorphConstant, plan.morphs},
        {gpu::kMergedHairsConstant, plan.merged_hairs},
        {gpu::kOwnColorsConstant, plan.own_colors},
        {gpu::kResidualsConstant, plan.residuals},
        {gpu::kSkinnedStrandsConstant, plan.skinned},
        {gpu::kOffsetReachConstant, functionReach(strands)}};
    for (const ExtensionParameters* of : extensionsOf(strands)) {
        const engine::Constants own = extensionConstants(*of);
        constants.insert(constants.end(), own.begin(), own.end());
    }
    return constants;
}

engine::ShaderExtensions strandExtensions(const StrandSettings& strands) {
    engine::ShaderExtensions all;
    for (const ExtensionParameters* of : extensionsOf(strands)) {
        const engine::ShaderExtensions own = shaderExtensions(*of);
        all.insert(all.end(), own.begin(), own.end());
    }
    return all;
}

}  // namespace hair::rendering
