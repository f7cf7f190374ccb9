#include "hair/rendering/renderer.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <iterator>
#include <limits>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "engine/commands.h"
#include "engine/error.h"
#include "engine/transfer.h"
#include "hair/rendering/software_backend.h"
#include "hair/rendering/strand_backend.h"
#include "hair/shader_codes.h"

namespace hair::rendering {

// ---- The picture from its samples ---------------------------------------------------------------

namespace {

engine::ComputeDescription
pipelineFor(const RenderSettings& render, const engine::TargetDescription& target) {
    const std::string variant = target.msaa > 1 ? "+multisample" : "";
    engine::Constants constants{
        {gpu::kResolveSamplesConstant, target.msaa}, {gpu::kResolveFactorConstant, target.ssaa}};
    if (!hasLinearLight(render)) {
        return {
            .shader = "post/resolve.comp" + variant,
            .constants = constants,
            .sampled_images = 1,
            .storage_images = 1};
    }
    constants.emplace_back(gpu::kResolveToneMapConstant, shaderCode(render.tone_map));
    constants.emplace_back(gpu::kResolveExposureConstant, std::exp2(render.exposure));
    return {
        .shader = "post/develop.comp" + variant,
        .constants = constants,
        .sampled_images = 1,
        .storage_images = 2};
}

}  // namespace

ResolvePass::ResolvePass(
    const engine::Device& device, const RenderSettings& render,
    const engine::TargetDescription& target) {
    if (engine::resolveOf(target) != engine::Resolve::compute) return;
    pipeline_.emplace(device, pipelineFor(render, target));
}

void ResolvePass::record(engine::Commands& commands, const engine::Target& target) const {
    if (!pipeline_) {
        target.beginRendering(commands, engine::Load::keep, {}, engine::Target::Last::yes);
        target.endRendering(commands, engine::Target::Last::yes);
        return;
    }
    target.beginResolve(commands);
    const engine::Image* const sampled = &target.color();
    commands.bind(*pipeline_);
    if (target.hasRadiance())
        commands.images(
            *pipeline_, std::span(&sampled, 1), std::array{&target.radiance(), &target.output()});
    else
        commands.images(*pipeline_, std::span(&sampled, 1), std::array{&target.output()});
    const auto [width, height] = target.output().extent();
    commands.dispatch(
        (width + gpu::kResolveGroupSide - 1) / gpu::kResolveGroupSide,
        (height + gpu::kResolveGroupSide - 1) / gpu::kResolveGroupSide);
    target.endResolve(commands);
}

// ---- Overlays -----------------------------------------------------------------------------------

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
            engine::makeBuffer(device, wires, "body lines", "meshes"),
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

// ---- The renderer -------------------------------------------------------------------------------

namespace {

using Last = engine::Target::Last;

engine::MemoryRows pictureRows(std::size_t heads) {
    return {
        "shading",
        {{"picture parameters", heads * kPictureStride, engine::FrameLoop::kMaxSlots,
          engine::Usage::upload}}};
}

engine::Buffer parameterBuffer(const engine::Device& device, std::size_t heads = 1) {
    return {device, pictureRows(heads)["picture parameters"]};
}

// The lights in the frame of each head: [head][light].
std::vector<gpu::Light> lightsOfHeads(const Settings& settings) {
    std::vector<gpu::Light> lights;
    for (const glm::vec3& offset : copyOffsets(settings.copies)) {
        Settings seen = settings;
        for (LightSettings& light : seen.shading.lights) light.position -= offset;
        std::ranges::copy(makeLights(seen), std::back_inserter(lights));
    }
    return lights;
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

// A light may see what the camera doesn't. An acceleration structure that is only fitted to strands
// keeps all of them.
bool cullsPoints(const Settings& settings) {
    const StrandSettings& strands = settings.strands;
    const bool refits =
        strands.backend == Backend::rays && strands.rays.update == RaysUpdate::refit;
    return !hasHairMaps(settings) && !tracesShadows(settings) && !refits;
}

std::optional<PointsPass>
makePoints(const engine::Device& device, const Settings& settings, const StrandPlan& plan) {
    if (!readsPoints(settings)) return std::nullopt;
    return std::optional<PointsPass>(std::in_place, device, settings, plan, cullsPoints(settings));
}

template <class Part>
const Part* pointerTo(const std::optional<Part>& part) {
    return part ? &*part : nullptr;
}

std::optional<StrandStructure> makeStructure(
    const engine::Device& device, const Settings& settings, const StrandPlan& plan,
    const std::optional<PointsPass>& points) {
    if (!tracedGeometry(settings)) return std::nullopt;
    return std::optional<StrandStructure>(std::in_place, device, settings, plan, *points);
}

std::vector<engine::SampledImage>
strandImages(const StrandTexture& texture, const ShadowPass& shadows) {
    std::vector<engine::SampledImage> images{texture.image()};
    images.insert(images.end(), shadows.images().begin(), shadows.images().end());
    return images;
}

}  // namespace

engine::MemoryRows Renderer::rows(
    const engine::Device& device, const Settings& settings, const StrandPlan& plan,
    const groom::GroomSize& size) {
    Settings lit = settings;
    // The environment adds lights for hair. Each of them also has a map of the meshes.
    if (!settings.render.environment.empty())
        lit.shading.lights.resize(
            settings.shading.lights.size() + settings.shading.environment_lights,
            LightSettings{.type = LightType::directional});
    const std::size_t heads = settings.copies.count;
    engine::MemoryRows rows = pictureRows(heads);
    rows.add(
        "shading", {{"lights", engine::bytesOf<gpu::Light>(heads * lit.shading.lights.size())}});
    rows.add(targetRows(rendered(settings)));
    rows.add(HairOpticsBuffers::rows(settings.shading));
    rows.add(ShadowPass::rows(lit, plan));
    rows.add(IndirectLight::rows(lit));
    rows.add(SceneMeshes::rows(settings));
    if (!settings.render.environment.empty()) rows.add(EnvironmentPass::rows());
    if (settings.strands.texture.empty())
        rows.add("textures", {{"strand texture", sizeof(std::uint32_t)}});
    rows.add("textures", {{"no texture", sizeof(std::uint32_t)}});
    if (!settings.render.hair) return rows;
    const bool has_residuals =
        settings.strands.source == StrandSource::groom && size.bound_points > 0;
    rows.add(FramesPass::rows(size.vertices(), hasFrames(settings.strands), has_residuals));
    if (LevelsPass::isNeeded(plan)) rows.add(LevelsPass::rows(plan));
    if (readsPoints(settings)) rows.add(PointsPass::rows(settings.strands, plan));
    rows.add(transparencyRows(settings.render));
    rows.add(backendRows(device, settings, plan, QuadKind::camera));
    if (tracedGeometry(settings)) rows.add(StrandStructure::rows(device, settings, plan));
    const bool draws_maps = hasHairMaps(lit) && !drawsMapsInCompute(settings.strands.backend);
    if (draws_maps && plan.strands() > 0)
        for (int i = 0; i < 2; ++i)  // depth and opacity
            rows.add(backendRows(device, settings, plan, QuadKind::light));
    return rows;
}

Renderer::Renderer(
    const engine::Device& device, const Settings& settings, const StrandView& view,
    const RenderAssets& assets, const StrandStages& stages)
    : plan_(planStrands(view, settings, device.info().limits.maxTessellationGenerationLevel)),
      backend_(chooseBackend(device, settings, plan_, stages)),
      settings_(litByEnvironment(withBackend(wetted(settings), backend_.backend), assets)),
      target_(device, rendered(settings_)),
      lights_(engine::makeBuffer(device, lightsOfHeads(settings_), "lights", "shading")),
      optics_(device, settings_), points_(makePoints(device, settings_, plan_)),
      structure_(makeStructure(device, settings_, plan_, points_)),
      shadows_(device, settings_, plan_, assets, pointerTo(points_), pointerTo(structure_)),
      environment_(device, settings_, assets),
      meshes_(device, litByHarmonics(withBackend(settings, backend_.backend)), assets),
      texture_(device, settings_.render, assets.strand_texture),
      strand_images_(strandImages(texture_, shadows_)),
      strands_(
          device, settings_, plan_, target_, view, pointerTo(points_), pointerTo(structure_),
          stages),
      overlay_(device, settings_, assets),
      resolve_(device, settings_.render, target_.description()) {
    backend_.variant = strands_.backendVariant();
    for (const glm::vec3& offset : copyOffsets(settings_.copies)) heads_.push_back({offset});
    order_.resize(heads_.size());
    written_.resize(heads_.size() * kPictureStride);
    for (engine::Buffer& parameters : parameters_)
        parameters = parameterBuffer(device, heads_.size());
    if (settings_.render.hair && FramesPass::isNeeded(view)) frames_.emplace(device, view);
    if (settings_.render.hair && LevelsPass::isNeeded(plan_))
        levels_.emplace(device, settings_, plan_);
    if (view.deforming) skin_.emplace(device, settings_, plan_, view, pointerTo(levels_));
    if (IndirectLight::isNeeded(settings_) && !meshes_.empty())
        indirect_.emplace(device, settings_);
}

namespace {

// Which of the views shows a head.
std::uint32_t motionOf(std::uint32_t head, std::span<const StrandView> views) {
    return views.size() > 1 ? head : 0;
}

}  // namespace

std::optional<ExpectedCounts> Renderer::expected() const {
    std::optional<ExpectedCounts> counts = strands_.expected();
    if (!counts) return counts;
    counts->tessellation_control_patches *= heads();
    for (auto* count :
         {&counts->tessellation_evaluation_invocations, &counts->geometry_invocations,
          &counts->geometry_primitives})
        if (*count) **count *= heads();
    return counts;
}

void Renderer::writePictures(std::uint32_t slot, std::span<const StrandView> views) {
    const std::size_t lights_per_head = settings_.shading.lights.size();
    for (std::uint32_t i = 0; i < heads(); ++i) {
        Head& head = heads_[i];
        const std::uint32_t motion = motionOf(i, views);
        head.parameters = pictureParameters(
            settings_, plan_, views[motion],
            {.guide_normals = frames_ ? frames_->normals().address() : 0,
             .guide_turns = frames_ ? frames_->turns().address() : 0,
             .root_corrections = skin_ ? skin_->corrections().address() : 0,
             .cluster_levels = levels_ ? levels_->levels().address() : 0,
             .strand_order = levels_ ? levels_->order().address() : 0,
             .lights = lights_.address() + i * lights_per_head * sizeof(gpu::Light),
             .optics = optics_.address(),
             .shadows = shadows_.address(slot, motion),
             .environment = environment_.address(),
             .fragments = strands_.fragments()},
            head.offset);
        if (plan_.lod_mode == LodMode::distance)
            head.parameters.forced_density =
                mostStrands(plan_, settings_.lod, views[motion], head.parameters.lod_eye);
        head.address = parameters_[slot].address() + i * kPictureStride;
        std::memcpy(&written_[i * kPictureStride], &head.parameters, sizeof head.parameters);
    }
    parameters_[slot].write(std::span<const std::byte>(written_));
    const auto distance = [&](std::uint32_t i) {
        return glm::distance(heads_[i].offset, settings_.camera.position);
    };
    std::iota(order_.begin(), order_.end(), 0u);
    std::ranges::sort(order_, [&](std::uint32_t a, std::uint32_t b) {
        return std::pair(distance(a), a) < std::pair(distance(b), b);
    });
}

std::vector<gpu::ClusterLevel> Renderer::clusterLevels(const engine::Device& device) const {
    if (!levels_) return {};
    return engine::downloadAs<gpu::ClusterLevel>(device, levels_->levels());
}

void Renderer::recordLevels(engine::Passes& passes, const StrandPicture& picture) const {
    if (!levels_) return;
    passes.pass("levels", engine::PassKind::compute, [&](engine::Commands& commands) {
        levels_->record(commands, picture.address, picture.parameters, settings_.lod);
    });
}

// Records what a head's picture needs of its hair before anything is drawn.
void Renderer::recordShape(
    engine::Passes& passes, const StrandView& view, const StrandPicture& picture) {
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
            skin_->record(commands, picture.address, picture.parameters, passes.slot());
        });
    }
}

