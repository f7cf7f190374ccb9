#pragma once

#include <glm/vec3.hpp>

namespace benchmarks::physics {

// Where n steps of Verlet's integration take a point that came with `velocity`: n v h + n (n + 1) /
// 2 a h^2, the sum of the displacements (v + m a h) h. Exact, where the true parabola has n^2.
inline glm::dvec3
verletFlight(double n, const glm::dvec3& velocity, const glm::dvec3& acceleration, double step) {
    return n * step * velocity + 0.5 * n * (n + 1.0) * step * step * acceleration;
}

}  // namespace benchmarks::physics
