#pragma once

#include <cstdint>
#include <optional>

#include "engine/acceleration.h"
#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "engine/pipeline.h"
#include "hair/gpu_structs.h"
#include "hair/rendering/points_pass.h"
#include "hair/rendering/strand_backend.h"

namespace hair::rendering {

// Returns what the pieces of strands are to rays, if the case's hair is traced by any.
std::optional<RaysGeometry> tracedGeometry(const Settings& settings);

// The acceleration structure of a picture's strands, made from their points in every frame, or
// fitted to them (/strands/rays/update). Rays meet the triangles of the quads that the other back
// ends draw, or boxes with a piece of a strand each, whose round cone the shaders intersect
// (strands/rays/round_cone.glsl).
class StrandStructure {
public:
    // `settings` have a tracedGeometry(). Throws engine::Unsupported for anything that the device
    // can't do.
    StrandStructure(
        const engine::Device& device, const Settings& settings, const StrandPlan& plan,
        const PointsPass& points);

    // Throws as the constructor does, without making the structure.
    static void
    check(const engine::Device& device, const Settings& settings, const StrandPlan& plan);

    // Empty if the device has no ray queries.
    static engine::MemoryRows
    rows(const engine::Device& device, const Settings& settings, const StrandPlan& plan);

    // Records the commands of the pass "acceleration", after those of the points.
    void record(engine::Commands& commands, const StrandPicture& picture);

    // Declares that the next dispatch traces rays, and returns the structure's address.
    std::uint64_t traces(engine::Commands& commands) const { return structure_.traces(commands); }
    // Declares that the next dispatch, or fragments of the next rendering, trace rays of light,
    // with the addresses in gpu::ShadowParameters.
    enum class Tracer { compute, fragments };
    void tracesLight(engine::Commands& commands, Tracer tracer) const;
    // Sets the addresses of what rays of light read; only if hasBoxes().
    void describe(gpu::ShadowParameters& shadows) const;
    bool hasBoxes() const { return geometry_ == RaysGeometry::boxes; }
    // Gpu::StrandBox [strand][segment][piece]; only if hasBoxes().
    const engine::Buffer& boxes() const { return primitives_; }

private:
    const PointsPass& points_;
    RaysGeometry geometry_;
    std::uint32_t invocations_;  // of stage_: one per point of a quad, or per box
    bool leaves_out_;  // strands that are not drawn
    std::uint32_t group_;  // invocations of a work group of stage_
    engine::Buffer primitives_;  // vec3 [vertex], or boxes()
    engine::Buffer indices_;  // uint [triangle][3]; empty for boxes
    engine::AccelerationStructure structure_;
    engine::ComputePipeline stage_;
};

}  // namespace hair::rendering
