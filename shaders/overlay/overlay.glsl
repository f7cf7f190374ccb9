// Common code of the overlays' vertex stages. Lines are quads that face the camera, with six
// vertices each. Strands get their quads from a geometry stage, which not every device has.
#ifndef HAIRBENCH_OVERLAY_GLSL
#define HAIRBENCH_OVERLAY_GLSL

#include "common/picture.glsl"

layout(push_constant, scalar) uniform Push { OverlayPush push; };

const float kOverlayLift = 0.015;   // m
const float kOverlayWidth = 0.0015;  // m
const float kBodyWidth = 0.0008;
const float kGuidePixels = 2.0;  // maximum width of guides, so that near guides are thin too
const float kAnyPixels = 1e9;

// Corners of a quad's two triangles. Each number encodes the line's end and side.
const uint kCorners[6] = uint[](0u, 1u, 2u, 1u, 3u, 2u);

uint lineIndex() { return uint(gl_VertexIndex) / 6u; }

// Overlays are drawn a little nearer to the eye. Hair then does not hide its own guides, but the
// head hides the guides behind it. Lines are `width` metres or `pixels` wide, whichever is less.
void emitCorner(PictureParameters picture, vec3 from, vec3 to, float width, float pixels) {
    uint corner = kCorners[uint(gl_VertexIndex) % 6u];
    vec3 position = corner < 2u ? from : to;
    vec3 to_eye = picture.eye - position;
    vec3 lifted = position + to_eye * min(kOverlayLift / length(to_eye), 0.5);
    vec3 side = cross(picture.eye - lifted, to - from);
    width = min(width, pixels * (picture.pixel_near + picture.pixel_slope * length(to_eye)));
    side *= 0.5 * width * inversesqrt(max(dot(side, side), 1e-30));
    float across = corner % 2u == 0u ? -1.0 : 1.0;
    gl_Position = picture.view_projection * vec4(lifted + across * side, 1.0);
}

#endif
