#pragma once

#include <glm/vec3.hpp>

#include "benchmarks/viewer/tools/picking.h"
#include "hair/simulation_settings.h"

namespace benchmarks {

// The arrow that shows the wind: from the middle of the groom to where the wind blows. Its length
// grows with the logarithm of the wind, so that a breeze and a storm both fit a picture; it has one
// in still air too, so that it can be held.

// What the arrow's length is: strength, m/s^2, or in drag mode the mean speed, m/s.
float windOf(const hair::WindSettings& wind);
const char* windUnit(const hair::WindSettings& wind);

glm::vec3 windDirection(const hair::WindSettings& wind);  // unit length

// Where the arrow of a groom ends.
glm::vec3 windTip(const hair::WindSettings& wind, const Sphere& groom);

// Makes the wind one whose arrow ends there; a tip at the middle leaves its direction.
void setWindTip(hair::WindSettings& wind, const Sphere& groom, const glm::vec3& tip);
void setWind(hair::WindSettings& wind, float value);

}  // namespace benchmarks
