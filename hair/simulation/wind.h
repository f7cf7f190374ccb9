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

// Wind from the settings, and its acceleration of every guide vertex.
namespace hair::simulation {

// Returns the wind's direction, a unit vector. Throws Error for a direction without length.
glm::dvec3 windDirection(const WindSettings& settings);

// Returns four unit vectors at `cone_angle` from the wind's direction d, 90 degrees apart round it:
// toward u, v, -u and -v, with u = perpendicular(d) and v = d x u. Throws Error for a direction
// without length.
std::array<glm::dvec3, 4> windCone(const WindSettings& settings);

// Thesis eq. 13 with simulated time instead of the frame number: sin^2(gust_rate time) + 0.5.
double windMagnitude(const WindSettings& settings, double time);

// gpu::AirDrag in double precision.
struct DragFactors {
    double inertial;
    double viscous;
};
DragFactors dragFactors(const WindSettings& settings, const MaterialSettings& material);

// Air that drags guides in every substep of a solver: shaders/simulation/air_drag.glsl.
struct AirAtGuides {
    const engine::Buffer* velocities = nullptr;  // vec4 [strand][vertex], m/s; null: no drag
    gpu::AirDrag drag{};
};

// Throws Error for wind with a direction without length.
void checkWind(const WindSettings& settings);

// The effect of air on every guide vertex in a time step. Thesis mode writes an acceleration to
// GuideAddresses::accelerations. Drag mode writes none; solvers apply the drag of air(). The caller
// orders earlier and later work.
class WindPass {
public:
    // Throws like checkWind.
    WindPass(
        const engine::Device& device, std::uint32_t vertex_count,
        const SimulationSettings& settings);

    // `settings` must have the same mode and have passed checkWind.
    void setWind(const WindSettings& settings) noexcept { settings_ = settings; }

    void record(engine::Commands& commands, const GuideAddresses& guides, double time) const;

    // Records still air instead. In thesis mode still air has no effect.
    void recordCalm(engine::Commands& commands, const GuideAddresses& guides) const;

    // Returns the air, which stands still until something is recorded; without velocities in thesis
    // mode. Valid as long as the pass.
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
