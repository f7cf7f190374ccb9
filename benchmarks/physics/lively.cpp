#include "benchmarks/physics/lively.h"

#include "benchmarks/physics/solver_settings.h"

namespace benchmarks::physics {

hair::SimulationSettings livelyHair(hair::Solver solver) {
    hair::SimulationSettings settings = defaultHair(solver);
    settings.wind.strength = 15.0f;  // the thesis's strongest
    settings.motion.keyframes = {
        {.time = 0.0f},
        {.time = 0.4f, .rotation = {0.0f, 60.0f, 0.0f}, .translation = {}},
        {.time = 0.8f, .rotation = {0.0f, -60.0f, 0.0f}, .translation = {0.1f, 0.0f, 0.0f}},
        {.time = 1.2f, .rotation = {40.0f, 0.0f, 0.0f}, .translation = {0.0f, -0.05f, 0.0f}},
        {.time = 1.6f}};
    return settings;
}

hair::Groom livelyGroom() {
    constexpr std::uint32_t kStrands = 16;
    const hair::Groom one = straightStrand(7, kLivelyLength, {0.0, -1.0, 0.0});
    hair::Groom groom = one;
    groom.strand_count = kStrands;
    groom.points.clear();
    for (std::uint32_t strand = 0; strand < kStrands; ++strand)
        for (const glm::vec3& point : one.points)
            groom.points.push_back(
                point + glm::vec3(0.01f * static_cast<float>(strand), 0.1f, 0.0f));
    return groom;
}

}  // namespace benchmarks::physics
