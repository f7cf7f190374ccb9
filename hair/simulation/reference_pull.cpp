#include "hair/simulation/reference_pull.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace hair::reference {

namespace {

glm::dvec3 handAt(const std::vector<PullKey>& path, double time) {
    glm::dvec3 place = path.front().position;
    for (std::size_t i = 1; i < path.size(); ++i) {
        const double start = path[i - 1].time;
        const double end = path[i].time;
        if (time <= start) break;
        const glm::dvec3 way = glm::dvec3(path[i].position) - glm::dvec3(path[i - 1].position);
        place =
            glm::dvec3(path[i - 1].position) + std::fmin(1.0, (time - start) / (end - start)) * way;
    }
    return place;
}

bool pullsIn(const std::vector<PullKey>& path, double from, double to) {
    if (path.empty()) return false;
    const double middle = (from + to) / 2.0;
    return double{path.front().time} <= middle && middle <= double{path.back().time};
}

}  // namespace

// The held vertex's velocity at the step's end solves
//   v' = v + dt f + dt (k (h' - x - dt v') + c (w - v')),
// and the hand's part is what f leaves of it.
void addPulls(
    std::span<const PullSettings> pulls, const PulledHair& hair,
    std::span<glm::dvec3> accelerations) {
    const double dt = hair.to - hair.from;
    for (const PullSettings& pull : pulls) {
        if (!pullsIn(pull.path, hair.from, hair.to)) continue;
        const std::size_t held = pull.guide * hair.vertices + pull.vertex;
        const double k = pull.stiffness;
        const double c = 2.0 * std::sqrt(k);
        const glm::dvec3 hand = handAt(pull.path, hair.to);
        const glm::dvec3 w = (hand - handAt(pull.path, hair.from)) / dt;
        const glm::dvec3 x = hair.positions[held];
        const glm::dvec3 v = (x - hair.previous[held]) / hair.substep;
        const glm::dvec3 f = accelerations[held];
        const glm::dvec3 end =
            (v + dt * f + dt * k * (hand - x) + dt * c * w) / (1.0 + dt * c + dt * dt * k);
        const glm::dvec3 acceleration = (end - v) / dt - f;
        for (std::size_t i = 0; i < accelerations.size(); ++i) {
            if (i % hair.vertices == 0) continue;
            const double d = glm::distance(hair.rest[i], hair.rest[held]);
            const double r = pull.radius;
            if (i == held)
                accelerations[i] += acceleration;
            else if (r > 0.0)
                accelerations[i] += std::exp(-(d * d) / (r * r)) * acceleration;
        }
    }
}

}  // namespace hair::reference
