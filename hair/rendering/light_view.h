#pragma once

#include <cstdint>

#include <glm/mat4x4.hpp>

#include "hair/rendering/shadow_bounds.h"
#include "hair/settings.h"

namespace hair {

// How a light looks at what it lights: a perspective view of all that it is to see, or a parallel
// one of directional lights.
struct LightView {
    glm::mat4 view_projection;  // world -> clip, depth 0 near to 1 far
    glm::vec3 eye;  // m; of a directional light far away
    glm::vec4 depth_terms;  // as in gpu::ShadowMap
    float texel_near;  // m, as in gpu::ShadowMap
    float texel_slope;
};

// A map of side x side texels shows bounds.seen and `margin` texels round it. Where the light is in
// it, or so near that it would see it under more than 150 degrees, the map shows 150 degrees round
// its centre, and what is beyond throws no shadow. Neither does what is nearer to a point light
// than a hundredth of the far end of bounds.range: depth would be too coarse.
LightView
lightView(const LightSettings& light, const ShadowBounds& bounds, std::uint32_t side, float margin);

}  // namespace hair
