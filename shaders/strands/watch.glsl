// The push constants of a stage that may be watched and, with HAIRBENCH_WATCHED, the functions that
// count its invocations: see hair/rendering/backends.h.
#ifndef HAIRBENCH_WATCH_GLSL
#define HAIRBENCH_WATCH_GLSL

#include "common/picture.glsl"

#ifdef HAIRBENCH_WATCHED
#include "shared/watch_structs.h"

layout(push_constant, scalar) uniform Push { WatchedPush push; };

layout(buffer_reference, scalar) buffer StageWatchReference { StageWatch watch; };

// Sums bits. Unlike sums of floats, they cannot be simplified, and one addition per number is
// cheap.
uint bitSum(vec4 outputs) {
    uvec4 bits = floatBitsToUint(outputs);
    return bits.x + bits.y + bits.z + bits.w;
}

// `outputs` must depend on all outputs of the invocation.
void countInvocation(uint outputs) {
    StageWatchReference reference = StageWatchReference(push.watch);
    if ((outputs & reference.watch.mask) != reference.watch.wanted) return;
    atomicAdd(reference.watch.sum, outputs);
    atomicAdd(reference.watch.count, 1u);
}
#else
layout(push_constant, scalar) uniform Push { StrandPush push; };
#endif

#endif
