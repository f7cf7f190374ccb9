#ifndef HAIRBENCH_COMMON_PACKED_VECTORS_GLSL
#define HAIRBENCH_COMMON_PACKED_VECTORS_GLSL

#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require

#include "common/extensions.glsl"

// The functions of common/vectors.glsl, but with 64-bit reads and writes. A device that moves one
// element of one invocation at a time, as Mesa 22's lavapipe does, then moves half as many.
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

#endif
