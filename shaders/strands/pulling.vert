#version 460
// Strands without tessellation: every vertex of a line list evaluates its own point. Same order of lines,
// same functions and same geometry stage as the tessellation back end, so the pictures are equal.
#extension GL_GOOGLE_include_directive : require
#include "strands/strand.glsl"

layout(push_constant, scalar) uniform Push { StrandPush push; };

layout(location = 0) out vec4 position_and_width;  // a negative width drops the line
layout(location = 1) out vec4 tangent_and_along;

void main() {
    PictureParameters picture = PictureReference(push.picture).parameters;
    // Lines are numbered [patch][isoline][segment of the patch], as many as at the finest level.
    uint line = uint(gl_VertexIndex) / 2u;
    uint end = uint(gl_VertexIndex) % 2u;
    uint tessellation = kLodMode == kLodForced ? picture.forced_tessellation : picture.tessellation;
    uint piece = line % tessellation;
    uint isoline = line / tessellation % picture.strands_per_patch;
    uint patch_index = line / tessellation / picture.strands_per_patch;

    StrandPatch strand_patch = strandPatch(picture, patch_index);
    uvec3 guides = patchGuides(picture, strand_patch);
    strand_patch.lod = patchLod(picture, strand_patch, guides);
    bool drawn = isoline < strandsInPatch(picture, strand_patch) &&
                 piece < strand_patch.lod.pieces;

    StrandPoint point =
        pointFromGuides(picture, strand_patch, guides, strand_patch.first_strand + isoline,
                        piece + end);
    position_and_width = vec4(point.position, drawn ? point.width : -1.0);
    tangent_and_along = vec4(point.tangent, point.along);
}
