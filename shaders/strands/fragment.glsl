// What the fragment shaders of strands share: the quad's point that they color.
#ifndef HAIRBENCH_STRAND_FRAGMENT_GLSL
#define HAIRBENCH_STRAND_FRAGMENT_GLSL

#include "common/picture.glsl"
#include "shading/strand_shading.glsl"

layout(push_constant, scalar) uniform Push { StrandPush push; };

layout(location = 0) in vec4 position_and_across;
layout(location = 1) in vec4 tangent_and_along;

StrandFragment strandFragment(PictureParameters picture) {
    StrandFragment fragment;
    fragment.position = position_and_across.xyz;
    fragment.tangent = normalize(tangent_and_along.xyz);
    fragment.to_eye = normalize(picture.eye - fragment.position);
    fragment.across = position_and_across.w;
    fragment.along = tangent_and_along.w;
    return fragment;
}

// Color and opacity.
vec4 strandColor(PictureParameters picture) {
    StrandFragment fragment = strandFragment(picture);
    return vec4(shadeStrand(picture, fragment, picture.hair_color), picture.opacity);
}

#endif
