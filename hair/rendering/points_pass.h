#pragma once

#include <cstdint>
#include <optional>

#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "engine/device.h"
#include "engine/pipeline.h"
#include "hair/gpu_structs.h"
#include "hair/rendering/groom_buffers.h"
#include "hair/rendering/strand_plan.h"
#include "hair/settings.h"

namespace hair::rendering {

// Throws engine::Unsupported for more strands than shaders number.
void checkPoints(const StrandPlan& plan);

// B that the points of all drawn strands take.
std::uint64_t pointsBytes(const StrandSettings& strands, const StrandPlan& plan);

// The points of all drawn strands, each evaluated once, for every picture of a frame: the camera's
// and the lights'. Levels of detail are the camera's in all of them. 16 bytes a point.
class PointsPass {
public:
    // `culls`: strands that the camera can't see get no points; only where no light's map needs
    // them. As checkPoints().
    PointsPass(
        const engine::Device& device, const Settings& settings, const StrandPlan& plan, bool culls);

    // `picture` is the address of `parameters`, the camera's.
    void record(
        engine::Commands& commands, std::uint64_t picture,
        const gpu::PictureParameters& parameters) const;

    const engine::Buffer& points() const { return points_; }  // gpu::PointsPush::points
    const engine::Buffer& pieces() const { return pieces_; }  // gpu::PointsPush::pieces
    const engine::Buffer& bounds() const { return bounds_; }  // gpu::HairBounds, of the camera
    // The points as texels; absent where nobody would read them so.
    const engine::TexelView* texels() const { return texels_ ? &*texels_ : nullptr; }
    std::uint32_t strandCount() const { return push_.strands; }
    std::uint64_t bytes() const { return points_.size() + pieces_.size(); }

private:
    gpu::PointsPush push_;  // but for the picture
    std::uint32_t blocks_;  // of strands, one to an invocation
    engine::Buffer points_;
    std::optional<engine::TexelView> texels_;
    engine::Buffer pieces_;
    engine::Buffer bounds_;
    engine::ComputePipeline evaluate_;
};

// The specialization constants that say where points are, and those with strandConstants():
// strands/points/layout.glsl.
engine::Constants placeConstants(const StrandPlan& plan);
engine::Constants pointsConstants(const StrandSettings& strands, const StrandPlan& plan);

// Whether shaders read and write points 64 bits at a time: a device that takes one element of one
// invocation at a time takes 64 bits of it as soon as 32.
bool readsPairs(const engine::Device& device);

// Strands of an invocation, of which each piece takes so many turns of loops. What is read once for
// all of them counts on a processor, that there are many invocations elsewhere. Strands of a groom
// have guides of their own. Mesa's lavapipe ends an invocation's loops after 65,535 turns in all.
std::uint32_t strandBlock(
    const engine::Device& device, const StrandSettings& strands, const StrandPlan& plan,
    std::uint32_t turns);

}  // namespace hair::rendering
