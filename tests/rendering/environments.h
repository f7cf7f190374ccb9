#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "engine/float_pictures.h"

namespace hair::rendering {

// Turned about +y by the right-hand rule: +z goes to +x.
inline glm::dvec3 turned(const glm::dvec3& d, double turn) {
    return {
        d.x * std::cos(turn) + d.z * std::sin(turn), d.y,
        d.z * std::cos(turn) - d.x * std::sin(turn)};
}

// The direction of a place in the picture, with (0, 0) at its upper left and (1, 1) at its lower
// right. As in Mitsuba's envmap, u is atan2(x, -z) / 2 pi and v is acos(y) / pi.
inline glm::dvec3 directionOf(double u, double v) {
    const double azimuth = 2 * std::numbers::pi * u;
    const double polar = std::numbers::pi * v;
    return {
        std::sin(polar) * std::sin(azimuth), std::cos(polar), -std::sin(polar) * std::cos(azimuth)};
}

// A picture of this light, grey.
inline engine::FloatPixels
environmentOf(const std::function<double(const glm::dvec3&)>& light, std::uint32_t height = 128) {
    engine::FloatPixels picture{2 * height, height, {}};
    for (std::uint32_t row = 0; row < height; ++row) {
        for (std::uint32_t column = 0; column < 2 * height; ++column) {
            const double value =
                light(directionOf((column + 0.5) / (2 * height), (row + 0.5) / height));
            picture.rgb.insert(picture.rgb.end(), 3, static_cast<float>(value));
        }
    }
    return picture;
}

inline std::vector<glm::dvec3> someDirections() {
    std::vector<glm::dvec3> directions;
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z)
                if (x || y || z) directions.push_back(glm::normalize(glm::dvec3(x, y, z)));
    return directions;
}

}  // namespace hair::rendering
