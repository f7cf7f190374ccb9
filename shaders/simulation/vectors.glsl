#ifndef HAIRBENCH_SIMULATION_VECTORS_GLSL
#define HAIRBENCH_SIMULATION_VECTORS_GLSL

#include "common/extensions.glsl"

// A vec4 in memory.
layout(buffer_reference, scalar) buffer PlainVectors { vec4 at[]; };

vec4 loadVector(Address address, uint index) { return PlainVectors(address).at[index]; }

void storeVector(Address address, uint index, vec4 value) {
    PlainVectors(address).at[index] = value;
}

#endif
