#pragma once

#include <glm/vec3.hpp>

#include "hair/settings.h"

// The colours that a picture is worked out in.
namespace hair {

// Whether they are linear RGB with sRGB's primaries; display RGB, as in the thesis, otherwise.
inline bool hasLinearLight(const RenderSettings& render) {
    return render.tone_map != ToneMap::none;
}

// sRGB's curve (IEC 61966-2-1), channel by channel.
glm::dvec3 toLinear(const glm::dvec3& display);
glm::dvec3 toDisplay(const glm::dvec3& linear);

// A setting's display RGB as the picture's working colour.
glm::vec3 workingColor(const RenderSettings& render, const glm::vec3& display);

}  // namespace hair
