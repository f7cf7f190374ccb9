#version 460
// Lists the visible strands of each draw of the back end `expanded`, and writes the draws. One
// invocation per draw.
#extension GL_GOOGLE_include_directive : require
#include "strands/points/layout.glsl"

layout(local_size_x_id = kGroupConstant) in;

layout(push_constant, scalar) uniform Push { ExpandedPush push; };

layout(buffer_reference, scalar) writeonly buffer VisibleStrands { uint at[]; };
layout(buffer_reference, scalar) writeonly buffer Arguments { IndexedCommand at[]; };

void main() {
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uint draw = group * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    uint begin = draw * kExpandedStrands;
    if (begin >= push.strands) return;  // no barrier follows
    uint end = min(begin + kExpandedStrands, push.strands);
    uint next = begin;
    for (uint strand = begin; strand < end; ++strand) {
        if (StrandPieces(push.pieces).at[strand] == 0u) continue;
        VisibleStrands(push.visible).at[next++] = strand;
    }
    Arguments(push.arguments).at[draw] =
        IndexedCommand(6u * kPiecesPerStrand * (next - begin), next > begin ? 1u : 0u, 0u,
                       2u * kPointsPerStrand * begin, 0u);
}
