#pragma once

#include <algorithm>

#include "tests/rendering/transparency/straight_strands.h"

// Broad upright strands behind one another, each of another grey. The expected value of a pixel in
// their middle comes from McGuire and Bavoil's equations and from "over", in double precision.
namespace hair::rendering {

struct Layer {
    double depth;  // m towards the eye
    double gray;
};

inline constexpr float kLayerWidth = 0.06f;  // m
inline constexpr glm::dvec3 kLayerLight{0.3, 0.0, 0.05};

inline glm::dvec3 layerEye() { return {0.0, 0.0, double{eyeDistance()}}; }

// Lit by nearby diffuse light, so that each depth has its own grey.
inline Settings layered(float opacity) {
    Settings settings = whiteStrands(1.0);
    settings.strands.root_width = settings.strands.tip_width = kLayerWidth;
    settings.strands.opacity = opacity;
    settings.shading.ambient = 0.0f;
    settings.shading.diffuse = 1.0f;
    settings.shading.lights = {{.position = glm::vec3(kLayerLight)}};
    settings.render.background = glm::vec3(0.2f);
    return settings;
}

inline std::vector<Line> layerLines(const std::vector<double>& depths) {
    std::vector<Line> lines;
    for (const double depth : depths) {
        const auto z = static_cast<float>(depth);
        lines.push_back({{0.0f, -0.08f, z}, {0.0f, 0.08f, z}});
    }
    return lines;
}

// At the ray through the picture's centre, a corner of four pixels, the layers' normals point to
// the eye.
inline std::vector<Layer> layersInTheMiddle(const std::vector<double>& depths) {
    std::vector<Layer> layers;
    for (const double depth : depths) {
        const glm::dvec3 to_light = glm::normalize(kLayerLight - glm::dvec3(0, 0, depth));
        layers.push_back({depth, std::max(to_light.z, 0.0)});
    }
    return layers;
}

inline double over(std::vector<Layer> layers, double opacity, double background) {
    std::ranges::sort(layers, {}, &Layer::depth);  // far to near
    double gray = background;
    for (const Layer& layer : layers) gray = opacity * layer.gray + (1 - opacity) * gray;
    return gray;
}

// Equations (6) and (10); depth goes from 0 to 1 through a sphere round the strands.
inline double weighted(
    const std::vector<Layer>& layers, double opacity, double background,
    const glm::dvec3& sphere_centre, double sphere_radius) {
    double sum = 0.0;
    double weights = 0.0;
    double revealed = 1.0;
    const double front = glm::distance(layerEye(), sphere_centre) - sphere_radius;
    for (const Layer& layer : layers) {
        const double distance = layerEye().z - layer.depth;
        const double d = std::clamp((distance - front) / (2 * sphere_radius), 0.0, 1.0);
        const double weight = opacity * std::max(1e-2, 3e3 * std::pow(1 - d, 3));
        sum += layer.gray * opacity * weight;
        weights += opacity * weight;
        revealed *= 1 - opacity;
    }
    return sum / weights * (1 - revealed) + background * revealed;
}

// The mean of the four pixels round the centre: differences from side to side cancel out.
inline double middle(const Pixels& pixels) {
    double sum = 0.0;
    for (const std::uint32_t y : {kSide / 2 - 1, kSide / 2}) {
        for (const std::uint32_t x : {kSide / 2 - 1, kSide / 2})
            sum += pixels[4 * (y * kSide + x)] / 4.0;
    }
    return sum / 255.0;
}

}  // namespace hair::rendering
