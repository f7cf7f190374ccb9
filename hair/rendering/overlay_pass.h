#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/buffer_image.h"
#include "engine/pipeline.h"
#include "hair/gpu_structs.h"
#include "hair/groom/mesh/mesh.h"
#include "hair/rendering/render_assets.h"
#include "hair/rendering/strand_view.h"
#include "hair/settings.h"

// Overlays on the finished hair that show the simulation.
namespace hair::rendering {

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

}  // namespace hair::rendering
