#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/buffer_image.h"
#include "engine/device.h"
#include "engine/frame_loop.h"
#include "engine/pipeline.h"
#include "engine/target.h"
#include "hair/gpu_structs.h"
#include "hair/groom/groom_size.h"
#include "hair/groom/mesh/mesh.h"
#include "hair/rendering/backends.h"
#include "hair/rendering/environment.h"
#include "hair/rendering/fiber.h"
#include "hair/rendering/points_pass.h"
#include "hair/rendering/render_assets.h"
#include "hair/rendering/scene_meshes.h"
#include "hair/rendering/shadow_pass.h"
#include "hair/rendering/strand_offsets.h"
#include "hair/rendering/strand_pass.h"
#include "hair/rendering/strand_plan.h"
#include "hair/rendering/strand_structure.h"
#include "hair/rendering/strand_view.h"
#include "hair/settings.h"

namespace hair::rendering {

// Resolves the rendered samples to the picture where they differ (engine::Resolve): the mean over
// MSAA samples and SSAA pixels (thesis 2.3.7). In linear light, the target's radiance() keeps the
// mean, and the tone map makes the picture from it. If an attachment resolves at the end of
// rendering, this pass is an empty rendering, so its time is that of the resolve.
class ResolvePass {
public:
    ResolvePass(
        const engine::Device& device, const RenderSettings& render,
        const engine::TargetDescription& target);

    engine::PassKind kind() const {
        return pipeline_ ? engine::PassKind::compute : engine::PassKind::graphics;
    }

    void record(engine::Commands& commands, const engine::Target& target) const;

private:
    std::optional<engine::ComputePipeline> pipeline_;  // absent: an attachment resolves
};

// Overlays on the finished hair that show the simulation.

// The wire frame of a capsule: a ring at each end of its axis, four lines between them and two
// great half-circles over each end; of a sphere (a == b), three great circles.
std::vector<gpu::BodyLine> capsuleLines(const Collider& capsule);

// The edges of a mesh, each once.
std::vector<gpu::BodyLine> meshLines(const groom::Mesh& mesh, Follows follows);

// Wire frames of all that hair collides with; `meshes` are those of settings.distance_fields.
std::vector<gpu::BodyLine>
bodyLines(const SimulationSettings& settings, std::span<const groom::Mesh> meshes);

// Draws ribbons over the finished hair: the simulated guides, the root triangles (thesis figures
// 4.2 and 4.6) and the bodies that hair collides with, seen through hair and head.
class OverlayPass {
public:
    OverlayPass(const engine::Device& device, const Settings& settings, const RenderAssets& assets);

    bool empty() const { return !guides_ && !root_triangles_ && !bodies_; }

    // Draws into the target that is being rendered to.
    void draw(engine::Commands& commands, std::uint64_t picture, const StrandView& view) const;

private:
    struct BodyWires {
        engine::Buffer lines;  // gpu::BodyLine
        std::uint32_t line_count;
        engine::GraphicsPipeline pipeline;
    };

    std::optional<engine::GraphicsPipeline> guides_;
    std::optional<engine::GraphicsPipeline> root_triangles_;
    std::optional<BodyWires> bodies_;
};

// Draws pictures of a head of hair, or of copies of it (copyOffsets), one after the other, so that
// their strands share the memory of one head. Shadows of a head fall on that head alone. The
// passes are: frames (if strands have offsets or residuals),
// levels (if they are by cluster), skin (if the mesh under the hair deforms), points (if a back end
// draws from them), mesh_shadow and hair_shadow (if asked for), indirect (if asked for), scene,
// strands, composite (if fragments are blended at the end), overlay (if asked for) and resolve (if
// the picture is not the rendered image). If passes may join, scene, strands and overlay are one
// rendering, which resolves samples at its end.
class Renderer {
public:
    // `view` gives the counts, which must not change. `stages` applies to the camera's picture of
    // the strands alone. Throws engine::Unsupported for features that the device lacks.
    Renderer(
        const engine::Device& device, const Settings& settings, const StrandView& view,
        const RenderAssets& assets, const StrandStages& stages = {});
    // The memory of pictures of a groom of this size, without files of meshes, textures and light.
    // The settings must name the back end that draws them. A light that stands for a part of the
    // environment may be missing.
    static engine::MemoryRows rows(
        const engine::Device& device, const Settings& settings, const StrandPlan& plan,
        const groom::GroomSize& size);

    Renderer(const Renderer&) = delete;  // its parts point at one another
    Renderer& operator=(const Renderer&) = delete;

