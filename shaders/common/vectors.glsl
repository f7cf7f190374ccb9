#ifndef HAIRBENCH_COMMON_VECTORS_GLSL
#define HAIRBENCH_COMMON_VECTORS_GLSL

#ifdef HAIRBENCH_PACKED
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#endif

#include "common/extensions.glsl"

// Reads and writes a vec4, or a pair of unsigned integers, in memory.
#ifdef HAIRBENCH_PACKED
// In 64-bit halves. A device that moves one element of one invocation at a time, as Mesa 22's
// lavapipe does, then moves half as many.
layout(buffer_reference, scalar) buffer PackedVectors { u64vec2 at[]; };

vec4 loadVector(Address address, uint index) {
    u64vec2 halves = PackedVectors(address).at[index];
    return uintBitsToFloat(uvec4(unpackUint2x32(halves.x), unpackUint2x32(halves.y)));
}

void storeVector(Address address, uint index, vec4 value) {
    uvec4 bits = floatBitsToUint(value);
    PackedVectors(address).at[index] = u64vec2(packUint2x32(bits.xy), packUint2x32(bits.zw));
}

layout(buffer_reference, scalar, buffer_reference_align = 8) buffer PackedPairs { uint64_t at[]; };

uvec2 loadPair(Address address, uint index) {
    return unpackUint2x32(PackedPairs(address).at[index]);
}

void storePair(Address address, uint index, uvec2 value) {
    PackedPairs(address).at[index] = packUint2x32(value);
}
#else
layout(buffer_reference, scalar) buffer PlainVectors { vec4 at[]; };

vec4 loadVector(Address address, uint index) { return PlainVectors(address).at[index]; }

void storeVector(Address address, uint index, vec4 value) {
    PlainVectors(address).at[index] = value;
}

layout(buffer_reference, scalar) buffer PlainPairs { uvec2 at[]; };

uvec2 loadPair(Address address, uint index) { return PlainPairs(address).at[index]; }

void storePair(Address address, uint index, uvec2 value) { PlainPairs(address).at[index] = value; }
#endif

#endif
