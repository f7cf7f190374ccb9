#version 460
// With /strands/rays/geometry `boxes`: writes the box round each piece of a strand. One invocation
// per piece.
#extension GL_GOOGLE_include_directive : require
#include "common/picture.glsl"
#include "strands/merged_word.glsl"
#include "strands/points/layout.glsl"
#include "strands/rays/round_cone.glsl"

layout(local_size_x_id = kGroupConstant) in;

layout(push_constant, scalar) uniform Push { PrimitivesPush push; };

// Boxes are larger than what is in them by this part of their coordinates, because devices round
// when they intersect them: 16 steps of a float.
const float kSlack = 16.0 / 8388608.0;

void main() {
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uint index = group * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (index >= push.invocations) return;  // no barrier follows
    uint strand = index / kPiecesPerStrand;
    uint place = index % kPiecesPerStrand;
    uint stored = 0u;
    if (strand < push.strands) stored = StrandPieces(push.pieces).at[strand];
    uint pieces = piecesOf(stored);
    // NaN leaves a box out.
    vec3 nowhere = vec3(push.leaves_out == 1u ? uintBitsToFloat(0x7fc00000u) : 0.0);
    StrandBox box = StrandBox(nowhere, nowhere, kNoPiece, 0.0);
    if (place % kMostPieces < pieces) {
        box.piece = firstPoint(strand, place / kMostPieces * pieces + place % kMostPieces, pieces);
        box.covered = 1.0 / mergedSpread(stored & 0xffff0000u);
        RoundCone cone = coneOfPiece(push.points, box.piece);
        box.low = min(cone.from - cone.from_radius, cone.to - cone.to_radius);
        box.high = max(cone.from + cone.from_radius, cone.to + cone.to_radius);
        vec3 slack = kSlack * max(abs(box.low), abs(box.high));
        box.low -= slack;
        box.high += slack;
    }
    StrandBoxes(push.primitives).at[index] = box;
}
