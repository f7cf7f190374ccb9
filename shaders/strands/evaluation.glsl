// The evaluation stage of the tessellation back end: interpolates a strand's vertex between the
// guides and evaluates the curve. Thesis 2.3.2 and 2.3.5.
#ifndef HAIRBENCH_EVALUATION_GLSL
#define HAIRBENCH_EVALUATION_GLSL

#include "strands/strand.glsl"

layout(isolines, equal_spacing) in;

layout(location = 0) patch in uvec4 patch_ids;
layout(location = 1) patch in vec4 patch_lod;
layout(location = 2) patch in vec3 control_points[12];
layout(location = 14) patch in vec3 root_lift[3];
layout(location = 17) patch in uvec3 patch_guides;
layout(location = 18) patch in vec4 single_shares;
layout(location = 19) patch in uvec2 patch_pieces;
layout(location = 20) patch in uint patch_triangle;

StrandPoint evaluatedPoint(PictureParameters picture) {
    // Converts back to integers, so that the tessellator's rounding cannot move a strand or open a
    // joint.
    precise vec2 place = gl_TessCoord.yx * vec2(patch_ids.w, patch_pieces.x) + 0.5;
    uint isoline = uint(place.x);
    uint piece_end = uint(place.y);

    StrandPatch strand_patch;
    if (kNeedsTriangle) strand_patch.triangle = patch_triangle;
    strand_patch.key = patch_ids.x;
    strand_patch.segment = patch_ids.y;
    strand_patch.first_strand = patch_ids.z;
    strand_patch.lod = StrandLod(patch_lod.x, patch_lod.y, patch_lod.z, patch_pieces.x,
                                 patch_pieces.y, patch_lod.w);

    PatchStrand strand;
    strand.index = patch_ids.z + isoline;
    strand.guides = patch_guides;
    strand.weights = strandWeights(picture, strand_patch, strand.index);
    strand.lift = strandLift(RootLift(root_lift), strand.weights);
    strandControlPoints(picture, patch_guides, strand_patch.segment, strand.weights,
                        control_points, single_shares, strand.r);
    return drawnPoint(picture, strand_patch, strand, piece_end);
}

#endif
