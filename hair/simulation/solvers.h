#pragma once

#include <memory>

#include "engine/device.h"
#include "engine/pipeline.h"
#include "hair/gpu_structs.h"
#include "hair/groom/groom.h"
#include "hair/groom/groom_size.h"
#include "hair/settings.h"
#include "hair/simulation/guide_solver.h"

namespace hair::simulation {

// Follow the leader: Verlet and the pull toward the rest position. Then, from the root down, every
// segment is restored to its length by moving only its lower end, and the upper end's velocity is
// corrected for it. Mueller, Kim and Chentanez 2012, Fast simulation of inextensible hair and fur.
// Exactly inextensible in one pass; no bending resistance. A pinned vertex below the root stays,
// and the segment that ends in it may change its length. The corrections are part of the previous
// positions.
class FtlSolver : public GuideSolver {
public:
    FtlSolver(
        const engine::Device& device, const groom::Groom& groom, const SimulationSettings& settings,
        const gpu::Step& step);

    static engine::MemoryRows
    rows(const engine::DeviceInfo&, const groom::GroomSize&, const SimulationSettings&) {
        return {"simulation", {{"ftl parameters", sizeof(gpu::FtlParameters)}}};
    }

    void record(engine::Commands& commands, gpu::SubstepPush push) const override;

private:
    std::uint32_t strand_count_;
    engine::Buffer parameters_;
    engine::ComputePipeline pipeline_;
};

// Calls the function of a file that the scene names as its solver: shaders/extension/solver.glsl.
// Its memory is its own state.
class ExtendedSolver : public GuideSolver {
public:
    // Throws engine::Error if the file was not read or does not compile.
    ExtendedSolver(
        const engine::Device& device, const groom::Groom& groom, const SimulationSettings& settings,
        const gpu::Step& step);

    static engine::MemoryRows rows(
        const engine::DeviceInfo& device, const groom::GroomSize& size,
        const SimulationSettings& settings);

    void record(engine::Commands& commands, gpu::SubstepPush push) const override;
    const engine::Buffer* memory() const override { return &memory_; }
    std::vector<const engine::Buffer*> state() const override { return {&memory_}; }

private:
    std::uint32_t strand_count_;
    engine::Buffer earlier_;
    engine::Buffer memory_;
    engine::Buffer parameters_;
    engine::ComputePipeline pipeline_;
};

// The list of solvers, for code that chooses one.

// Returns the memory of the settings' solver.
engine::MemoryRows solverRows(
    const engine::DeviceInfo& device, const groom::GroomSize& size,
    const SimulationSettings& settings);

// Makes the solver of the settings; null if nothing moves: `none` without keyframes or animation.
// Throws Unsupported for anything that the device can't do.
std::unique_ptr<GuideSolver> makeSolver(
    const engine::Device& device, const groom::Groom& groom, const SimulationSettings& settings,
    const gpu::Step& step);

// Returns /simulation/time_step and its /simulation/substeps; 0 substeps means the solver's own
// number.
gpu::Step stepOf(const SimulationSettings& settings);

}  // namespace hair::simulation