    // `views`: of all heads, or one for each of motions().
    void record(engine::Passes& passes, std::span<const StrandView> views);
    void record(engine::Passes& passes, const StrandView& view) {
        record(passes, std::span(&view, 1));
    }

    // Takes effect from the next picture on.
    void setCamera(const CameraSettings& camera) { settings_.camera = camera; }
    void setLodError(float pixels) { settings_.lod.error = pixels; }

    const engine::Target& target() const { return target_; }
    const StrandPlan& plan() const { return plan_; }
    const BackendChoice& backend() const { return backend_; }
    std::uint32_t heads() const { return static_cast<std::uint32_t>(heads_.size()); }
    // Counts those of all heads.
    std::optional<ExpectedCounts> expected() const;
    // Reads the levels by cluster of the picture that was drawn last, of its last head, and waits:
    // [root triangle]. Empty in other modes.
    std::vector<gpu::ClusterLevel> clusterLevels(const engine::Device& device) const;
    const StrandBlend& blend() const { return strands_.blend(); }

private:
    std::array<float, 3> background() const;
    enum class Points { recorded, needed };  // of this head
    enum class Bounds { cleared, old };  // of the points
    struct Head {
        glm::vec3 offset{0.0f};  // m
        gpu::PictureParameters parameters{};  // in the frame that is recorded
        std::uint64_t address = 0;  // of the parameters on the device
    };
    StrandPicture pictureOf(const Head& head) const {
        return {.address = head.address, .parameters = head.parameters, .images = strand_images_};
    }
    void writePictures(std::uint32_t slot, std::span<const StrandView> views);
    void recordLevels(engine::Passes& passes, const StrandPicture& picture) const;
    void recordShape(engine::Passes& passes, const StrandView& view, const StrandPicture& picture);
    void recordPoints(
        engine::Passes& passes, const StrandPicture& picture, Bounds bounds = Bounds::old) const;
    void recordStructure(engine::Passes& passes, const StrandPicture& picture);
    void recordIndirect(engine::Passes& passes, const StrandPicture& picture) const;
    void recordJoined(
        engine::Passes& passes, const StrandView& view, const StrandPicture& picture) const;
    // Which of the heads is drawn: the first clears the target, the last completes the picture.
    struct Turn {
        bool first = true;
        bool last = true;
    };
    void
    recordApart(engine::Passes& passes, const StrandPicture& picture, Points points, Turn turn);
    void recordOverlays(engine::Passes& passes, std::span<const StrandView> views) const;

    StrandPlan plan_;
    BackendChoice backend_;
    Settings settings_;  // with the back end that was chosen
    engine::Target target_;
    std::vector<Head> heads_;
    std::vector<std::uint32_t> order_;  // of heads, nearest first
    std::vector<std::byte> written_;  // into parameters_
    // gpu::PictureParameters [head], kPictureStride apart
    std::array<engine::Buffer, engine::FrameLoop::kMaxSlots> parameters_;
    engine::Buffer lights_;  // gpu::Light [head][light]
    HairOpticsBuffers optics_;
    std::optional<FramesPass> frames_;
    std::optional<LevelsPass> levels_;  // for LodMode::cluster
    std::optional<SkinnedHead> skin_;
    std::optional<PointsPass> points_;
    std::optional<StrandStructure> structure_;
    ShadowPass shadows_;
    EnvironmentPass environment_;
    SceneMeshes meshes_;
    std::optional<IndirectLight> indirect_;
    StrandTexture texture_;
    std::vector<engine::SampledImage> strand_images_;
    StrandPass strands_;
    OverlayPass overlay_;
    ResolvePass resolve_;
};

// The strands of a picture as points in memory, for export, measurement and tests. Every guide
// segment has both of its ends: the last point of a segment is the first of the next.
struct StrandPoints {
    StrandPlan plan;
    // [triangle][strand][guide segment][0 .. tessellation], root first. In LodMode::distance the
    // counts are those of level 0, and the points that are not drawn have a negative width.
    std::vector<gpu::StrandPointRecord> records;

    // `point` is in [0, tessellation].
    const gpu::StrandPointRecord&
    at(std::uint32_t triangle, std::uint32_t strand, std::uint32_t segment,
       std::uint32_t point) const;
};

// Most points that are evaluated at once: 32 MiB of them. Every device has larger buffers.
inline constexpr std::uint32_t kMostPointsAtOnce = 1u << 20;

// Evaluates all strands on the device and waits. Throws engine::Unsupported for more than 2^32 - 1
// points.
StrandPoints evaluateStrandPoints(
    const engine::Device& device, const Settings& settings, const StrandView& view,
    std::uint32_t most_at_once = kMostPointsAtOnce);

}  // namespace hair::rendering
