#include "hair/rendering/renderer.h"

#include <cstddef>

#include "hair/gpu_structs.h"
#include "hair/rendering/camera.h"

namespace hair {

namespace {

// Scalar layout aligns 64-bit members to 8, as C++ does.
static_assert(offsetof(gpu::PictureParameters, guides) == 152);
static_assert(sizeof(gpu::PictureParameters) == 200);

engine::TargetDescription targetDescription(const RenderSettings& render) {
    return {.width = render.width, .height = render.height, .msaa = render.msaa, .ssaa = render.ssaa};
}

engine::Buffer parameterBuffer(const engine::Device& device) {
    return {device, {.size = sizeof(gpu::PictureParameters),
                     .usage = engine::Usage::upload,
                     .name = "picture parameters"}};
}

gpu::PictureParameters pictureParameters(const Settings& settings, const StrandPlan& plan,
                                         const StrandView& view) {
    const RenderSettings& render = settings.render;
    const ShadingSettings& shading = settings.shading;
    const float aspect = static_cast<float>(render.width) / static_cast<float>(render.height);
    return {.view_projection = viewProjection(settings.camera, aspect),
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
            .guides = view.guides,
            .root_triangles = view.root_triangles,
            .vertices_per_guide = view.vertices_per_guide,
            .density = plan.density,
            .tessellation = plan.tessellation,
            .patches_per_triangle = plan.patches_per_triangle,
            .strands_per_patch = plan.strands_per_patch,
            .forced_density = plan.forced_density,
            .forced_tessellation = plan.forced_tessellation,
            .seed = settings.seed};
}

}  // namespace

Renderer::Renderer(const engine::Device& device, const Settings& settings, const StrandView& view,
                   const Mesh* mesh)
    : settings_(settings),
      plan_(planStrands(view.triangle_count, view.vertices_per_guide - 1, settings.strands,
                        settings.lod, device.info().limits.maxTessellationGenerationLevel)),
      target_(device, targetDescription(settings.render)),
      parameters_{parameterBuffer(device), parameterBuffer(device)},
      backend_(makeBackend(settings.strands.backend,
                           {device, plan_, settings_.strands, settings_.render.msaa})),
      overlay_(device, settings.render.overlays, settings.render.msaa),
      resolve_(device, target_.description()) {
    if (mesh && settings.render.head) mesh_.emplace(device, *mesh, settings.render.msaa);
}

void Renderer::record(engine::Passes& passes, const StrandView& view) {
    const engine::Buffer& parameters = parameters_[passes.slot()];
    parameters.write(pictureParameters(settings_, plan_, view));
    const std::uint64_t picture = parameters.address();
    const glm::vec3 background = settings_.render.background;

    const auto render = [&](const char* name, engine::Load load, const auto& draw) {
        passes.pass(name, engine::PassKind::graphics, [&](engine::Commands& commands) {
            target_.beginRendering(commands, load, {background.r, background.g, background.b});
            draw(commands);
            target_.endRendering(commands);
        });
    };
    render("scene", engine::Load::clear, [&](engine::Commands& commands) {
        if (mesh_) mesh_->draw(commands, picture);
    });
    render("strands", engine::Load::keep,
           [&](engine::Commands& commands) { backend_->draw(commands, picture); });
    if (!overlay_.empty()) {
        render("overlay", engine::Load::keep,
               [&](engine::Commands& commands) { overlay_.draw(commands, picture, view); });
    }
    passes.pass("resolve", engine::PassKind::compute,
                [&](engine::Commands& commands) { resolve_.record(commands, target_); });
}

}  // namespace hair
