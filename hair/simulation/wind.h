#pragma once

#include <array>
#include <cstdint>

#include <glm/vec3.hpp>

#include "engine/commands.h"
#include "engine/pipeline.h"
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

// Air with the velocity u across a hair accelerates it by (inertial |u| + viscous |u|^(1/3)) u.
struct DragFactors {
    double inertial;  // rho_air / (pi r rho), 1/m
    double viscous;   // 10 (mu / (rho_air 2 r))^(2/3) of that, m^(-1/3) s^(-2/3)
};
DragFactors dragFactors(const WindSettings& settings, const MaterialSettings& material);

// Throws Error for wind in a direction without length.
void checkWind(const WindSettings& settings);

// The acceleration that air gives every guide vertex, into GuideAddresses::accelerations. It is for
// a whole time step. The caller orders the work before and after.
class WindPass {
public:
    // Throws what checkWind does.
    WindPass(
        const engine::Device& device, std::uint32_t vertex_count,
        const SimulationSettings& settings);

    // `settings` are of the same mode, and checkWind has passed them.
    void setWind(const WindSettings& settings) noexcept { settings_ = settings; }

    void record(engine::Commands& commands, const GuideAddresses& guides, double time) const;

    // The acceleration in air that stands still: none in thesis mode; in drag mode air brakes hair.
    void recordCalm(engine::Commands& commands, const GuideAddresses& guides) const;

private:
    void
    recordThesis(engine::Commands& commands, const GuideAddresses& guides, double magnitude) const;
    void recordDrag(
        engine::Commands& commands, const GuideAddresses& guides, double speed, double time) const;

    WindSettings settings_;
    MaterialSettings material_;
    std::uint32_t vertex_count_;
    engine::ComputePipeline pipeline_;
};

}  // namespace hair::simulation
