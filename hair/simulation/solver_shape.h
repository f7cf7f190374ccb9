#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "engine/instance.h"
#include "engine/pipeline.h"
#include "hair/groom/groom.h"
#include "hair/groom/groom_size.h"
#include "hair/settings.h"
#include "hair/simulation/guide_solver.h"

namespace hair::simulation {

struct ShapeRest;

// Division of the `shape` solver's strands among invocations.
struct ShapePlan {
    std::string shader;
    engine::Constants constants;  // without kShapeCollidesConstant
    bool collides = false;        // whether it tests for contact with bodies
    std::uint32_t strands_per_group = 0;
};

// The thesis's solver: Verlet, then global, local (Han and Harada 2012) and length constraints
// (thesis section 3). Lengths use direct solves, unless the settings ask for the thesis's
// iterations.
class ShapeSolver : public GuideSolver {
public:
    // Throws Unsupported if strands have more vertices than 32 for each invocation of the device's
    // largest work group, within its shared memory.
    ShapeSolver(
        const engine::Device& device, const groom::Groom& groom, const SimulationSettings& settings,
        const gpu::Step& step);

    ~ShapeSolver() override;

    static engine::MemoryRows
    rows(const engine::DeviceInfo&, const groom::GroomSize& size, const SimulationSettings&);

    void record(engine::Commands& commands, gpu::SubstepPush push) const override;
    void expectBodies(const engine::Device& device) override;
    const RestBalance* balance() const override { return balance_ ? &*balance_ : nullptr; }
    bool correctBalance(const engine::Device& device, std::span<const glm::vec3> moved) override;
    const engine::Buffer* goals() const override { return &rest_positions_; }

private:
    ShapeSolver(
        const engine::Device& device, const groom::Groom& groom, const SimulationSettings& settings,
        const gpu::Step& step, std::unique_ptr<ShapeRest> rest);

    std::unique_ptr<ShapeRest> balancing_;  // until it is balanced
    std::optional<RestBalance> balance_;
    std::uint32_t strand_count_;
    ShapePlan plan_;
    engine::Buffer rest_positions_;
    engine::Buffer rest_edges_;
    engine::Buffer local_stiffness_;
    engine::Buffer parameters_;
    engine::ComputePipeline pipeline_;
};

}  // namespace hair::simulation
