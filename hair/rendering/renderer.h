#pragma once

#include <array>
#include <memory>
#include <optional>

#include "engine/frame_loop.h"
#include "engine/target.h"
#include "hair/groom/mesh/mesh.h"
#include "hair/rendering/frames_pass.h"
#include "hair/rendering/mesh_pass.h"
#include "hair/rendering/overlay_pass.h"
#include "hair/rendering/resolve_pass.h"
#include "hair/rendering/strand_backend.h"
#include "hair/rendering/strand_view.h"
#include "hair/settings.h"

namespace hair {

// Draws pictures of a head of hair: the passes frames (where strands are offset), scene, strands,
// overlay (where asked for) and resolve.
class Renderer {
public:
    // `mesh` is drawn under the hair; null: none. `view` gives the counts, which stay as they are.
    // Throws engine::Unsupported for what the device can't do.
    Renderer(
        const engine::Device& device, const Settings& settings, const StrandView& view,
        const Mesh* mesh);

    void record(engine::Passes& passes, const StrandView& view);

    const engine::Target& target() const { return target_; }
    const StrandPlan& plan() const { return plan_; }
    std::optional<ExpectedCounts> expected() const { return backend_->expected(); }

private:
    Settings settings_;
    StrandPlan plan_;
    engine::Target target_;
    std::array<engine::Buffer, engine::FrameLoop::kMaxSlots> parameters_;  // gpu::PictureParameters
    std::optional<FramesPass> frames_;
    std::optional<MeshPass> mesh_;
    std::unique_ptr<StrandBackend> backend_;
    OverlayPass overlay_;
    ResolvePass resolve_;
};

}  // namespace hair
