// Tests a piece's depth at a sample with 32-bit minima: first the nearness of the nearest piece
// and, once all samples have it, the piece's number.
#include "common/vectors.glsl"

#include "strands/software/software.glsl"

void testDepth(uint index, uint near, uint piece) {
    uvec2 now = loadPair(push.visibility, index);
    PlainPairs samples = PlainPairs(push.visibility);
    if (push.choice == 0u) {
        if (near < now.y) atomicMin(samples.at[index].y, near);
    } else if (near == now.y && piece < now.x) {
        atomicMin(samples.at[index].x, piece);
    }
}
