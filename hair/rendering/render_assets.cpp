#include "hair/rendering/render_assets.h"

#include <algorithm>
#include <cmath>
#include <numbers>

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

// ---- Wet hair -----------------------------------------------------------------------------------

constexpr double kWaterIndex = 1.333;
constexpr double kWaterDensity = 1000.0;  // kg/m^3
constexpr double kSmoothest = 0.05;  // the least longitudinal roughness that may be set

// Returns the part of the hair that its water covers.
double coveredPart(const MaterialSettings& material) {
    const double filling = (4.0 / std::numbers::pi - 1.0) * kWaterDensity / material.density;
    return std::min(material.water / filling, 1.0);
}

// Returns the reflectance of a surface with this relative index, at normal incidence.
double normalReflectance(double index) {
    const double root = (index - 1.0) / (index + 1.0);
    return root * root;
}

// Returns the index of a surface with this reflectance at normal incidence.
double indexOf(double reflectance) {
    const double root = std::sqrt(reflectance);
    return (1.0 + root) / (1.0 - root);
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

Settings wetted(Settings settings) {
    const double covered = coveredPart(settings.simulation.material);
    if (covered == 0.0) return settings;
    ShadingSettings& shading = settings.shading;
    const double returned = covered * (1.0 - 1.0 / (kWaterIndex * kWaterIndex));
    const glm::dvec3 dry = linearColor(shading);
    shading.color = toDisplay((1.0 - returned) * dry / (1.0 - returned * dry));
    shading.color_from = ColorSource::rgb;

    const double index = shading.refractive_index;
    const double outer = normalReflectance(kWaterIndex);
    const double inner = normalReflectance(index / kWaterIndex);
    const double film = outer + (1.0 - outer) * (1.0 - outer) * inner / (1.0 - outer * inner);
    const double wet_index = std::lerp(index, indexOf(film), covered);
    const double narrowed = std::lerp(1.0, std::abs(index - kWaterIndex) / (index - 1.0), covered);
    const auto scale = [](float& value, double factor) {
        value = static_cast<float>(value * factor);
    };
    // Specular light over its width, in the one direction in which cones of highlights have one.
    scale(shading.specular, normalReflectance(wet_index) / normalReflectance(index) / narrowed);
    scale(shading.exponent, 1.0 / (narrowed * narrowed));
    shading.longitudinal_roughness =
        static_cast<float>(std::max(shading.longitudinal_roughness * narrowed, kSmoothest));
    scale(shading.cuticle_tilt, narrowed);
    shading.refractive_index = static_cast<float>(wet_index);
    return settings;
}

}  // namespace hair::rendering
