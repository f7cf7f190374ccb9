#include "benchmarks/viewer/tools/wind_arrow.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "benchmarks/viewer/tools/field_limits.h"

namespace benchmarks {

namespace {

// Lengths in radii of the groom.
constexpr float kStill = 0.35f;
constexpr float kDoubling = 0.4f;  // more for every doubling of the wind that is strong

// From which wind on doubling it makes the arrow so much longer: a light breeze.
float breeze(const hair::WindSettings& wind) {
    return wind.mode == hair::WindMode::drag ? 2.0f : 3.0f;  // m/s; m/s^2
}

}  // namespace

float windOf(const hair::WindSettings& wind) {
    return wind.mode == hair::WindMode::drag ? wind.speed : wind.strength;
}

const char* windUnit(const hair::WindSettings& wind) {
    return wind.mode == hair::WindMode::drag ? "m/s" : "m/s²";
}

glm::vec3 windDirection(const hair::WindSettings& wind) {
    const float length = glm::length(wind.direction);
    return length > 0.0f ? wind.direction / length : glm::vec3{1, 0, 0};
}

glm::vec3 windTip(const hair::WindSettings& wind, const Sphere& groom) {
    const float radii = kStill + kDoubling * std::log2(1.0f + windOf(wind) / breeze(wind));
    return groom.center + windDirection(wind) * (radii * groom.radius);
}

void setWindTip(hair::WindSettings& wind, const Sphere& groom, const glm::vec3& tip) {
    const glm::vec3 arrow = tip - groom.center;
    const float radii = glm::length(arrow) / groom.radius;
    if (radii > 0.01f) wind.direction = glm::normalize(arrow);
    setWind(wind, breeze(wind) * (std::exp2(std::max(radii - kStill, 0.0f) / kDoubling) - 1.0f));
}

void setWind(hair::WindSettings& wind, float value) {
    if (wind.mode == hair::WindMode::drag)
        wind.speed = allowed(&hair::WindSettings::speed, value);
    else
        wind.strength = allowed(&hair::WindSettings::strength, value);
    // A wind that blows needs somewhere to blow to.
    if (windOf(wind) > 0.0f) wind.direction = windDirection(wind);
}

}  // namespace benchmarks
