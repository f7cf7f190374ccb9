#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "engine/device.h"
#include "engine/pipeline.h"
#include "hair/gpu_structs.h"
#include "hair/groom/groom.h"
#include "hair/groom/groom_size.h"
#include "hair/settings.h"
#include "hair/simulation/guide_solver.h"

// Measures guides: checks of one state, and probes over time.
namespace hair::simulation {

// ---- Checks of a state: stretched, inside a body, still moving ----------------------------------

// The worst value of one kind over all guides.
struct Worst {
    double value = 0.0;
    std::uint32_t guide = 0;  // guide with this value
    std::uint32_t guides = 0;  // guides with a vertex beyond the limit
};

struct GuideCondition {
    Worst stretch;  // of a segment, over its rest length
    Worst depth;  // of a vertex in a body, ignoring the margin, m; 0: none is inside
    Worst speed;  // of a vertex, m/s
};

struct ConditionLimits {
    double stretch = 1.05;
    double depth = 1e-4;  // m
    double speed = 0.01;  // m/s
};

// Returns the worst of [strand][vertex] vertices. NaN counts as worse than any number.
GuideCondition worstOf(
    std::span<const gpu::VertexCondition> vertices, std::uint32_t vertices_per_strand,
    double substep, const ConditionLimits& limits = {});

// A vertex at a place that no valid simulation of hair reaches.
struct BrokenVertex {
    std::uint32_t guide = 0;
    std::uint32_t vertex = 0;
    double stretch = 0.0;  // of the guide up to this vertex, over its length at rest; NaN: no
                           // position
};

// Returns the first guide's vertex that has no finite position or that is farther along the guide
// than `most_stretch` times its distance along the guide at rest. Both spans are [strand][vertex],
// m.
std::optional<BrokenVertex> findBroken(
    std::span<const glm::vec3> positions, std::span<const glm::vec3> rest,
    std::uint32_t vertices_per_strand, double most_stretch);

// Returns the stretch of whole guides beyond which a simulation with these settings has failed.
double mostStretch(const SimulationSettings& settings);

// Inspects the `count` vertices of gpu::GuideParameters, with the head at `frame`. Waits for the
// device.
std::vector<gpu::VertexCondition> inspectVertices(
    const engine::Device& device, gpu::Address guides, const gpu::RigidFrame& frame,
    std::uint32_t count);

// ---- Probes over time ---------------------------------------------------------------------------

// Whether any probe is wanted.
bool hasProbes(const ProbeSettings& settings);

// Probes: quantities of guides, computed on the device in each frame beside the state, which they
// never change. docs/physics.md defines them. Values of a frame stay on the device until read(), so
// that no frame waits.
class Probes {
public:
    // For `most_frames` frames. groom_distance measures to the `reference`, m, with as many points
    // as the groom; null: to the groom. Throws Error if /run/probes names guides that the groom
    // lacks.
    Probes(
        const engine::Device& device, const groom::Groom& groom, const SimulationSettings& settings,
        const ProbeSettings& probes, std::uint32_t most_frames,
        const groom::StrandSet* reference = nullptr);

    static engine::MemoryRows rows(
        const groom::GroomSize& size, Solver solver, const ProbeSettings& probes,
        std::uint32_t most_frames);

    // Names of the values of a frame, as in a report without its "probe.": "length_error.mean".
    static std::vector<std::string> names(const ProbeSettings& probes, Solver solver);

    // Records the values of the next frame. Equal guides give equal bits.
    void record(engine::Commands& commands, const ProbedGuides& guides);

    // Forgets the recorded frames.
    void restart() { frames_ = 0; }

    // Returns the values of all recorded frames, [value][frame], in the units of docs/physics.md.
    // Waits for the device.
    std::vector<std::vector<double>> read() const;

private:
    const engine::Device* device_;
    std::uint32_t first_guide_;
    std::uint32_t guide_count_;
    std::uint32_t quantities_ = 0;
    float line_density_;  // kg/m
    std::uint32_t most_frames_;
    std::uint32_t frames_ = 0;  // recorded
    std::uint32_t results_per_frame_;
    engine::Buffer rest_;  // vec4 [strand][vertex], m; w: mass, kg
    engine::Buffer reference_;  // vec4 [strand][vertex], m; none: rest_
    engine::Buffer rows_;  // float [row][guide]
    engine::Buffer wanted_;  // gpu::ProbeResult [result]
    engine::Buffer results_;  // float [frame][result]
    engine::ComputePipeline guides_;
    engine::ComputePipeline reduce_;
};

}  // namespace hair::simulation
