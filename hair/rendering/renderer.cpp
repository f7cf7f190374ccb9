#include "hair/rendering/renderer.h"

#include <cmath>
#include <cstddef>
#include <span>

#include <glm/trigonometric.hpp>

#include "engine/buffer_image.h"
#include "engine/transfer.h"
#include "hair/rendering/lights.h"
#include "hair/rendering/software_backend.h"

namespace hair::rendering {
namespace {

using Last = engine::Target::Last;

engine::Buffer parameterBuffer(const engine::Device& device) {
    return {
        device,
        {.size = sizeof(gpu::PictureParameters),
         .usage = engine::Usage::upload,
         .name = "picture parameters"}};
}

Settings withBackend(Settings settings, Backend backend) {
    settings.strands.backend = backend;
    return settings;
}

// Hair is lit by the environment as additional lights, if there are any.
Settings litByEnvironment(Settings settings, const RenderAssets& assets) {
    const std::uint32_t count = settings.shading.environment_lights;
    if (!assets.environment || count == 0) return settings;
    const std::vector<LightSettings> lights =
        environmentLights(*assets.environment, settings.render, count);
    settings.shading.lights.insert(settings.shading.lights.end(), lights.begin(), lights.end());
    return settings;
}

// Meshes are lit by the environment's harmonics, not by its lights.
Settings litByHarmonics(Settings settings) {
    settings.shading.environment_lights = 0;
    return settings;
}

engine::TargetDescription rendered(const Settings& settings) {
    engine::TargetDescription description = targetDescription(settings.render);
    description.sampled_depth = readsSceneDepth(settings);
    return description;
}

std::optional<PointsPass>
makePoints(const engine::Device& device, const Settings& settings, const StrandPlan& plan) {
    if (!readsPoints(settings)) return std::nullopt;
    return std::optional<PointsPass>(std::in_place, device, settings, plan, !hasHairMaps(settings));
}

const PointsPass* pointerTo(const std::optional<PointsPass>& points) {
    return points ? &*points : nullptr;
}

std::vector<engine::SampledImage>
strandImages(const StrandTexture& texture, const ShadowPass& shadows) {
    std::vector<engine::SampledImage> images{texture.image()};
    images.insert(images.end(), shadows.images().begin(), shadows.images().end());
    return images;
}

}  // namespace

std::uint64_t rendererBytes(const Settings& settings, const StrandPlan& plan) {
    constexpr std::uint64_t kWholeBlock = 8;  // most strands per invocation
    std::uint64_t bytes = targetBytes(rendered(settings)) + shadowMapBytes(settings);
    if (!settings.render.hair) return bytes;
    bytes += transparencyBytes(settings.render);
    const std::uint64_t strands = plan.strands();
    const Backend backend = settings.strands.backend;
    if (readsPoints(settings))
        bytes += pointsBytes(settings.strands, plan) + sizeof(std::uint32_t) * strands;
    if (backend == Backend::software)
        bytes += softwareSizes(
                     rendered(settings), (strands + kWholeBlock) * plan.segments *
                                             std::uint64_t{plan.forced_tessellation})
                     .sum();
    // Lists of strands: one for the camera's picture, and two for depth and opacity in shadow maps.
    const std::uint64_t lists = (backend == Backend::expanded ? 1 : 0) +
                                (hasHairMaps(settings) && readsPoints(settings) ? 2 : 0);
    bytes += lists * sizeof(std::uint32_t) * strands;
    if (!settings.simulation.animation.clip.empty())
        bytes += strands * (sizeof(glm::vec4) + sizeof(gpu::CarriedRoot));
    return bytes;
}

Renderer::Renderer(
    const engine::Device& device, const Settings& settings, const StrandView& view,
    const RenderAssets& assets, const StrandStages& stages)
    : plan_(planStrands(view, settings, device.info().limits.maxTessellationGenerationLevel)),
      backend_(chooseBackend(device, settings, plan_, stages)),
      settings_(litByEnvironment(withBackend(settings, backend_.backend), assets)),
      target_(device, rendered(settings_)),
      lights_(
          engine::makeBuffer(device, std::span<const gpu::Light>(makeLights(settings_)), "lights")),
      optics_(device, settings_), points_(makePoints(device, settings_, plan_)),
      shadows_(device, settings_, plan_, assets, pointerTo(points_)),
      environment_(device, settings_, assets),
      meshes_(device, litByHarmonics(withBackend(settings, backend_.backend)), assets),
      texture_(device, settings_.render, assets.strand_texture),
      strand_images_(strandImages(texture_, shadows_)),
      strands_(device, settings_, plan_, target_, view, pointerTo(points_), stages),
      overlay_(device, settings_, assets),
      resolve_(device, settings_.render, target_.description()) {
    backend_.variant = strands_.backendVariant();
    for (engine::Buffer& parameters : parameters_) parameters = parameterBuffer(device);
    if (settings_.render.hair && FramesPass::isNeeded(view)) frames_.emplace(device, view);
    if (view.deforming) skin_.emplace(device, settings_, plan_, view);
}

void Renderer::record(engine::Passes& passes, const StrandView& view) {
    const gpu::PictureParameters picture_parameters = pictureParameters(
        settings_, plan_, view,
        {.guide_normals = frames_ ? frames_->normals().address() : 0,
         .guide_turns = frames_ ? frames_->turns().address() : 0,
         .root_corrections = skin_ ? skin_->corrections().address() : 0,
         .lights = lights_.address(),
         .optics = optics_.address(),
         .shadows = shadows_.address(passes.slot()),
         .environment = environment_.address(),
         .fragments = strands_.fragments()});
    const engine::Buffer& parameters = parameters_[passes.slot()];
    parameters.write(picture_parameters);
    const std::uint64_t picture = parameters.address();

    if (frames_) {
        passes.pass("frames", engine::PassKind::compute, [&](engine::Commands& commands) {
            frames_->record(commands, view);
        });
    }
    if (skin_) {
        skin_->write(passes.slot(), view);
        meshes_.deform(skin_->positions(passes.slot()), skin_->normals(passes.slot()));
    }
    if (skin_ && settings_.render.hair) {
        passes.pass("skin", engine::PassKind::compute, [&](engine::Commands& commands) {
            skin_->record(commands, picture, picture_parameters, passes.slot());
        });
    }
    if (points_) {
        passes.pass("points", engine::PassKind::compute, [&](engine::Commands& commands) {
            points_->record(commands, picture, picture_parameters);
        });
    }
    shadows_.record(passes, meshes_, view, picture_parameters);
    const StrandPicture drawn{
        .address = picture, .parameters = picture_parameters, .images = strand_images_};
    const bool joined = passes.joins() && strands_.joinsScene();
    if (joined)
        recordJoined(passes, view, drawn);
    else
        recordApart(passes, view, drawn);
    const engine::Resolve resolve = target_.resolve();
    if (resolve == engine::Resolve::compute || (resolve == engine::Resolve::attachment && !joined))
        passes.pass("resolve", resolve_.kind(), [&](engine::Commands& commands) {
            resolve_.record(commands, target_);
        });
}

std::array<float, 3> Renderer::background() const {
    const glm::vec3 color = workingColor(settings_.render, settings_.render.background);
    return {color.r, color.g, color.b};
}

void Renderer::drawScene(engine::Commands& commands, const StrandPicture& picture) const {
    meshes_.draw(commands, picture.address, shadows_.images());
    environment_.draw(commands, picture.address);
}

void Renderer::recordJoined(
    engine::Passes& passes, const StrandView& view, const StrandPicture& picture) const {
    const engine::PassKind kind = strands_.passKind();
    passes.pass(
        "strands", kind, [&](engine::Commands& commands) { strands_.prepare(commands, picture); });
    passes.pass("scene", engine::PassKind::graphics, [&](engine::Commands& commands) {
        target_.beginRendering(commands, engine::Load::clear, background(), Last::yes);
        drawScene(commands, picture);
    });
    passes.pass("strands", kind, [&](engine::Commands& commands) {
        strands_.draw(commands, picture);
        if (overlay_.empty()) target_.endRendering(commands, Last::yes);
    });
    if (overlay_.empty()) return;
    passes.pass("overlay", engine::PassKind::graphics, [&](engine::Commands& commands) {
        overlay_.draw(commands, picture.address, view);
        target_.endRendering(commands, Last::yes);
    });
}

void Renderer::recordApart(
    engine::Passes& passes, const StrandView& view, const StrandPicture& picture) const {
    const bool resolves = target_.resolve() != engine::Resolve::none;
    const Last after_strands = resolves || !overlay_.empty() ? Last::no : Last::yes;
    const Last after_scene = settings_.render.hair ? Last::no : after_strands;
    passes.pass("scene", engine::PassKind::graphics, [&](engine::Commands& commands) {
        target_.beginRendering(commands, engine::Load::clear, background(), after_scene);
        drawScene(commands, picture);
        target_.endRendering(commands, after_scene);
    });
    if (settings_.render.hair) strands_.record(passes, target_, picture, after_strands);
    if (!overlay_.empty()) {
        const Last last = resolves ? Last::no : Last::yes;
        passes.pass("overlay", engine::PassKind::graphics, [&](engine::Commands& commands) {
            target_.beginRendering(commands, engine::Load::keep, {}, last);
            overlay_.draw(commands, picture.address, view);
            target_.endRendering(commands, last);
        });
    }
}

}  // namespace hair::rendering
