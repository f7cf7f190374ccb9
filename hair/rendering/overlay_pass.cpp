#include "hair/rendering/overlay_pass.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>

#include "engine/commands.h"
#include "engine/target.h"
#include "engine/transfer.h"

namespace hair::rendering {
namespace {

static_assert(sizeof(gpu::BodyLine) == 28 && offsetof(gpu::BodyLine, moves) == 24);

constexpr int kRing = 32;  // lines round a circle

std::uint32_t movesWith(Follows follows) { return follows == Follows::head ? 1 : 0; }

// Lines along the arc centre + cos x + sin y, from angle 0 on.
void addArc(
    const glm::vec3& centre, const glm::vec3& x, const glm::vec3& y, int lines, std::uint32_t moves,
    std::vector<gpu::BodyLine>& out) {
    const auto point = [&](int i) {
        const float angle = 2.0f * std::numbers::pi_v<float> * static_cast<float>(i) / kRing;
        return centre + std::cos(angle) * x + std::sin(angle) * y;
    };
    for (int i = 0; i < lines; ++i) out.push_back({point(i), point(i + 1), moves});
}

constexpr glm::vec3 kGuideColor{0.05f, 0.2f, 0.9f};
constexpr glm::vec3 kTriangleColor{0.85f, 0.1f, 0.1f};
constexpr glm::vec3 kBodyColor{0.1f, 0.75f, 0.35f};

constexpr std::uint32_t kVerticesPerLine = 6;  // shaders/overlay/overlay.glsl

engine::GraphicsDescription lines(const char* vertex_shader, const RenderSettings& render) {
    return {
        .shaders = {vertex_shader, "overlay/color.frag"},
        .push_size = sizeof(gpu::OverlayPush),
        .colors = {{colorFormat(render)}},
        .depth_format = engine::Target::kDepthFormat,
        .samples = render.msaa};
}

}  // namespace

// ---- Wire frames of bodies ----------------------------------------------------------------------

std::vector<gpu::BodyLine> capsuleLines(const Collider& capsule) {
    const std::uint32_t moves = movesWith(capsule.follows);
    const bool is_sphere = capsule.a == capsule.b;
    const glm::vec3 axis =
        is_sphere ? glm::vec3(0.0f, 1.0f, 0.0f) : glm::normalize(capsule.b - capsule.a);
    const glm::vec3 beside =
        std::abs(axis.x) < 0.9f ? glm::vec3(1.0f, 0.0f, 0.0f) : glm::vec3(0.0f, 0.0f, 1.0f);
    const glm::vec3 u = capsule.radius * glm::normalize(glm::cross(axis, beside));
    const glm::vec3 v = glm::cross(axis, u);
    const glm::vec3 end = capsule.radius * axis;

    std::vector<gpu::BodyLine> lines;
    addArc(capsule.a, u, v, kRing, moves, lines);
    for (const glm::vec3& side : {u, v}) {
        addArc(capsule.a, side, -end, kRing / 2, moves, lines);
        addArc(capsule.b, side, end, kRing / 2, moves, lines);
    }
    if (is_sphere) return lines;
    addArc(capsule.b, u, v, kRing, moves, lines);
    for (const glm::vec3& side : {u, v, -u, -v})
        lines.push_back({capsule.a + side, capsule.b + side, moves});
    return lines;
}

std::vector<gpu::BodyLine> meshLines(const groom::Mesh& mesh, Follows follows) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const auto& triangle : mesh.triangles)
        for (std::size_t i = 0; i < 3; ++i)
            edges.push_back(std::minmax({triangle[i], triangle[(i + 1) % 3]}));
    std::ranges::sort(edges);
    const auto repeated = std::ranges::unique(edges);
    edges.erase(repeated.begin(), repeated.end());
    std::vector<gpu::BodyLine> lines;
    for (const auto& [from, to] : edges)
        lines.push_back({mesh.positions[from], mesh.positions[to], movesWith(follows)});
    return lines;
}

std::vector<gpu::BodyLine>
bodyLines(const SimulationSettings& settings, std::span<const groom::Mesh> meshes) {
    assert(meshes.size() == settings.distance_fields.size());
    std::vector<gpu::BodyLine> lines;
    for (const Collider& capsule : settings.colliders)
        std::ranges::copy(capsuleLines(capsule), std::back_inserter(lines));
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const Follows follows = settings.distance_fields[i].follows;
        std::ranges::copy(meshLines(meshes[i], follows), std::back_inserter(lines));
    }
    return lines;
}

// ---- The pass -----------------------------------------------------------------------------------

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
    commands.uses({{view.guides, engine::Access::vertex_read}});
    if (bodies_ && bodies_->line_count > 0) {
        commands.bind(
            bodies_->pipeline,
            gpu::OverlayPush{
                .picture = picture, .lines = bodies_->lines.address(), .color = kBodyColor});
        commands.draw({.vertices = kVerticesPerLine * bodies_->line_count});
    }
    if (root_triangles_) {
        commands.bind(
            *root_triangles_, gpu::OverlayPush{.picture = picture, .color = kTriangleColor});
        commands.draw({.vertices = kVerticesPerLine * 3 * view.triangle_count});
    }
    if (guides_) {
        commands.bind(*guides_, gpu::OverlayPush{.picture = picture, .color = kGuideColor});
        commands.draw(
            {.vertices = kVerticesPerLine * view.guide_count * (view.vertices_per_guide - 1)});
    }
}

}  // namespace hair::rendering
