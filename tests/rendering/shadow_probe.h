#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec4.hpp>

#include "engine/buffer_image.h"
#include "engine/frame_loop.h"
#include "engine/target.h"
#include "engine/transfer.h"
#include "hair/rendering/points_pass.h"
#include "hair/rendering/renderer.h"
#include "hair/rendering/scene_meshes.h"
#include "hair/rendering/shadow_pass.h"
#include "hair/rendering/strand_pass.h"
#include "hair/rendering/strand_structure.h"
#include "tests/probe_shaders.h"
#include "tests/rendering/device_hair.h"

namespace hair::rendering {

// The obstacles between a light and a point, as the shading functions find them.
struct FoundPath {
    float meshes;
    float strands;
    float visibility;
    float direct;
    float met;
    float ended;  // green
    float returned;  // green
    float kept;
};

// Draws the lights' maps, or builds what rays are traced in, in three frames, two of them in
// flight, and evaluates the probes in each.
inline std::vector<FoundPath> findPaths(
    const engine::Device& device, const Settings& settings, const StrandView& view,
    const RenderAssets& assets, std::span<const gpu::ShadowProbe> probes) {
    static_assert(sizeof(gpu::ShadowProbe) == 44 && sizeof(gpu::ShadowProbePush) == 20);
    constexpr VkFormat kFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
    probe_shaders::addTo(device);
    const engine::GraphicsPipeline pipeline(
        device, {.shaders =
                     {"composite/screen.vert",
                      tracesShadows(settings) ? "probe_shadows.frag+rays" : "probe_shadows.frag"},
                 .constants = shadingConstants(settings),
                 .push_size = sizeof(gpu::ShadowProbePush),
                 .colors = {{kFormat}, {kFormat}},
                 .sampled_images = 3});
    const auto makeImage = [&] {
        return engine::Image(
            device, {.format = kFormat,
                     .width = static_cast<std::uint32_t>(probes.size()),
                     .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                     .name = "light paths",
                     .purpose = "tests"});
    };
    const std::array found{makeImage(), makeImage()};
    const engine::Buffer probe_buffer =
        engine::makeBuffer(device, probes, "shadow probes", "tests");
    const auto makeRead = [&] {
        return engine::Buffer(
            device, {.size = probes.size() * sizeof(FoundPath) / 2,
                     .usage = engine::Usage::readback,
                     .name = "light paths",
                     .purpose = "tests"});
    };
    const std::array read{makeRead(), makeRead()};
    std::array<engine::Buffer, engine::FrameLoop::kMaxSlots> pictures;
    for (engine::Buffer& picture : pictures)
        picture = {
            device,
            {.size = sizeof(gpu::PictureParameters),
             .usage = engine::Usage::upload,
             .name = "picture",
             .purpose = "tests"}};
    const StrandPlan plan =
        planStrands(view, settings, device.info().limits.maxTessellationGenerationLevel);
    const SceneMeshes meshes(device, settings, assets);
    std::optional<PointsPass> points;
    std::optional<StrandStructure> structure;
    if (readsPoints(settings) || tracesShadows(settings))
        points.emplace(device, settings, plan, false);
    if (tracesShadows(settings)) structure.emplace(device, settings, plan, *points);
    ShadowPass shadows(
        device, settings, plan, assets, points ? &*points : nullptr,
        structure ? &*structure : nullptr);

    engine::FrameLoop loop(device, engine::Timing::overlapped);
    for (int frame = 0; frame < 3; ++frame) {
        loop.frame([&](engine::Passes& passes) {
            const gpu::PictureParameters picture = pictureParameters(
                settings, plan, view, {.shadows = shadows.address(passes.slot())});
            pictures[passes.slot()].write(picture);
            if (points)
                passes.pass("points", engine::PassKind::compute, [&](auto& commands) {
                    const std::uint64_t address = pictures[passes.slot()].address();
                    points->clear(commands);
                    points->record(commands, address, picture);
                    if (structure)
                        structure->record(commands, {.address = address, .parameters = picture});
                });
            shadows.record(passes, meshes, view, picture);
            passes.pass("probe", engine::PassKind::graphics, [&](engine::Commands& commands) {
                for (const engine::Image& image : found)
                    commands.transition(
                        image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
                const std::array colors{
                    engine::Attachment{&found[0], engine::Load::clear, {}},
                    engine::Attachment{&found[1], engine::Load::clear, {}}};
                if (structure) structure->tracesLight(commands, StrandStructure::Tracer::fragments);
                engine::beginRendering(commands, colors, std::nullopt);
                commands.bind(
                    pipeline, gpu::ShadowProbePush{
                                  .picture = pictures[passes.slot()].address(),
                                  .probes = probe_buffer.address(),
                                  .count = static_cast<std::uint32_t>(probes.size())});
                commands.images(pipeline, shadows.images());
                commands.draw({.vertices = 3});
                engine::endRendering(commands);
                for (const engine::Image& image : found)
                    commands.transition(
                        image, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                        VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
                for (std::size_t i = 0; i < found.size(); ++i) commands.copy(found[i], read[i]);
            });
        });
    }
    loop.finish();
    std::vector<FoundPath> paths(probes.size());
    for (std::size_t part = 0; part < read.size(); ++part) {
        const std::size_t bytes = sizeof(FoundPath) / read.size();
        for (std::size_t i = 0; i < paths.size(); ++i)
            std::memcpy(
                reinterpret_cast<std::byte*>(&paths[i]) + part * bytes,
                read[part].mapped().data() + i * bytes, bytes);
    }
    return paths;
}

// The paths of points on strands of the least width, so that no ray meets them.
inline std::vector<FoundPath> findPaths(
    const engine::Device& device, const Settings& settings, const StrandView& view,
    const RenderAssets& assets, std::span<const glm::vec3> points, std::uint32_t light = 0) {
    std::vector<gpu::ShadowProbe> probes;
    for (const glm::vec3& point : points)
        probes.push_back(
            {.position = point,
             .light = light,
             .normal = glm::vec3(0.0f),
             .tangent = glm::vec3(0.0f, 1.0f, 0.0f),
             .width = 0.0f});
    return findPaths(device, settings, view, assets, probes);
}

inline double meanStrands(std::span<const FoundPath> paths) {
    double sum = 0.0;
    for (const FoundPath& path : paths) sum += path.strands;
    return sum / static_cast<double>(paths.size());
}

}  // namespace hair::rendering
