#version 460
// volume_splat.glsl for devices with atomics on 64-bit integers: one for two components. The lower
// component of a pair borrows from the upper one if its sum is negative
// (VolumeParameters::borrows). Shares are never negative.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_shader_atomic_int64 : require

#include "common/extensions.glsl"

layout(buffer_reference, scalar) buffer Sums { uint64_t at[]; };

uint64_t packed(int low, int high) { return uint64_t(int64_t(low)) + (uint64_t(uint(high)) << 32); }

void addToCell(Address sums, uint cell, ivec4 parts) {
    atomicAdd(Sums(sums).at[2 * cell], packed(parts.x, parts.y));
    atomicAdd(Sums(sums).at[2 * cell + 1], packed(parts.z, parts.w));
}

#include "simulation/volume_splat.glsl"
