#version 460
// The back end `rays`: writes the corners of the quads that the other back ends draw. One invocation
// per point of a strand.
#extension GL_GOOGLE_include_directive : require
#include "common/across.glsl"
#include "common/picture.glsl"
#include "shared/software_structs.h"
#include "strands/points/layout.glsl"
#include "strands/points/points.glsl"

layout(local_size_x_id = kGroupConstant) in;

layout(push_constant, scalar) uniform Push { PrimitivesPush push; };

layout(buffer_reference, scalar) writeonly buffer Corners { vec3 at[]; };

void main() {
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uint index = group * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (index >= push.invocations) return;  // no barrier follows
    uint strand = index / kPointsPerStrand;
    uint place = index % kPointsPerStrand;
    uint pieces = 0u;
    if (strand < push.strands) pieces = piecesOf(StrandPieces(push.pieces).at[strand]);
    // The points of a segment, and of the next one if they share a point.
    uint segment = place / (kMostPieces + kSplitJoints);
    uint end = place % (kMostPieces + kSplitJoints);
    vec3 low = vec3(push.leaves_out == 1u ? uintBitsToFloat(0x7fc00000u) : 0.0);  // NaN
    vec3 high = low;
    if (pieces > 0u) {
        PictureParameters picture = PictureReference(push.picture).parameters;
        PackedPoint point = loadPoint(push.points, strand * kPointsPerStrand +
                                      segment * (pieces + kSplitJoints) + min(end, pieces));
        vec3 side =
            sideOfLength(picture.eye - point.position, point.tangent, 0.5 * point.width);
        low = point.position - side;
        high = point.position + side;
    }
    Corners(push.primitives).at[2u * index] = low;
    Corners(push.primitives).at[2u * index + 1u] = high;
}
