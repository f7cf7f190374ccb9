#include "hair/rendering/working_color.h"

#include <cmath>

namespace hair {

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

}  // namespace hair