void Renderer::record(engine::Passes& passes, std::span<const StrandView> views) {
    assert(views.size() == 1 || views.size() == heads_.size());
    writePictures(passes.slot(), views);
    const bool joined = passes.joins() && strands_.joinsScene() && heads_.size() == 1;
    const bool shadows_need_points = shadows_.drawsHair();
    const bool traces = tracesShadows(settings_);
    for (const std::uint32_t i : order_) {
        const bool is_first = i == order_.front();
        const std::uint32_t motion = motionOf(i, views);
        const StrandView& view = views[motion];
        const StrandPicture picture = pictureOf(heads_[i]);
        const bool moves = is_first || views.size() > 1;
        recordLevels(passes, picture);
        if (moves) recordShape(passes, view, picture);
        const bool has_points = (moves && shadows_need_points) || traces;
        if (has_points || joined) recordPoints(passes, picture);
        if (traces) recordStructure(passes, picture);
        if (moves) shadows_.record(passes, meshes_, view, picture.parameters, motion);
        if (moves) recordIndirect(passes, picture);
        if (joined)
            recordJoined(passes, view, picture);
        else
            recordApart(
                passes, picture, has_points ? Points::recorded : Points::needed,
                {.first = is_first, .last = i == order_.back()});
    }
    if (!joined) recordOverlays(passes, views);
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

void Renderer::recordPoints(
    engine::Passes& passes, const StrandPicture& picture, Bounds bounds) const {
    if (!points_) return;
    passes.pass("points", engine::PassKind::compute, [&](engine::Commands& commands) {
        if (bounds == Bounds::old) points_->clear(commands);
        points_->record(commands, picture.address, picture.parameters);
    });
}

// Builds what rays are traced in, from the points.
void Renderer::recordStructure(engine::Passes& passes, const StrandPicture& picture) {
    if (!structure_) return;
    passes.pass("acceleration", engine::PassKind::compute, [&](engine::Commands& commands) {
        structure_->record(commands, picture);
    });
}

void Renderer::recordIndirect(engine::Passes& passes, const StrandPicture& picture) const {
    if (!indirect_) return;
    passes.pass("indirect", engine::PassKind::compute, [&](engine::Commands& commands) {
        indirect_->record(commands, meshes_, picture.address, shadows_.images());
    });
}

void Renderer::recordJoined(
    engine::Passes& passes, const StrandView& view, const StrandPicture& picture) const {
    const engine::PassKind kind = strands_.passKind();
    passes.pass(
        "strands", kind, [&](engine::Commands& commands) { strands_.prepare(commands, picture); });
    passes.pass("scene", engine::PassKind::graphics, [&](engine::Commands& commands) {
        meshes_.declareDraw(commands);
        target_.beginRendering(commands, engine::Load::clear, background(), Last::yes);
        meshes_.draw(commands, picture.address, shadows_.images());
        environment_.draw(commands, picture.address);
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
    engine::Passes& passes, const StrandPicture& picture, Points points, Turn turn) {
    const bool resolves = target_.resolve() != engine::Resolve::none;
    const bool completes = turn.last && !resolves && overlay_.empty();
    const Last after_strands = completes ? Last::yes : Last::no;
    const Last after_scene = settings_.render.hair ? Last::no : after_strands;
    // The scene and the points wait for the simulation alone: one barrier in front of the scene is
    // enough for both if the points' bounds are cleared before it. A GPU can then work on both at
    // once.
    const bool traces = tracesShadows(settings_);  // the scene's fragments need the structure, too
    const bool clears_early = points == Points::needed && points_ && passes.joins();
    if (clears_early)
        passes.pass("points", engine::PassKind::compute, [&](engine::Commands& commands) {
            points_->clear(commands);
        });
    passes.pass("scene", engine::PassKind::graphics, [&](engine::Commands& commands) {
        const engine::Load load = turn.first ? engine::Load::clear : engine::Load::keep;
        if (traces) structure_->tracesLight(commands, StrandStructure::Tracer::fragments);
        meshes_.declareDraw(commands);
        target_.beginRendering(commands, load, background(), after_scene);
        meshes_.draw(commands, picture.address, shadows_.images());
        if (turn.first) environment_.draw(commands, picture.address);
        target_.endRendering(commands, after_scene);
    });
    if (points == Points::needed)
        recordPoints(passes, picture, clears_early ? Bounds::cleared : Bounds::old);
    if (!settings_.render.hair) return;
    if (!traces) recordStructure(passes, picture);
    strands_.record(passes, target_, picture, after_strands);
}

void Renderer::recordOverlays(engine::Passes& passes, std::span<const StrandView> views) const {
    if (overlay_.empty()) return;
    const Last last = target_.resolve() != engine::Resolve::none ? Last::no : Last::yes;
    passes.pass("overlay", engine::PassKind::graphics, [&](engine::Commands& commands) {
        target_.beginRendering(commands, engine::Load::keep, {}, last);
        for (std::uint32_t i = 0; i < heads(); ++i)
            overlay_.draw(commands, heads_[i].address, views[motionOf(i, views)]);
        target_.endRendering(commands, last);
    });
}

// ---- Points of strands --------------------------------------------------------------------------

namespace {

using Record = gpu::StrandPointRecord;
static_assert(sizeof(Record) == 36 && offsetof(Record, tangent) == 16);
static_assert(offsetof(gpu::StrandPointsPush, count) == 16);

// Shaders number points in 32 bits.
std::uint32_t pointCount(const StrandPlan& plan) {
    const std::uint64_t count = plan.strands() * plan.segments * (plan.forced_tessellation + 1);
    constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
    if (count > kMost) {
        throw engine::Unsupported(
            "strand points", std::to_string(count) + " are too many: at most " +
                                 std::to_string(kMost) + " are supported");
    }
    return static_cast<std::uint32_t>(count);
}

}  // namespace

const Record& StrandPoints::at(
    std::uint32_t triangle, std::uint32_t strand, std::uint32_t segment,
    std::uint32_t point) const {
    assert(
        triangle < plan.triangles && strand < plan.forced_density && segment < plan.segments &&
        point <= plan.forced_tessellation);
    const std::size_t line = std::size_t{triangle} * plan.forced_density + strand;
    return records[(line * plan.segments + segment) * (plan.forced_tessellation + 1) + point];
}

StrandPoints evaluateStrandPoints(
    const engine::Device& device, const Settings& settings, const StrandView& view,
    std::uint32_t most_at_once) {
    assert(most_at_once > 0);
    StrandPoints result{
        .plan = planStrands(view, settings, device.info().limits.maxTessellationGenerationLevel)};
    const std::uint32_t count = pointCount(result.plan);
    if (count == 0) return result;

    const engine::ComputePipeline pipeline(
        device, {.shader = "strands/evaluate.comp",
                 .constants = strandConstants(settings.strands, result.plan),
                 .extensions = strandExtensions(settings.strands),
                 .push_size = sizeof(gpu::StrandPointsPush)});
    const engine::Buffer parameters = parameterBuffer(device);
    const std::uint32_t size = std::min(count, most_at_once);
    const engine::Buffer records(
        device, {.size = size * sizeof(Record), .name = "strand points", .purpose = "measuring"});
    std::optional<FramesPass> frames;
    if (FramesPass::isNeeded(view)) frames.emplace(device, view);
    std::optional<LevelsPass> levels;
    if (LevelsPass::isNeeded(result.plan)) levels.emplace(device, settings, result.plan);
    std::optional<SkinnedHead> skin;
    if (view.deforming) skin.emplace(device, settings, result.plan, view, pointerTo(levels));
    const gpu::PictureParameters picture = pictureParameters(
        settings, result.plan, view,
        {.guide_normals = frames ? frames->normals().address() : 0,
         .guide_turns = frames ? frames->turns().address() : 0,
         .root_corrections = skin ? skin->corrections().address() : 0,
         .cluster_levels = levels ? levels->levels().address() : 0,
         .strand_order = levels ? levels->order().address() : 0});
    parameters.write(picture);
    result.records.reserve(count);
    for (std::uint32_t first = 0; first < count; first += std::min(size, count - first)) {
        const std::uint32_t part = std::min(size, count - first);
        runOnce(device, [&](engine::Commands& commands) {
            if (frames && first == 0) {
                frames->record(commands, view);
            }
            if (levels && first == 0)
                levels->record(commands, parameters.address(), picture, settings.lod);
            if (skin && first == 0) {
                skin->record(commands, parameters.address(), picture, 0);
            }
            declareStrands(commands, picture, engine::Access::compute_read);
            commands.bind(
                pipeline, gpu::StrandPointsPush{
                              .picture = parameters.address(),
                              .records = commands.writes(records),
                              .count = part,
                              .first = first});
            commands.dispatchInvocations(part, gpu::kStrandPointsGroupSize);
        });
        const std::vector<Record> evaluated = engine::downloadAs<Record>(device, records);
        result.records.insert(result.records.end(), evaluated.begin(), evaluated.begin() + part);
    }
    return result;
}

}  // namespace hair::rendering
