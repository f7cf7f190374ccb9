#ifndef HAIRBENCH_SHADOW_STRUCTS_H
#define HAIRBENCH_SHADOW_STRUCTS_H

const uint kMostLights = 16u;

// A light's part of the shadow atlas.
struct ShadowMap {
    mat4 view_projection;  // world -> clip space of the light
    uint enabled;  // 0: the light throws no shadows
};

// Read by whatever is lit.
struct ShadowParameters {
    ShadowMap maps[kMostLights];  // [light]
    uint map_count;  // side by side in the atlas
    float layer_depth;  // m
    float stopped;  // part of the light that a strand stops
    float softness;  // texels
};

#endif
