// Tests a piece's depth at a sample by 32-bit atomic minima: first its nearness and, once all
// samples have the least one, the piece's number.
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
