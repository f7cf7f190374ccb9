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
#include "hair/rendering/backends.h"
#include "hair/rendering/points_pass.h"

namespace hair::rendering {

// Bytes of what `software` keeps for each sample, pixel and piece of strand.
struct SoftwareSizes {
    std::size_t samples = 0;
    std::size_t colors = 0;  // 0 without linear light
    std::size_t list = 0;
    std::size_t large = 0;
    std::size_t tiles = 0;
    std::size_t windows = 0;

    std::size_t sum() const { return samples + colors + list + large + tiles + windows; }
};

// `pieces`: of all strands that a dispatch looks at, whole blocks of them.
SoftwareSizes softwareSizes(const engine::TargetDescription& target, std::uint64_t pieces);

// Strands rasterised in compute, opaque, from their points. Pieces of strands leave their number
// and depth at the samples that they cover, by atomic minima; each sample that shows a strand is
// shaded once; and two triangles bring color and depth into the target. What shows no hair costs
// nothing: samples are cleared, shaded and drawn within the hair's bounds on the screen. Some
// strands come first; of the others the pieces are left out that are behind those and the scene.
//
// Pieces are the quads that the other back ends draw, and samples lie where Vulkan's standard
// positions are, so that the picture is theirs but for rounding; with several samples each is
// shaded by itself, not once a pixel.
class SoftwareBackend : public StrandBackend {
public:
    // Needs context.target, with sampled_depth, and context.points. Throws engine::Unsupported for
    // what the device or the back end can't do.
    explicit SoftwareBackend(const BackendContext& context);

    // The same of a case, before it is made.
    static void
    check(const engine::Device& device, const Settings& settings, const StrandPlan& plan);

    void prepare(engine::Commands& commands, const StrandPicture& picture) const override;
    void draw(engine::Commands& commands, const StrandPicture& picture) const override;

    std::string variant() const override;
    std::optional<ExpectedCounts> expected() const override { return std::nullopt; }

private:
    SoftwareBackend(const BackendContext& context, const SoftwareSizes& sizes);

    // What every stage knows; it adds the addresses of what it touches, and no others.
    gpu::SoftwarePush push(const StrandPicture& picture) const;
    void clear(engine::Commands& commands, const StrandPicture& picture) const;
    void cover(engine::Commands& commands, const StrandPicture& picture) const;
    gpu::SoftwarePush ofPart(gpu::SoftwarePush constants, std::uint32_t part) const;
    void findPieces(engine::Commands& commands, gpu::SoftwarePush constants) const;
    void coverPieces(engine::Commands& commands, gpu::SoftwarePush constants) const;
    void coverLarge(engine::Commands& commands, gpu::SoftwarePush constants) const;
    void findTiles(engine::Commands& commands, gpu::SoftwarePush constants) const;
    void findWindows(engine::Commands& commands, gpu::SoftwarePush constants) const;
    void shade(engine::Commands& commands, const StrandPicture& picture) const;

    const engine::Target& target_;
    const PointsPass& points_;
    std::uint32_t samples_per_pixel_;
    std::uint32_t block_;  // strands that an invocation looks at
    std::uint32_t blocks_;
    std::uint32_t pieces_per_strand_;
    bool is_packed_;  // with 64-bit integers and atomics
    const engine::TexelView* texels_;  // the points; null: all is read by address
    engine::Buffer samples_;
    engine::Buffer colors_;  // empty without linear light
    engine::Buffer counts_;  // gpu::PieceCounts
    // Pieces that may be seen, of the first strands and then of the others. It has room for whole
    // blocks: the last one, of fewer strands, may be among the first.
    engine::Buffer list_;
    engine::Buffer large_;  // pieces with many samples
    engine::Buffer tiles_;
    engine::Buffer windows_;
    // Where the points are texels.
    engine::TexelView sample_texels_;
    engine::TexelView tile_texels_;
    engine::TexelView window_texels_;
    engine::ComputePipeline clear_;
    engine::ComputePipeline find_tiles_;
    engine::ComputePipeline find_windows_;
    engine::ComputePipeline find_;
    engine::ComputePipeline cover_;
    engine::ComputePipeline cover_large_;
    std::uint32_t shaded_columns_;  // of workgroups, for each row of pixels
    engine::ComputePipeline shade_;
    engine::GraphicsPipeline show_;
};

}  // namespace hair::rendering
