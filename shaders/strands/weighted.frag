#version 460
// Draws a strand's quad for order-independent summation: McGuire and Bavoil 2013, Weighted blended
// order-independent transparency, JCGT 2(2).
#extension GL_GOOGLE_include_directive : require
#include "strands/fragment.glsl"

layout(buffer_reference, scalar) readonly buffer Range { BlendRange range; };

layout(location = 0) out vec4 weighted;  // colour and alpha, both times alpha and weight; added
layout(location = 1) out float hidden;  // the part of the background that this fragment hides

// Equation (10), with a depth from 0 to 1 through the hair instead of from the near to the far
// plane. The factor cancels out; it gives half floats room for 300 opaque fragments at the front.
float weight(PictureParameters picture, vec3 position, float alpha) {
    BlendRange range = Range(picture.fragments).range;
    vec3 centre = (picture.head * vec4(range.centre, 1.0)).xyz;
    float front = distance(picture.eye, centre) - range.radius;
    float depth =
        (distance(picture.eye, position) - max(front, 0.0)) / (2.0 * max(range.radius, 1e-3));
    float nearness = 1.0 - clamp(depth, 0.0, 1.0);
    return alpha * max(1e-2, 3e3 * nearness * nearness * nearness) / 16.0;
}

void main() {
    PictureParameters picture = PictureReference(push.picture).parameters;
    vec4 strand = transparentStrand(picture);
    float w = weight(picture, position_and_across.xyz, strand.a);
    weighted = vec4(strand.rgb, 1.0) * (strand.a * w);
    hidden = strand.a;
}
