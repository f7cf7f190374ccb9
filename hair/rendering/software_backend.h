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

// For each sample of the camera's picture, the number and the depth of the piece of a strand there.
// `software` and `rays` find the pieces in compute. They are then shaded, once for each sample, and
// two triangles bring colour and depth into the target. All stages are limited to the hair's bounds
// on the screen.
class VisibilityBuffer {
public:
    // Needs context.target, with sampled_depth, and context.points. Throws engine::Unsupported for
    // counts and positions of samples that the shaders don't know. `backend` begins the message.
    VisibilityBuffer(const BackendContext& context, const std::string& backend);

    // Throws as the constructor does, without making the buffer.
    static void
    check(const engine::Device& device, const Settings& settings, const std::string& backend);

    static engine::MemoryRows rows(const engine::TargetDescription& target);

    // The push constants that all stages share. Each stage adds the addresses of what it uses.
    gpu::SoftwarePush push(const StrandPicture& picture) const;
    const engine::Buffer& samples() const { return samples_; }  // gpu::SoftwarePush::visibility
    // The samples as a texel buffer; null if shaders read by address alone.
    const engine::TexelView* texels() const { return points_texels_ ? &texels_ : nullptr; }

    // Every sample shows the scene. Begins reading the target's depth.
    void clear(engine::Commands& commands, const StrandPicture& picture) const;
    // Shades the samples that show a piece. Ends reading the target's depth.
    void shade(engine::Commands& commands, const StrandPicture& picture) const;
    // Draws the shaded samples into the target; within rendering.
    void draw(engine::Commands& commands, const StrandPicture& picture) const;

private:
    const engine::Target& target_;
    const PointsPass& points_;
    const StrandStructure* structure_;  // null if shading traces no rays
    std::uint32_t samples_per_pixel_;
    const engine::TexelView* points_texels_;  // null if shaders read by address alone
    engine::Buffer samples_;
    engine::Buffer colors_;  // empty without linear light
    engine::TexelView texels_;  // only if points_texels_ is set
    engine::ComputePipeline clear_;
    std::uint32_t shaded_columns_;  // work groups per row of pixels
    engine::ComputePipeline shade_;
    engine::GraphicsPipeline blit_;
};

// A compute stage of strands/software or strands/rays, without images. `name`: below `folder`.
engine::ComputeDescription samplesStage(
    const BackendContext& context, const std::string& folder, const std::string& name,
    std::uint32_t group, std::uint32_t block = 1);

// Returns the invocations of a work group of stages with pixels.
std::uint32_t pixelGroup(const engine::Device& device);

// Rasterises opaque strands in compute, from their points. Pieces of strands write their number and
// depth to the samples of a VisibilityBuffer that they cover, by atomic minima. Some strands are
// drawn first; pieces of the others are culled if they lie behind those or the scene.
//
// Pieces are the quads that the other back ends draw, and samples lie at Vulkan's standard
// positions, so the picture matches theirs up to rounding. With several samples, each is shaded by
// itself, not once a pixel.
class SoftwareBackend : public StrandBackend {
public:
    // Needs what VisibilityBuffer needs. Throws engine::Unsupported for anything that the device or
    // the back end can't do.
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
    void rasterize(engine::Commands& commands, const StrandPicture& picture) const;
    gpu::SoftwarePush ofPart(gpu::SoftwarePush constants, std::uint32_t part) const;
    void cullPieces(engine::Commands& commands, gpu::SoftwarePush constants) const;
    void rasterizePieces(engine::Commands& commands, gpu::SoftwarePush constants) const;
    void rasterizeLarge(engine::Commands& commands, gpu::SoftwarePush constants) const;
    void reduceTiles(engine::Commands& commands, gpu::SoftwarePush constants) const;
    void buildPyramid(engine::Commands& commands, gpu::SoftwarePush constants) const;

    const PointsPass& points_;
    VisibilityBuffer visibility_;
    std::size_t sample_count_;  // of the picture
    std::uint32_t group_;  // invocations of a work group of passes with strands or pieces
    std::uint32_t block_;  // strands per invocation
    std::uint32_t pieces_per_strand_;
    std::uint32_t rasterized_pieces_;  // at most, per invocation
    bool is_packed_;  // with 64-bit integers and atomics
    const engine::TexelView* texels_;  // the points; null if shaders read by address alone
    engine::Buffer counts_;  // gpu::PieceCounts
    // Pieces that may be visible: those of the first strands, then those of the others. It has room
    // for whole blocks, because the last block, which may have fewer strands, may be among the
    // first.
    engine::Buffer list_;
    engine::Buffer large_;  // pieces that cover many samples
    engine::Buffer tile_depths_;
    engine::Buffer pyramid_;
    // Only if texels_ is set.
    engine::TexelView tile_texels_;
    engine::TexelView pyramid_texels_;
    engine::ComputePipeline reduce_tiles_;
    engine::ComputePipeline build_pyramid_;
    engine::ComputePipeline cull_;
    engine::ComputePipeline rasterize_;
    engine::ComputePipeline rasterize_large_;
};

// Draws lights' maps in compute, from strands' points, as the back ends of QuadKind::light do:
// depth, then opacity in layers, one map after the other in the same memory. Sums are whole
// numbers, so the maps do not depend on the order of strands. On processors this is faster than the
// rasteriser, whose stages for vertices have one thread: docs/performance.md.
class MapRasterizer {
public:
    // Needs context.points. `side`: of a map, texels.
    MapRasterizer(const BackendContext& context, std::uint32_t side);

    static engine::MemoryRows rows(std::uint32_t side);
    // The formats of the images for depth and for layers, which must be storage images.
    static constexpr VkFormat kDepthFormat = VK_FORMAT_R32_SFLOAT;
    static constexpr VkFormat kLayerFormat = VK_FORMAT_R32G32B32A32_SFLOAT;

    // Records the drawing of a light's map into its part of two images in GENERAL. Its picture has
    // the address of its gpu::ShadowMap as `shadows`, and picture.images has the depth of meshes.
    void record(
        engine::Commands& commands, const StrandPicture& picture, const engine::Image& depths,
        const engine::Image& layers) const;

private:
    const PointsPass& points_;
    std::uint32_t side_;
    std::uint32_t group_;  // invocations of a work group of passes with strands
    std::uint32_t runs_;  // invocations of a strand
    std::uint32_t large_groups_;  // work groups of rasterize_large_
    const engine::TexelView* texels_;  // the points; null if shaders read by address alone
    engine::Buffer depths_;  // gpu::ShadowRasterPush
    engine::Buffer layers_;
    engine::Buffer large_;
    engine::ComputePipeline rasterize_;
    engine::ComputePipeline rasterize_large_;
    engine::ComputePipeline store_;
};

}  // namespace hair::rendering
