#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "engine/pipeline.h"
#include "hair/rendering/points_pass.h"
#include "hair/rendering/software_backend.h"
#include "hair/rendering/strand_backend.h"
#include "hair/rendering/strand_structure.h"

namespace hair::rendering {

// Finds what each sample shows by a ray from the eye: in the StrandStructure, a ray query through
// each sample of a VisibilityBuffer finds the nearest piece. Shading and drawing are those of
// `software`.
class RaysBackend : public StrandBackend {
public:
    // Needs what VisibilityBuffer needs, and context.structure. Throws engine::Unsupported for
    // anything that the device or the back end can't do.
    explicit RaysBackend(const BackendContext& context);

    // Throws as the constructor does, without making the back end.
    static void
    check(const engine::Device& device, const Settings& settings, const StrandPlan& plan);

    // Without those of the structure.
    static engine::MemoryRows
    rows(const engine::Device& device, const Settings& settings, const StrandPlan& plan);

    void prepare(engine::Commands& commands, const StrandPicture& picture) const override;
    void draw(engine::Commands& commands, const StrandPicture& picture) const override;

    std::optional<ExpectedCounts> expected() const override { return std::nullopt; }

private:
    const PointsPass& points_;
    const StrandStructure& structure_;
    VisibilityBuffer visibility_;
    std::uint32_t columns_;  // work groups of trace_ per row of pixels
    engine::ComputePipeline trace_;
};

}  // namespace hair::rendering
