#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include <glm/vec3.hpp>

#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "engine/pipeline.h"
#include "hair/gpu_structs.h"
#include "hair/settings.h"
#include "hair/simulation/guide_view.h"

// The wind: by the settings, and as the acceleration of every guide vertex.
namespace hair::simulation {

// The wind's direction, a unit vector. Throws Error for a direction without length.
glm::dvec3 windDirection(const WindSettings& settings);

// Four unit vectors at `cone_angle` from the wind's direction d, 90 degrees apart round it: toward
// u, v, -u and -v, where u = perpendicular(d) and v = d x u. A direction without length throws
// Error.
std::array<glm::dvec3, 4> windCone(const WindSettings& settings);

// Thesis eq. 13 with simulated time instead of the frame's number: sin^2(gust_rate time) + 0.5.
double windMagnitude(const WindSettings& settings, double time);

// gpu::AirDrag in double.
struct DragFactors {
    double inertial;
    double viscous;
};
DragFactors dragFactors(const WindSettings& settings, const MaterialSettings& material);

// The air that brakes guides in every substep of a solver: shaders/simulation/air_drag.glsl.
struct AirAtGuides {
    const engine::Buffer* velocities = nullptr;  // vec4 [strand][vertex], m/s; null: none brakes
    gpu::AirDrag drag{};
};

// Throws Error for wind in a direction without length.
void checkWind(const WindSettings& settings);

// What air does to every guide vertex in a time step: in thesis mode an acceleration, into
// GuideAddresses::accelerations; in drag mode there is none, and air() is what solvers brake with.
// The caller orders the work before and after.
class WindPass {
public:
    // Throws what checkWind does.
    WindPass(
        const engine::Device& device, std::uint32_t vertex_count,
        const SimulationSettings& settings);

    // `settings` are of the same mode, and checkWind has passed them.
    void setWind(const WindSettings& settings) noexcept { settings_ = settings; }

    void record(engine::Commands& commands, const GuideAddresses& guides, double time) const;

    // The same in air that stands still, where in thesis mode nothing acts.
    void recordCalm(engine::Commands& commands, const GuideAddresses& guides) const;

    // Stands still until something is recorded; of no velocities in thesis mode. Valid as long as
    // the pass.
    AirAtGuides air() const;

private:
    void
    recordThesis(engine::Commands& commands, const GuideAddresses& guides, double magnitude) const;
    void recordAir(
        engine::Commands& commands, const GuideAddresses& guides, double speed, double time) const;

    WindSettings settings_;
    MaterialSettings material_;
    std::uint32_t vertex_count_;
    engine::ComputePipeline pipeline_;
    std::optional<engine::Buffer> air_;  // in drag mode
};

}  // namespace hair::simulation
