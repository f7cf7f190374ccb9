#pragma once

#include <cmath>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/settings.h"
#include "tests/simulation/strands.h"

// Hands for tests.
namespace hair::simulation {

// A hand that stays in one place.
inline std::vector<PullKey> stays(const glm::vec3& place) {
    return {{.time = 0.0f, .position = place}, {.time = 1000.0f, .position = place}};
}

// A hand that moves straight from `start` at time 0. The velocity is in m/s.
inline std::vector<PullKey> goes(const glm::vec3& start, const glm::vec3& velocity) {
    return {
        {.time = 0.0f, .position = start}, {.time = 16.0f, .position = start + 16.0f * velocity}};
}

// A hand that jerks to and fro for a second: every 20 ms to a new place, 10 cm to either side.
inline std::vector<PullKey> jerks(const glm::vec3& centre) {
    std::vector<PullKey> path;
    std::mt19937 random(5);
    for (int i = 0; i <= 50; ++i)
        path.push_back(
            {.time = 0.02f * static_cast<float>(i),
             .position = centre + glm::vec3(0.1 * randomVector(random))});
    return path;
}

// Returns the distance of a free vertex from its hand, relative to the start. The vertex starts at
// the hand's velocity. The result is after n steps of implicit Euler on e'' = -k e - 2 sqrt(k) e'.
// Each step multiplies (e, dt e') by a matrix with the double eigenvalue 1 / (1 + s), s = sqrt(k)
// dt. Hence e_n = (A + B n) (1 + s)^-n; e_0 = 1 and e_1 = (1 + 2 s) / (1 + s)^2 give A and B. For
// small steps the limit is the critically damped (1 + w t) exp(-w t).
inline double approach(int n, double stiffness, double dt) {
    const double s = std::sqrt(stiffness) * dt;
    return (1.0 + n * s / (1.0 + s)) * std::pow(1.0 + s, -n);
}

// Several hands at once, for grooms with at least three strands of six vertices: two near each
// other on one strand, one of them stiff and jerking; one that holds a vertex alone; two that hold
// the same vertex; and one that starts later.
inline std::vector<PullSettings> manyPulls() {
    return {
        {.guide = 0,
         .vertex = 3,
         .radius = 0.05f,
         .stiffness = 400.0f,
         .path = stays({0.1f, 0, 0})},
        {.guide = 0, .vertex = 4, .radius = 0.1f, .stiffness = 1e5f, .path = jerks({0, 0.1f, 0})},
        {.guide = 1,
         .vertex = 5,
         .radius = 0.0f,
         .stiffness = 1000.0f,
         .path = goes({0, 0, 0}, {1, 2, 3})},
        {.guide = 2, .vertex = 2, .radius = 0.02f, .path = stays({0.1f, 0.1f, 0})},
        {.guide = 2, .vertex = 2, .radius = 10.0f, .path = stays({-0.1f, 0.1f, 0})},
        {.guide = 1,
         .vertex = 1,
         .radius = 1.0f,
         .path = {{.time = 500.0f, .position = {1, 1, 1}}, {.time = 501.0f}}},
        {.guide = 1, .vertex = 1, .path = {}}};
}

}  // namespace hair::simulation
