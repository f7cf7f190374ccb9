#ifndef HAIRBENCH_SHADOW_STRUCTS_H
#define HAIRBENCH_SHADOW_STRUCTS_H

const uint kMostLights = 64u;  // those of the scene, then those of an environment
const uint kMostFurtherMaps = 128u;  // of lights that have several
const uint kMostMaps = 192u;

// What throws shadows in a map.
const uint kMeshesCast = 1u;
const uint kHairCasts = 2u;

// What a light sees, in its square part of the shadow atlases.
struct ShadowMap {
    mat4 view_projection;  // world -> clip space of the light
    vec4 depth_terms;  // (a, b, c, d): depth = (a z + b) / (c z + d), z metres along the view
    vec2 corner;  // of the light's part of the atlas, texels
    float texel_near;  // m: a texel's side at the light; above 0 in parallel projections
    float texel_slope;  // what texel_near grows by per metre along the view
    float layer_depth;  // m: see shadows/layers.glsl
    uint ends_at_meshes;  // 1: strands behind a mesh are not counted
    uint casters;  // kMeshesCast | kHairCasts; 0: the light throws no shadows
    uint further;  // in ShadowParameters::maps: where the light's other maps begin
    uint further_count;
};

// The shadows of a picture, read by whatever is lit.
struct ShadowParameters {
    ShadowMap maps[kMostMaps];  // [light], then from kMostLights on further ones of some lights
    float side;  // of a part of the atlas, texels
    float stopped;  // part of the light that a strand stops
    float softness;  // texels
    vec3 mesh_color;  // what meshes send back of light, linear; in display RGB where there is none
};

#endif
