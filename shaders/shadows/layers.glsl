// Deep opacity maps: Yuksel and Keyser 2008. Layers follow the surface of the hair as a light sees
// it. The first layer begins at z0, the depth of the nearest strand, and is `layer_depth` deep.
// Each further layer is twice as deep as the one before. Strands behind the last layer count as in
// it.
#ifndef HAIRBENCH_SHADOW_LAYERS_GLSL
#define HAIRBENCH_SHADOW_LAYERS_GLSL

// Where the four layers end, in depths of the first. Behind the last, opacity does not increase.
const vec4 kLayerEnds = vec4(1.0, 3.0, 7.0, 15.0);

// The distance of a depth along the light's view, m. depth_terms is as in ShadowMap.
float viewDepth(vec4 depth_terms, float depth) {
    return (depth_terms.y - depth * depth_terms.w) / (depth * depth_terms.z - depth_terms.x);
}

// Change of depth per metre at `z` metres along the light's view.
float depthPerMetre(vec4 depth_terms, float z) {
    float w = depth_terms.z * z + depth_terms.w;
    return abs(depth_terms.x * depth_terms.w - depth_terms.y * depth_terms.z) / (w * w);
}

// The layers to which a strand `behind` metres behind z0 adds: its own and all behind it.
vec4 layersOf(float behind, float layer_depth) {
    return vec4(lessThan(vec3(behind), layer_depth * kLayerEnds.xyz), 1.0);
}

// Mean number of strands between z0 and `behind` metres behind it, linear within each layer.
float strandsBefore(vec4 layers, float behind, float layer_depth) {
    vec4 begins = vec4(0.0, kLayerEnds.xyz);
    vec4 parts = clamp((behind / layer_depth - begins) / (kLayerEnds - begins), 0.0, 1.0);
    return dot(parts, layers - vec4(0.0, layers.xyz));
}

// The position of a point within its layer, 0 to 1.
float layerPart(float behind, float layer_depth) {
    vec4 begins = vec4(0.0, kLayerEnds.xyz);
    vec4 parts = clamp((behind / layer_depth - begins) / (kLayerEnds - begins), 0.0, 1.0);
    vec4 inside = vec4(lessThan(parts, vec4(1.0)));
    return dot(parts * inside, vec4(1.0)) + (inside.w == 0.0 ? 1.0 : 0.0);
}

#endif
