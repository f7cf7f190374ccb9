#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "engine/pipeline.h"
#include "engine/target.h"
#include "hair/gpu_structs.h"
#include "hair/rendering/points_pass.h"
#include "hair/rendering/strand_backend.h"

namespace hair::rendering {

// Rasterises opaque strands in compute, from their points. Pieces of strands write their number and
// depth to the samples that they cover, by atomic minima. Each sample that shows a strand is shaded
// once, and two triangles bring colour and depth into the target. Clearing, shading and drawing are
// limited to the hair's bounds on the screen. Some strands are drawn first; pieces of the others
// are culled if they lie behind those or the scene.
//
// Pieces are the quads that the other back ends draw, and samples lie at Vulkan's standard
// positions, so the picture matches theirs up to rounding. With several samples, each is shaded by
// itself, not once a pixel.
class SoftwareBackend : public StrandBackend {
public:
    // Needs context.target, with sampled_depth, and context.points. Throws engine::Unsupported for
    // anything that the device or the back end can't do.
    explicit SoftwareBackend(const BackendContext& context);

    // Throws as the constructor does, without making the back end.
    static void
    check(const engine::Device& device, const Settings& settings, const StrandPlan& plan);

    static engine::MemoryRows
    rows(const engine::Device& device, const Settings& settings, const StrandPlan& plan);

    void prepare(engine::Commands& commands, const StrandPicture& picture) const override;
    void draw(engine::Commands& commands, const StrandPicture& picture) const override;

    std::string variant() const override;
    std::optional<ExpectedCounts> expected() const override { return std::nullopt; }

private:
    // The push constants that all stages share. Each stage adds the addresses of what it uses.
    gpu::SoftwarePush push(const StrandPicture& picture) const;
    void clear(engine::Commands& commands, const StrandPicture& picture) const;
    void rasterize(engine::Commands& commands, const StrandPicture& picture) const;
    gpu::SoftwarePush ofPart(gpu::SoftwarePush constants, std::uint32_t part) const;
    void cullPieces(engine::Commands& commands, gpu::SoftwarePush constants) const;
    void rasterizePieces(engine::Commands& commands, gpu::SoftwarePush constants) const;
    void rasterizeLarge(engine::Commands& commands, gpu::SoftwarePush constants) const;
    void reduceTiles(engine::Commands& commands, gpu::SoftwarePush constants) const;
    void buildPyramid(engine::Commands& commands, gpu::SoftwarePush constants) const;
    void shade(engine::Commands& commands, const StrandPicture& picture) const;

    const engine::Target& target_;
    const PointsPass& points_;
    std::uint32_t samples_per_pixel_;
    std::uint32_t group_;  // invocations of a work group of passes with strands or pieces
    std::uint32_t block_;  // strands per invocation
    std::uint32_t pieces_per_strand_;
    std::uint32_t rasterized_pieces_;  // at most, per invocation
    bool is_packed_;  // with 64-bit integers and atomics
    const engine::TexelView* texels_;  // the points; null if shaders read by address alone
    engine::Buffer visibility_;
    engine::Buffer colors_;  // empty without linear light
    engine::Buffer counts_;  // gpu::PieceCounts
    // Pieces that may be visible: those of the first strands, then those of the others. It has room
    // for whole blocks, because the last block, which may have fewer strands, may be among the
    // first.
    engine::Buffer list_;
    engine::Buffer large_;  // pieces that cover many samples
    engine::Buffer tile_depths_;
    engine::Buffer pyramid_;
    // Only if texels_ is set.
    engine::TexelView visibility_texels_;
    engine::TexelView tile_texels_;
    engine::TexelView pyramid_texels_;
    engine::ComputePipeline clear_;
    engine::ComputePipeline reduce_tiles_;
    engine::ComputePipeline build_pyramid_;
    engine::ComputePipeline cull_;
    engine::ComputePipeline rasterize_;
    engine::ComputePipeline rasterize_large_;
    std::uint32_t shaded_columns_;  // work groups per row of pixels
    engine::ComputePipeline shade_;
    engine::GraphicsPipeline blit_;
};

}  // namespace hair::rendering
