#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

// Reflection of a surface by glTF 2.0, appendix B, with the shadowing of Walter et al. 2007,
// Microfacet models for refraction through rough surfaces, eq. 34, as tangents.
namespace hair::reference {

struct Surface {
    glm::dvec3 base_color;  // linear
    double metallic;
    double roughness;
};

inline double shadowing(double cosine, double alpha) {
    const double tangent = std::sqrt(1.0 - cosine * cosine) / cosine;
    return 2.0 / (1.0 + std::sqrt(1.0 + alpha * alpha * tangent * tangent));
}

inline glm::dvec3 surfaceBrdf(
    const Surface& surface, const glm::dvec3& normal, const glm::dvec3& to_eye,
    const glm::dvec3& to_light) {
    const double light = glm::dot(normal, to_light);
    const double eye = glm::dot(normal, to_eye);
    if (light <= 0.0) return glm::dvec3(0.0);
    const double alpha = surface.roughness * surface.roughness;
    const glm::dvec3 half = glm::normalize(to_eye + to_light);
    const double cosine = std::min(glm::dot(normal, half), 1.0);
    const double tangent_squared = 1.0 / (cosine * cosine) - 1.0;
    // Walter et al. 2007, eq. 33.
    const double distribution =
        alpha * alpha /
        (std::numbers::pi * std::pow(cosine, 4.0) * std::pow(alpha * alpha + tangent_squared, 2.0));
    const double specular =
        distribution * shadowing(light, alpha) * shadowing(eye, alpha) / (4.0 * light * eye);
    const double grazing = std::pow(1.0 - glm::dot(to_eye, half), 5.0);
    const double of_dielectric = 0.04 + 0.96 * grazing;
    const glm::dvec3 of_metal = surface.base_color + (1.0 - surface.base_color) * grazing;
    const glm::dvec3 dielectric =
        (1.0 - of_dielectric) * surface.base_color / std::numbers::pi + of_dielectric * specular;
    return glm::mix(dielectric, of_metal * specular, surface.metallic);
}

}  // namespace hair::reference
