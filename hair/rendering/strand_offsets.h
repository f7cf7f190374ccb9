#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "engine/pipeline.h"
#include "hair/groom/groom.h"
#include "hair/rendering/groom_buffers.h"
#include "hair/settings.h"

// Offsets of strands from their smooth shape, and the frames along guides that they and residuals
// are in.
namespace hair::rendering {

// Frames along the guides that don't turn about them, for the offsets of strands. They start at the
// root with what the groom has at rest, turned as little as the guide's direction there has turned:
// as long as that isn't reversed they move without a jump. And how the guides have turned since
// rest, for residuals: in the same way, from the root on.
class FramesPass {
public:
    // Whether what is drawn of `view` has either.
    static bool isNeeded(const StrandView& view);

    // `view` gives the counts, and which of the two there are.
    FramesPass(const engine::Device& device, const StrandView& view);

    // Belongs after what moves the guides, which compute sees, and before what draws. The frames
    // are then visible to the stages before the rasteriser.
    void record(engine::Commands& commands, const StrandView& view) const;

    // vec3 [guide][vertex], unit length, across the guide; empty without offsets.
    const engine::Buffer& normals() const { return normals_; }
    // vec4 [guide][vertex], unit quaternions, from rest to now; empty without residuals.
    const engine::Buffer& turns() const { return turns_; }

private:
    std::optional<engine::ComputePipeline> frame_;
    std::optional<engine::ComputePipeline> turn_;
    engine::Buffer normals_;
    engine::Buffer turns_;
};

// Offsets of drawn strands from their smooth shape: thesis 2.3.8.2 and 2.3.8.3. Computed once; a
// strand takes one of the profiles by a hash, the same at every level of detail. A vector is along
// the normal, the binormal and the tangent of a frame that does not turn about the strand. The
// first sample, at the root, is 0.
struct StrandOffsets {
    static constexpr std::uint32_t kProfiles = 64;  // without a model
    static constexpr std::uint32_t kMostProfiles = 1024;  // with one
    // With more samples there are fewer profiles: a table has about 2^22 vectors at most, 50 MB.
    static constexpr std::uint32_t kMostSamples = 16384;

    std::uint32_t profiles = 0;
    std::uint32_t samples = 0;  // from root to tip, evenly spaced; at least 2
    // [profile][1 + sample + 1], m; one more step at both ends, for the curve through the samples.
    std::vector<glm::vec3> values;

    std::span<const glm::vec3> profile(std::uint32_t index) const {
        const std::size_t stride = samples + std::size_t{2};
        return std::span(values).subspan(index * stride + 1, samples);
    }
};

// Whether strands are drawn off their smooth shape at all.
bool hasOffsets(const StrandSettings& settings);
// Whether they are offset along frames: by a table, or by a function of the scene's own.
bool hasFrames(const StrandSettings& settings);
// How far that function takes them at most, m: its parameter `reach`. 0 without one.
float functionReach(const StrandSettings& settings);

// B of a table of offsets for guides of a mean length, m, where a model has kMostProfiles strands
// of 64 points: for who does not know the groom yet.
std::uint64_t offsetBytes(const StrandSettings& settings, double length);

// Curls, variation and the offsets of `model`, added up. Frequencies are per metre of the guides'
// mean length at rest, which stands for the length of every strand, and the model's offsets grow
// with it. `model` is what settings.offsets names, null if that is empty; up to kMostProfiles of
// its strands, spread over the file, become profiles, each turned about itself at random.
// Throws engine::Error, beginning with the JSON pointer, for what a table can't hold: more than
// 1,024 turns or 2,048 changes of direction on a strand.
StrandOffsets makeStrandOffsets(
    const StrandSettings& settings, const groom::Groom& groom, const groom::StrandSet* model,
    std::uint32_t seed);

}  // namespace hair::rendering
