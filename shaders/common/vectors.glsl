#ifndef HAIRBENCH_COMMON_VECTORS_GLSL
#define HAIRBENCH_COMMON_VECTORS_GLSL

#include "common/extensions.glsl"

// A vec4 in memory.
layout(buffer_reference, scalar) buffer PlainVectors { vec4 at[]; };

vec4 loadVector(Address address, uint index) { return PlainVectors(address).at[index]; }

void storeVector(Address address, uint index, vec4 value) {
    PlainVectors(address).at[index] = value;
}

// Two unsigned integers in memory.
layout(buffer_reference, scalar) buffer PlainPairs { uvec2 at[]; };

uvec2 loadPair(Address address, uint index) { return PlainPairs(address).at[index]; }

void storePair(Address address, uint index, uvec2 value) { PlainPairs(address).at[index] = value; }

#endif
