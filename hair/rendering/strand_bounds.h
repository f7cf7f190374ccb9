#pragma once

#include <glm/vec3.hpp>

#include "hair/groom/groom.h"
#include "hair/settings.h"

namespace hair {

struct Sphere {
    glm::vec3 centre{0.0f};  // m
    float radius = 0.0f;     // m
};

// A sphere that strands can't leave however they hang, but for what solvers stretch them: about
// their roots, as far as they are long.
Sphere strandBounds(const Groom& groom, const StrandSettings& settings);

}  // namespace hair
