// Light from all around.
#ifndef HAIRBENCH_ENVIRONMENT_GLSL
#define HAIRBENCH_ENVIRONMENT_GLSL

#include "common/picture.glsl"
#include "shading/options.glsl"

// Irradiance / pi on a surface with this normal: what it would show if it were white and matt.
vec3 environmentLight(PictureParameters picture, vec3 normal) { return vec3(0.0); }

#endif
