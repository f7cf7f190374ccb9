// Rasterises pieces of strands. Each sample keeps the nearest piece; of equally near pieces, it
// keeps the first.
#ifdef HAIRBENCH_PACKED
#extension GL_EXT_shader_atomic_int64 : require
#endif
#ifdef kVisibilityTexels
#include "strands/software/visibility.glsl"
#endif
#include "strands/software/software.glsl"

#include "strands/software/piece_coordinates.glsl"
#include "strands/software/rows.glsl"

#ifdef HAIRBENCH_PACKED
// Tests a piece's depth at a sample with a 64-bit minimum: the nearness in the high half, the piece
// in the low half.
void testDepth(uint index, uint near, uint piece) {
    atomicMin(PackedPairs(push.visibility).at[index], packUint2x32(uvec2(piece, near)));
}
#else
// Tests a piece's depth at a sample by 32-bit atomic minima: first its nearness and, once all
// samples have the least one, the piece's number.
void testDepth(uint index, uint near, uint piece) {
    uvec2 now = loadPair(push.visibility, index);
    PlainPairs samples = PlainPairs(push.visibility);
    if (push.choice == 0u) {
        if (near < now.y) atomicMin(samples.at[index].y, near);
    } else if (near == now.y && piece < now.x) {
        atomicMin(samples.at[index].x, piece);
    }
}
#endif

// True if the depth test may pass. Other invocations test at the same time, but any value since the
// last barrier is valid here, because minima only decrease.
bool mayPassDepthTest(uint index, uint near) {
#ifdef kVisibilityTexels
    return near <= fetchVisibility(index).y;
#else
    return true;  // a read would cost as much
#endif
}

void takeSample(PictureParameters picture, uint piece, uvec2 pixel, uint index, vec2 place,
                float depth) {
    uint at = sampleIndex(pixel, index);
    uint near = nearness(depth);
    if (!mayPassDepthTest(at, near)) return;
    if (kMergedHairs != 0 && isGap(picture, piece, place)) return;
    testDepth(at, near, piece);
}
