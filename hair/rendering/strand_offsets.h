#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "engine/pipeline.h"
#include "hair/groom/groom.h"
#include "hair/rendering/strand_view.h"
#include "hair/settings.h"

// Offsets of strands from their smooth shape, and the frames along guides that offsets and
// residuals refer to.

namespace hair::rendering {

// Rotation-minimising frames along the guides, for the offsets of strands. At the root, a frame is
// the groom's frame at rest, turned by the smallest rotation that follows the guide's direction
// there; it moves without a jump as long as that direction isn't reversed. For residuals, the pass
// computes the rotation of the guides since rest in the same way, from the root on.
class FramesPass {
public:
    // Whether the strands of `view` have offsets or residuals.
    static bool isNeeded(const StrandView& view);

    // `view` gives the counts, and says which of the two are needed.
    FramesPass(const engine::Device& device, const StrandView& view);

    // Without offsets there are no normals, and without residuals no turns.
    static engine::MemoryRows rows(std::uint64_t vertices, bool has_normals, bool has_turns);

    // Belongs after the pass that moves the guides, which must be visible to compute, and before
    // the draws. The frames are then visible to the stages before the rasteriser.
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

// Offsets of drawn strands from their smooth shape: thesis 2.3.8.2 and 2.3.8.3. They are computed
// once. A hash picks a profile for each strand, the same at every level of detail. A vector is
// along the normal, the binormal and the tangent of a rotation-minimising frame of the strand. The
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
// Whether their offsets need frames: offsets of a table, or of the scene's own function.
bool hasFrames(const StrandSettings& settings);
// Greatest offset that the function makes, m: its parameter `reach`. 0 without a function.
float functionReach(const StrandSettings& settings);

// Estimates the bytes of a table of offsets if the groom is not known yet. `length` is the guides'
// mean length, m; a model is taken to have kMostProfiles strands of 64 points.
std::uint64_t offsetBytes(const StrandSettings& settings, double length);

// Adds up curls, variation and the offsets of `model`. Frequencies are per metre of the guides'
// mean length at rest, which stands for the length of every strand, and the model's offsets scale
// with it. `model` is the file that settings.offsets names, null if that is empty. Up to
// kMostProfiles of its strands, spread over the file, become profiles, each turned about its axis
// at random. Throws engine::Error, beginning with the JSON pointer, for more than a table can hold:
// 1,024 turns or 2,048 changes of direction on a strand.
StrandOffsets makeStrandOffsets(
    const StrandSettings& settings, const groom::Groom& groom, const groom::StrandSet* model,
    std::uint32_t seed);

// Residuals: the differences of a file's strands from the curves of their guides' mean. With them,
// the strands drawn at rest are those of the file.

// The residual of one strand: samples, one for each point of the file.
struct StrandResidual {
    std::uint32_t first = 0;  // index into StrandResiduals::samples
    std::uint32_t count = 0;  // at least 2
    float step = 0.0f;  // m, unit of a sample's integers
    float reach = 0.0f;  // m: no vector of the curve through the samples is longer
};

// Lengths of vectors from the points of a file to other points, m.
struct Lengths {
    double mean = 0.0;
    double greatest = 0.0;
};

// The residuals of strands. A sample is four integers of 16 bits: a vector in steps, in the axes of
// the groom at rest, and its place along the strand, 0 at the root and 65,535 at the tip. A point
// is left out if its place is taken. Rounding moves a point by up to half a step along each axis,
// 2.7e-5 of the strand's greatest residual, and along the strand by 1/131,070 of its length.
struct StrandResiduals {
    std::vector<StrandResidual> strands;  // in the requested order
    // Layout of shaders/strands/residuals.glsl. The first is {h, 0}: h steps of bisection find a
    // place among a strand's samples; 0 if the samples of all strands are evenly spaced. The
    // samples follow, strand after strand.
    std::vector<glm::uvec2> samples;
    Lengths kept;  // of all residuals
    Lengths left;  // from the drawn curve to the points of the file, without rounding of floats
};

// Returns the residuals of the bound strands `order`, which need their points in
// groom.bound_points. Residuals are relative to the curves of the settings or, for a strand that
// follows the head alone, to its root.
StrandResiduals makeStrandResiduals(
    const groom::Groom& groom, const StrandSettings& settings,
    std::span<const std::uint32_t> order);

// Returns the directions along the guides at rest, [guide][vertex]: unit vectors from the previous
// vertex to the next, 0 where both are at one place.
std::vector<glm::vec3> restTangents(const groom::Groom& groom);

}  // namespace hair::rendering
