// A point of a strand in 16 bytes: its position, and a word with the strand's direction and width.
#ifndef HAIRBENCH_POINTS_GLSL
#define HAIRBENCH_POINTS_GLSL

#include "common/vectors.glsl"

struct PackedPoint {
    vec3 position;  // m
    vec3 tangent;  // unit length
    float width;  // m
};

vec2 awayFromZero(vec2 v) { return mix(vec2(-1.0), vec2(1.0), greaterThanEqual(v, vec2(0.0))); }

// A direction in octahedral encoding, 10 bits per coordinate, accurate to 0.1 degrees: Cigolle et
// al. 2014, A survey of efficient representations for independent unit vectors, JCGT 3(2).
uint packDirection(vec3 v) {
    vec2 p = v.xy / max(abs(v.x) + abs(v.y) + abs(v.z), 1e-30);
    if (v.z < 0.0) p = (1.0 - abs(p.yx)) * awayFromZero(p);
    uvec2 steps = uvec2(round(511.0 * clamp(p, -1.0, 1.0) + 511.0));
    return steps.x | steps.y << 10;
}

vec3 unpackDirection(uint word) {
    vec2 p = vec2(word & 1023u, word >> 10 & 1023u) / 511.0 - 1.0;
    vec3 v = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    if (v.z < 0.0) v.xy = (1.0 - abs(v.yx)) * awayFromZero(v.xy);
    return normalize(v);
}

// Widths of 60 nm to 1 m in steps of 0.4 %; smaller ones are 0.
const float kWidthsPerOctave = 170.0;
const float kMostWidth = 4095.0;

uint packWidth(float width) {
    float place = kMostWidth + kWidthsPerOctave * log2(max(width, 1e-9));
    return uint(clamp(round(place), 0.0, kMostWidth));
}

float unpackWidth(uint word) {
    return word == 0u ? 0.0 : exp2((float(word) - kMostWidth) / kWidthsPerOctave);
}

void storePoint(Address points, uint index, PackedPoint point) {
    uint word = packDirection(point.tangent) | packWidth(point.width) << 20;
    storeVector(points, index, vec4(point.position, uintBitsToFloat(word)));
}

// If kPointTexels is defined, points are fetched as texels. A device that loads one element of one
// invocation at a time from memory, as lavapipe does, fetches a texel of all invocations at once.
#ifdef kPointTexels
#extension GL_EXT_samplerless_texture_functions : require
layout(binding = kPointTexels) uniform utextureBuffer point_texels;

vec4 fetchPoint(Address points, uint index) {
    return uintBitsToFloat(texelFetch(point_texels, int(index)));
}
#else
vec4 fetchPoint(Address points, uint index) { return loadVector(points, index); }
#endif

PackedPoint loadPoint(Address points, uint index) {
    vec4 stored = fetchPoint(points, index);
    uint word = floatBitsToUint(stored.w);
    return PackedPoint(stored.xyz, unpackDirection(word), unpackWidth(word >> 20));
}

#endif
