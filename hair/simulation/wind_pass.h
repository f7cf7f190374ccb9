#pragma once

#include <cstdint>

#include "engine/commands.h"
#include "engine/pipeline.h"
#include "hair/settings.h"

namespace hair {

// Throws Error for wind in a direction without length.
void checkWind(const WindSettings& settings);

// The acceleration that air gives every guide vertex, into a buffer of vec4 [strand][vertex],
// m/s^2. It is for a whole time step.
class WindPass {
public:
    // Throws what checkWind does.
    WindPass(
        const engine::Device& device, std::uint32_t vertex_count,
        const SimulationSettings& settings);

    // Other wind of the same mode, which checkWind has passed.
    void setWind(const WindSettings& settings) noexcept { settings_ = settings; }

    // `guides` is the address of gpu::GuideParameters.
    void record(
        engine::Commands& commands, std::uint64_t guides, std::uint64_t accelerations,
        double time) const;

    // The acceleration in air that stands still: none in thesis mode; in drag mode air brakes hair.
    void
    recordCalm(engine::Commands& commands, std::uint64_t guides, std::uint64_t accelerations) const;

private:
    void recordThesis(
        engine::Commands& commands, std::uint64_t guides, std::uint64_t accelerations,
        double magnitude) const;
    void recordDrag(
        engine::Commands& commands, std::uint64_t guides, std::uint64_t accelerations, double speed,
        double time) const;

    WindSettings settings_;
    MaterialSettings material_;
    std::uint32_t vertex_count_;
    engine::ComputePipeline pipeline_;
};

}  // namespace hair
