#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "engine/acceleration.h"
#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "engine/pipeline.h"
#include "hair/rendering/points_pass.h"
#include "hair/rendering/software_backend.h"
#include "hair/rendering/strand_backend.h"

namespace hair::rendering {

// Finds what each sample shows by a ray. The quads that the other back ends draw are made from the
// points, as two triangles each, and an acceleration structure of them is built in every frame, or
// fitted to them (/strands/rays/update). From the eye a ray query through each sample of a
// VisibilityBuffer finds the nearest piece; shading and drawing are those of `software`.
class RaysBackend : public StrandBackend {
public:
    // Needs what VisibilityBuffer needs. Throws engine::Unsupported for anything that the device or
    // the back end can't do.
    explicit RaysBackend(const BackendContext& context);

    // Throws as the constructor does, without making the back end.
    static void
    check(const engine::Device& device, const Settings& settings, const StrandPlan& plan);

    static engine::MemoryRows
    rows(const engine::Device& device, const Settings& settings, const StrandPlan& plan);

    bool accelerates() const override { return true; }
    void accelerate(engine::Commands& commands, const StrandPicture& picture) override;
    void prepare(engine::Commands& commands, const StrandPicture& picture) const override;
    void draw(engine::Commands& commands, const StrandPicture& picture) const override;

    std::optional<ExpectedCounts> expected() const override { return std::nullopt; }

private:
    const PointsPass& points_;
    VisibilityBuffer visibility_;
    std::uint32_t point_count_;  // of all strands at the finest level of detail
    bool leaves_out_;  // strands that are not drawn
    std::uint32_t group_;  // invocations of a work group of corners_stage_
    std::uint32_t columns_;  // work groups of trace_ per row of pixels
    engine::Buffer corners_;  // gpu::CornersPush::corners
    engine::Buffer indices_;  // uint [triangle][3]
    engine::TriangleStructure structure_;
    engine::ComputePipeline corners_stage_;
    engine::ComputePipeline trace_;
};

}  // namespace hair::rendering
