#version 460
// volume_splat.glsl for any device, with one atomic operation per component.
#extension GL_GOOGLE_include_directive : require

#include "common/extensions.glsl"

layout(buffer_reference, scalar) buffer Sums { int at[]; };

void addToCell(Address sums, uint cell, ivec4 parts) {
    for (uint k = 0; k < 4; ++k)
        if (parts[k] != 0) atomicAdd(Sums(sums).at[4 * cell + k], parts[k]);
}

#include "simulation/volume_splat.glsl"
