#version 460
// Does work that nobody needs. Each number is made from the one before, so no step can be skipped.
// A linear congruential generator (multiplier and increment of Numerical Recipes) is not enough:
// compilers know that two of its steps equal one with other constants. The shift prevents that. One
// step is kBusyRounds numbers in every invocation of a work group. The work groups share the steps
// evenly.
#extension GL_GOOGLE_include_directive : require

#include "common/extensions.glsl"
#include "shared/busy_structs.h"

layout(local_size_x = 64) in;

layout(push_constant, scalar) uniform Push { BusyPush push; };

layout(buffer_reference, scalar) buffer Results {
    uint steps;
    uint at[];
};

void main() {
    uint group = gl_WorkGroupID.x;
    uint number = gl_GlobalInvocationID.x;
    uint done = 0;
    for (uint step = group; step < push.steps; step += gl_NumWorkGroups.x) {
        for (uint i = 0; i < kBusyRounds; ++i) {
            number = 1664525u * number + 1013904223u;
            number ^= number >> 16;
        }
        ++done;
    }
    Results results = Results(push.results);
    atomicXor(results.at[group], number);
    if (gl_LocalInvocationID.x == 0) atomicAdd(results.steps, done);
}
