#include "hair/rendering/overlay_pass.h"

#include "engine/commands.h"
#include "engine/target.h"
#include "engine/transfer.h"
#include "hair/gpu_structs.h"
#include "hair/rendering/body_lines.h"
#include "hair/rendering/target_description.h"

namespace hair {

namespace {

constexpr glm::vec3 kGuideColor{0.05f, 0.2f, 0.9f};
constexpr glm::vec3 kTriangleColor{0.85f, 0.1f, 0.1f};
constexpr glm::vec3 kBodyColor{0.1f, 0.75f, 0.35f};

engine::GraphicsDescription lines(const char* vertex_shader, const RenderSettings& render) {
    return {
        .shaders = {vertex_shader, "strands/strand.geom", "overlay/color.frag"},
        .push_size = sizeof(gpu::OverlayPush),
        .topology = VK_PRIMITIVE_TOPOLOGY_LINE_LIST,
        .colors = {{colorFormat(render)}},
        .depth_format = engine::Target::kDepthFormat,
        .samples = render.msaa};
}

}  // namespace

OverlayPass::OverlayPass(
    const engine::Device& device, const Settings& settings, const RenderAssets& assets) {
    const RenderSettings& render = settings.render;
    if (render.overlays.guides) guides_.emplace(device, lines("overlay/guides.vert", render));
    if (render.overlays.root_triangles)
        root_triangles_.emplace(device, lines("overlay/root_triangles.vert", render));
    if (render.overlays.bodies) {
        const std::vector<gpu::BodyLine> wires =
            bodyLines(settings.simulation, assets.field_meshes);
        engine::GraphicsDescription description = lines("overlay/bodies.vert", render);
        description.depth_compare = VK_COMPARE_OP_ALWAYS;
        description.depth_write = false;
        bodies_.emplace(
            engine::makeBuffer(device, std::span<const gpu::BodyLine>(wires), "body lines"),
            static_cast<std::uint32_t>(wires.size()),
            engine::GraphicsPipeline(device, description));
    }
}

void OverlayPass::draw(
    engine::Commands& commands, std::uint64_t picture, const StrandView& view) const {
    if (bodies_ && bodies_->line_count > 0) {
        commands.bind(
            bodies_->pipeline,
            gpu::OverlayPush{
                .picture = picture, .lines = bodies_->lines.address(), .color = kBodyColor});
        commands.draw({.vertices = 2 * bodies_->line_count});
    }
    if (root_triangles_) {
        commands.bind(
            *root_triangles_, gpu::OverlayPush{.picture = picture, .color = kTriangleColor});
        commands.draw({.vertices = 2 * 3 * view.triangle_count});
    }
    if (guides_) {
        commands.bind(*guides_, gpu::OverlayPush{.picture = picture, .color = kGuideColor});
        commands.draw({.vertices = 2 * view.guide_count * (view.vertices_per_guide - 1)});
    }
}

}  // namespace hair
