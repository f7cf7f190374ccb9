#pragma once

#include "hair/groom/groom.h"
#include "hair/reference/wind.h"
#include "hair/settings.h"
#include "tests/simulation/strands.h"

// Hair in air that nothing else acts on.
namespace hair::simulation {

inline SimulationSettings inAir(float time_step) {
    SimulationSettings settings = nothingActs();
    settings.time_step = time_step;
    settings.wind.mode = WindMode::drag;
    return settings;
}

inline SimulationSettings fallingThroughAir(float time_step) {
    SimulationSettings settings = inAir(time_step);
    settings.gravity = {0.0f, -9.8f, 0.0f};
    return settings;
}

// That the root is held reaches one vertex further with every step, so the tip falls freely and
// level for as many steps.
inline constexpr std::uint32_t kLevelVertices = 64;
inline constexpr int kFreeSteps = 60;

// A strand along +x.
inline groom::Groom levelHair() {
    groom::Groom groom{.strand_count = 1, .vertices_per_strand = kLevelVertices};
    for (std::uint32_t v = 0; v < kLevelVertices; ++v) groom.points.emplace_back(0.01f * v, 0, 0);
    return groom;
}

// Where drag bears the weight, by bisection, m/s.
inline double fallingSpeed(const SimulationSettings& settings) {
    const double weight = glm::length(glm::dvec3(settings.gravity));
    double slow = 0.0;
    double fast = 100.0;
    for (int i = 0; i < 60; ++i) {
        const double speed = (slow + fast) / 2.0;
        const bool bears =
            reference::dragAcceleration(settings.wind, settings.material, speed) > weight;
        (bears ? fast : slow) = speed;
    }
    return slow;
}

}  // namespace hair::simulation
