#version 460
// One invocation per patch. It sets the level of detail, the number of strands (isolines) and of
// segments along each. It fetches the control points of the three guides once for all strands.
// Thesis 2.3.5.
#extension GL_GOOGLE_include_directive : require
#include "strands/strand.glsl"

layout(vertices = 1) out;
layout(push_constant, scalar) uniform Push { StrandPush push; };

layout(location = 0) in uint patch_index[];
layout(location = 0) patch out uvec4 patch_ids;  // key, segment, first strand, isolines
layout(location = 1) patch out vec4 patch_lod;   // level, density, width scale, morph
layout(location = 2) patch out vec3 control_points[12];  // [guide of the triangle][r(i-1) .. r(i+2)]
layout(location = 14) patch out vec3 root_lift[3];
layout(location = 17) patch out uvec3 patch_guides;
layout(location = 18) patch out vec4 single_shares;  // of the control points
layout(location = 19) patch out uvec2 patch_pieces;  // pieces, step
layout(location = 20) patch out uint patch_triangle;  // set if kNeedsTriangle

void main() {
    PictureParameters picture = PictureReference(push.picture).parameters;
    StrandPatch strand_patch = strandPatch(picture, patch_index[0]);
    uvec3 guides = patchGuides(picture, strand_patch);
    strand_patch.lod = patchLod(picture, strand_patch, guides);
    uint isolines = strandsInPatch(picture, strand_patch);

    patch_ids = uvec4(strand_patch.key, strand_patch.segment, strand_patch.first_strand, isolines);
    StrandLod lod = strand_patch.lod;
    patch_lod = vec4(lod.level, lod.density, lod.width_scale, lod.morph);
    patch_pieces = uvec2(lod.pieces, lod.step);
    for (int corner = 0; corner < 3; ++corner) {
        for (int k = 0; k < 4; ++k) {
            control_points[4 * corner + k] =
                guideControlPoint(picture, guides[corner], int(strand_patch.segment) + k - 1);
        }
    }
    patch_guides = guides;
    if (kNeedsTriangle) patch_triangle = strand_patch.triangle;
    single_shares = singleShares(picture, guides, strand_patch.segment);
    root_lift = rootLift(picture, strand_patch, guides).edges;

    gl_TessLevelOuter[0] = float(isolines);  // 0 drops the patch
    gl_TessLevelOuter[1] = float(lod.pieces);
    gl_TessLevelOuter[2] = 0.0;
    gl_TessLevelOuter[3] = 0.0;
    gl_TessLevelInner[0] = 0.0;
    gl_TessLevelInner[1] = 0.0;
}
