#version 460
// The back end `pulling`: a vertex is a corner of a quad and evaluates its own point. Quads of
// adjacent pieces share their corners. HAIRBENCH_SHADOW is for a light's map.
#extension GL_GOOGLE_include_directive : require
#include "common/depth.glsl"
#include "strands/strand.glsl"
#ifdef HAIRBENCH_SHADOW
#include "shadows/quad.glsl"
#else
#include "strands/quad.glsl"
#endif

layout(constant_id = kStrandBlockConstant) const uint kBlock = 1;  // isolines per instance

layout(push_constant, scalar) uniform Push { StrandPush push; };

void main() {
    PictureParameters picture = PictureReference(push.picture).parameters;
    // Vertices are numbered [isoline of the instance][end of a piece][corner], and isolines
    // [patch][isoline], with the counts of the finest level.
    uint tessellation = kLodMode == kLodForced ? picture.forced_tessellation : picture.tessellation;
    uint corner = uint(gl_VertexIndex) % 2u;
    uint end = uint(gl_VertexIndex) / 2u % (tessellation + 1u);
    uint line = uint(gl_InstanceIndex) * kBlock + uint(gl_VertexIndex) / 2u / (tessellation + 1u);
    uint isoline = line % picture.strands_per_patch;

    StrandPatch strand_patch = strandPatch(picture, line / picture.strands_per_patch);
    uvec3 guides = patchGuides(picture, strand_patch);
    strand_patch.lod = patchLod(picture, strand_patch, guides);
    // Pieces beyond those that are drawn have no length.
    StrandPoint point =
        pointFromGuides(picture, strand_patch, guides, strand_patch.first_strand + isoline,
                        min(end, strand_patch.lod.pieces));
    LineEnd line_end =
        LineEnd(point.position, point.tangent, point.width, point.along, point.merged);
    makeCorner(picture, line_end, quadEnd(picture, line_end), corner == 0u ? -1.0 : 1.0);
    if (isoline >= strandsInPatch(picture, strand_patch)) gl_Position = kClippedPosition;
}
