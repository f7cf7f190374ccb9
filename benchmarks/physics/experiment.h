#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/device.h"
#include "hair/groom/groom.h"
#include "hair/settings.h"
#include "hair/simulation/simulation.h"

namespace benchmarks::physics {

// A strand in `segments` equal segments from the origin along a unit vector, at rest. m
hair::Groom straightStrand(std::uint32_t segments, double length, const glm::dvec3& direction);

// One that is `length` long and constantly curved (1/m) from -y toward +x. Its vertices lie on the
// circle.
hair::Groom curvedStrand(std::uint32_t segments, double length, double curvature);

// A groom in a simulation that is played step by step. Throws Interrupted (measure.h) between
// submissions when the user asked to stop. Borrows the device.
class Experiment {
public:
    Experiment(
        const engine::Device& device, const hair::Groom& groom,
        const hair::SimulationSettings& settings);

    void advance(std::uint32_t steps);

    // Steps until no vertex moves by more than `distance` in a tenth of a second; false if that
    // takes longer than `seconds`.
    bool settle(double distance, double seconds);

    // At these positions without velocity.
    void place(std::span<const glm::dvec3> positions);
    // With these velocities; both one substep ago. m/s
    void launch(std::span<const glm::dvec3> positions, std::span<const glm::dvec3> velocities);
    void pin(std::uint32_t vertex);

    std::vector<glm::dvec3> positions() const;

    double timeStep() const { return settings_.time_step; }
    double substep() const { return substep_; }
    // In this time, at least one.
    std::uint32_t stepsIn(double seconds) const;

private:
    const engine::Device* device_;
    hair::SimulationSettings settings_;
    double substep_;
    hair::Simulation simulation_;
};

// Greatest distance between points of the same index, m.
double greatestDistance(std::span<const glm::dvec3> a, std::span<const glm::dvec3> b);

}  // namespace benchmarks::physics
