// What the overlays' vertex stages share: lines that strands/strand.geom makes into quads.
#ifndef HAIRBENCH_OVERLAY_GLSL
#define HAIRBENCH_OVERLAY_GLSL

#include "common/picture.glsl"

layout(push_constant, scalar) uniform Push { OverlayPush push; };

layout(location = 0) out vec4 position_and_width;
layout(location = 1) out vec4 tangent_and_along;

const float kOverlayLift = 0.015;   // m
const float kOverlayWidth = 0.0015;  // m
const float kBodyWidth = 0.0008;

// Overlays are drawn a little nearer to the eye, so that hair does not hide its own guides but the
// head hides those behind it.
void emitLineEnd(PictureParameters picture, vec3 position, vec3 tangent, float width) {
    vec3 to_eye = picture.eye - position;
    vec3 lifted = position + to_eye * min(kOverlayLift / length(to_eye), 0.5);
    position_and_width = vec4(lifted, width);
    tangent_and_along = vec4(tangent, 0.0);
}

#endif
