#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "engine/frame_loop.h"
#include "engine/target.h"
#include "hair/gpu_structs.h"
#include "hair/rendering/backend_choice.h"
#include "hair/rendering/environment.h"
#include "hair/rendering/fiber.h"
#include "hair/rendering/overlay_pass.h"
#include "hair/rendering/points_pass.h"
#include "hair/rendering/render_assets.h"
#include "hair/rendering/resolve_pass.h"
#include "hair/rendering/scene_meshes.h"
#include "hair/rendering/shadow_pass.h"
#include "hair/rendering/skinned_head.h"
#include "hair/rendering/strand_offsets.h"
#include "hair/rendering/strand_pass.h"
#include "hair/rendering/strand_plan.h"
#include "hair/rendering/strand_view.h"
#include "hair/settings.h"

namespace hair::rendering {

// Bytes of device memory that a Renderer's images and strands take, without its assets. The
// settings must name the back end that draws them.
std::uint64_t rendererBytes(const Settings& settings, const StrandPlan& plan);

// Draws pictures of a head of hair, in these passes: frames (if strands have offsets or residuals),
// skin (if the mesh under the hair deforms), points (if a back end draws from them), mesh_shadow
// and hair_shadow (if asked for), scene, strands, composite (if fragments are blended at the end),
// overlay (if asked for) and resolve (if the picture is not the rendered image). If passes may
// join, scene, strands and overlay are one rendering, which resolves samples at its end.
class Renderer {
public:
    // `view` gives the counts, which must not change. `stages` applies to the camera's picture of
    // the strands alone. Throws engine::Unsupported for features that the device lacks.
    Renderer(
        const engine::Device& device, const Settings& settings, const StrandView& view,
        const RenderAssets& assets, const StrandStages& stages = {});
    Renderer(const Renderer&) = delete;  // its parts point at one another
    Renderer& operator=(const Renderer&) = delete;

    void record(engine::Passes& passes, const StrandView& view);

    // Takes effect from the next picture on.
    void setCamera(const CameraSettings& camera) { settings_.camera = camera; }

    const engine::Target& target() const { return target_; }
    const StrandPlan& plan() const { return plan_; }
    const BackendChoice& backend() const { return backend_; }
    std::optional<ExpectedCounts> expected() const { return strands_.expected(); }
    const StrandBlend& blend() const { return strands_.blend(); }

private:
    std::array<float, 3> background() const;
    void drawScene(engine::Commands& commands, const StrandPicture& picture) const;
    void recordJoined(
        engine::Passes& passes, const StrandView& view, const StrandPicture& picture) const;
    void
    recordApart(engine::Passes& passes, const StrandView& view, const StrandPicture& picture) const;

    StrandPlan plan_;
    BackendChoice backend_;
    Settings settings_;  // with the back end that was chosen
    engine::Target target_;
    std::array<engine::Buffer, engine::FrameLoop::kMaxSlots> parameters_;  // gpu::PictureParameters
    engine::Buffer lights_;  // gpu::Light
    HairOpticsBuffers optics_;
    std::optional<FramesPass> frames_;
    std::optional<SkinnedHead> skin_;
    std::optional<PointsPass> points_;
    ShadowPass shadows_;
    EnvironmentPass environment_;
    SceneMeshes meshes_;
    StrandTexture texture_;
    std::vector<engine::SampledImage> strand_images_;
    StrandPass strands_;
    OverlayPass overlay_;
    ResolvePass resolve_;
};

}  // namespace hair::rendering
