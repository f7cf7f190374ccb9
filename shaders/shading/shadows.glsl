// What is between a light and a point.
#ifndef HAIRBENCH_SHADOWS_GLSL
#define HAIRBENCH_SHADOWS_GLSL

#include "common/picture.glsl"
#include "shading/options.glsl"

// ShadowPass::images() are at this binding and the next two.
#ifndef HAIRBENCH_SHADOW_BINDING
#define HAIRBENCH_SHADOW_BINDING 1
#endif

struct LightPath {
    float meshes;  // part of the light that meshes let through, 0 to 1
    float strands;  // mean number of strands that it meets
};

LightPath lightPath(PictureParameters picture, uint light, vec3 position) {
    return LightPath(1.0, 0.0);
}

// Part of the light that opaque shading models get: thesis's and meshes'.
float visibility(PictureParameters picture, LightPath path) { return path.meshes; }

#endif
