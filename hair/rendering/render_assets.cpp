#include "hair/rendering/render_assets.h"

#include <algorithm>
#include <cmath>

namespace hair::rendering {
namespace {

// d'Eon et al. 2011, An energy-conserving hair reflectance model, section 6.1.
constexpr glm::dvec3 kEumelanin{0.419, 0.697, 1.37};
constexpr glm::dvec3 kPheomelanin{0.187, 0.4, 1.05};

// The denominator of equation (9): ln colour = -scale sqrt(sigma_a).
double colorScale(const ShadingSettings& shading) {
    const double b = shading.azimuthal_roughness;
    return 5.969 + b * (-0.215 + b * (2.532 + b * (-10.73 + b * (5.574 + b * 0.245))));
}

glm::dvec3 pigmentAbsorption(const ShadingSettings& shading) {
    return static_cast<double>(shading.eumelanin) * kEumelanin +
           static_cast<double>(shading.pheomelanin) * kPheomelanin;
}

}  // namespace

// ---- Working colours ----------------------------------------------------------------------------

glm::dvec3 toLinear(const glm::dvec3& display) {
    glm::dvec3 linear;
    for (int i = 0; i < 3; ++i) {
        linear[i] = display[i] <= 0.04045 ? display[i] / 12.92
                                          : std::pow((display[i] + 0.055) / 1.055, 2.4);
    }
    return linear;
}

glm::dvec3 toDisplay(const glm::dvec3& linear) {
    glm::dvec3 display;
    for (int i = 0; i < 3; ++i) {
        display[i] = linear[i] <= 0.0031308 ? 12.92 * linear[i]
                                            : 1.055 * std::pow(linear[i], 1 / 2.4) - 0.055;
    }
    return display;
}

glm::vec3 workingColor(const RenderSettings& render, const glm::vec3& display) {
    return hasLinearLight(render) ? glm::vec3(toLinear(display)) : display;
}

// ---- The colour of hair -------------------------------------------------------------------------

glm::dvec3 absorption(const ShadingSettings& shading) {
    if (shading.color_from == ColorSource::melanin) return pigmentAbsorption(shading);
    const glm::dvec3 color = toLinear(shading.color);
    glm::dvec3 absorbed;
    for (int i = 0; i < 3; ++i) {
        const double root = std::log(std::clamp(color[i], 1e-4, 1.0)) / colorScale(shading);
        absorbed[i] = root * root;
    }
    return absorbed;
}

glm::dvec3 linearColor(const ShadingSettings& shading) {
    if (shading.color_from == ColorSource::rgb) return toLinear(shading.color);
    const glm::dvec3 absorbed = pigmentAbsorption(shading);
    glm::dvec3 color;
    for (int i = 0; i < 3; ++i) color[i] = std::exp(-colorScale(shading) * std::sqrt(absorbed[i]));
    return color;
}

}  // namespace hair::rendering
