#version 460
// Shades each sample that shows a strand. One or several work groups per row of pixels.
#extension GL_GOOGLE_include_directive : require
#ifdef HAIRBENCH_TEXELS
#define kPointTexels 4
#define kVisibilityTexels 5
#endif
#include "shading/strand_shading.glsl"
#include "strands/software/visibility.glsl"

#include "strands/software/piece_coordinates.glsl"
#include "strands/software/samples.glsl"
#include "strands/merged_fragment.glsl"

layout(local_size_x_id = kGroupConstant) in;

// Returns the point of a piece that is seen at a screen position, px.
StrandFragment visiblePoint(PictureParameters picture, uint number, vec2 place, out uint merged) {
    Piece piece = pieceOf(picture, number);
    PieceCoordinates at = pieceCoordinates(piece, place);
    vec3 narrowing = piece.from.side - piece.to.side;

    StrandFragment fragment;
    fragment.across = at.across;
    fragment.position = mix(piece.from.position, piece.to.position, at.t);
    fragment.position += at.second ? fragment.across * piece.to.side + (1.0 - at.t) * narrowing
                                : fragment.across * piece.from.side + at.t * narrowing;
    vec3 tangent = mix(piece.from.tangent, piece.to.tangent, at.t);
    fragment.tangent = tangent * inversesqrt(max(dot(tangent, tangent), 1e-30));
    fragment.to_eye = normalize(picture.eye - fragment.position);
    fragment.along = 0.0;  // only a strand's texture would need it
    fragment.width = 2.0 * length(mix(piece.from.side, piece.to.side, at.t));
    fragment.fiber_width = fragment.width;
    merged = 0u;
    if (kTellsHairs) {
        PlaceOnStrand on_strand = placeOnStrand(picture, number, at.t);
        fragment.along = on_strand.along;
        merged = on_strand.merged;
        if (kMergedHairs != 0) fragment.fiber_width /= mergedCount(merged);
        if (kMergedHairs != 0 && mergedCount(merged) > 1.0) {
            fragment.across = perspectiveAcross(piece, at);
            toMergedHair(merged, fragment);
        }
    }
    return fragment;
}

void main() {
    uvec2 low;
    uvec2 high;
    hairBounds(low, high);
    uvec2 pixel = uvec2(low.x, gl_WorkGroupID.x);
    if (pixel.y < low.y || pixel.y >= high.y) return;
    PictureParameters picture = PictureReference(push.picture).parameters;
    uint stride = gl_NumWorkGroups.y * gl_WorkGroupSize.x;
    pixel.x += gl_WorkGroupID.y * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    for (; pixel.x < high.x; pixel.x += stride) {
        for (uint i = 0u; i < kSamples; ++i) {
            uint index = sampleIndex(pixel, i);
            uvec2 visible = fetchVisibility(index);
            if (visible.x == kNoPiece) continue;
#ifdef HAIRBENCH_RAYS
            own_begin = visible.x / kPointsPerStrand * kPointsPerStrand;
            own_end = own_begin + kPointsPerStrand;
#endif
            uint merged;
            StrandFragment fragment =
                visiblePoint(picture, visible.x, vec2(pixel) + samplePosition(i), merged);
            fragment.power = ownPower(picture, merged, fragment.along);
            vec3 color = shadeStrand(picture, fragment, vec3(1.0));
            if (kLinearLight == 1u)
                storePair(push.colors, index,
                          uvec2(packHalf2x16(color.rg), packHalf2x16(vec2(color.b, 1.0))));
            else
                storePair(push.visibility, index, uvec2(packUnorm4x8(vec4(color, 0.0)), visible.y));
        }
    }
}
