#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/random.h"
#include "hair/shading_settings.h"

// Fibres and directions to test their scattering with.
namespace hair::rendering {

constexpr float kRoughnesses[]{0.1f, 0.3f, 0.5f, 0.7f, 0.9f};

// A fibre that absorbs nothing and has flat scales.
inline ShadingSettings whiteFiber(float longitudinal_roughness, float azimuthal_roughness) {
    ShadingSettings shading;
    shading.color = {1.0f, 1.0f, 1.0f};
    shading.cuticle_tilt = 0.0f;
    shading.longitudinal_roughness = longitudinal_roughness;
    shading.azimuthal_roughness = azimuthal_roughness;
    return shading;
}

inline ShadingSettings brownFiber() {
    ShadingSettings shading;
    shading.color_from = ColorSource::melanin;
    shading.eumelanin = 0.3f;
    return shading;
}

inline glm::dvec3 direction(double sin_theta, double phi) {
    const double cos_theta = std::sqrt(1 - sin_theta * sin_theta);
    return {sin_theta, cos_theta * std::cos(phi), cos_theta * std::sin(phi)};
}

struct FiberSample {
    glm::dvec3 wi;
    double h;
};

// Places across a fibre and directions to it, uniform in both: lattices with random origins, one
// for each place. Their steps are at most 1.2 standard deviations of the narrowest lobe of these
// widths.
inline std::vector<FiberSample>
uniformSamples(float longitudinal_roughness, float azimuthal_roughness) {
    constexpr int kPlaces = 4;
    const int rows = longitudinal_roughness < 0.2f ? 96 : 32;
    const int columns = azimuthal_roughness < 0.2f ? 128 : 48;
    std::vector<FiberSample> samples;
    for (int k = 0; k < kPlaces; ++k) {
        for (int i = 0; i < rows; ++i) {
            const auto line = static_cast<std::uint32_t>(k * rows + i);
            const double row = i + random01(7, static_cast<std::uint32_t>(k), 0);
            const double h = 2 * (k + random01(7, line, 1)) / kPlaces - 1;
            for (int j = 0; j < columns; ++j) {
                const double column = j + random01(7, line, 2);
                const double phi = 2 * std::numbers::pi * column / columns;
                samples.push_back({direction(2 * row / rows - 1, phi), h});
            }
        }
    }
    return samples;
}

}  // namespace hair::rendering
