// Tests a piece's depth at a sample with a 64-bit minimum: the nearness in the high half, the piece
// in the low half.
#extension GL_EXT_shader_atomic_int64 : require
#include "common/packed_vectors.glsl"

#include "strands/software/software.glsl"

void testDepth(uint index, uint near, uint piece) {
    atomicMin(PackedPairs(push.visibility).at[index], packUint2x32(uvec2(piece, near)));
}
