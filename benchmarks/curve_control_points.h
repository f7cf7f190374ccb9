#pragma once

#include <span>
#include <vector>

#include <glm/vec4.hpp>

namespace benchmarks {

// Control points of the uniform cubic B-spline that goes through `points`, the first at its start
// and the last at its end, with natural ends (no curvature there): two more than points. Of at
// least two points; four coordinates are four splines.
std::vector<glm::dvec4> interpolatingControlPoints(std::span<const glm::dvec4> points);

}  // namespace benchmarks
