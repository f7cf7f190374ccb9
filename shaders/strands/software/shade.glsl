// The color of each sample that shows a strand. A workgroup a row of pixels.
#include "shading/strand_shading.glsl"
#include "strands/software/software.glsl"

#include "strands/points/quad.glsl"
#include "strands/software/samples.glsl"

layout(local_size_x = kSoftwarePixelGroup) in;

// The point of a piece that a place on the screen shows, px.
StrandFragment seenPoint(PictureParameters picture, uint number, vec2 place) {
    Piece piece = pieceOf(picture, number);
    PieceQuad quad = piece.quad;
    vec2 run = quad.to.place - quad.from.place;
    vec2 offset = place - quad.from.place;
    vec2 mean_side = 0.5 * (quad.from.side + quad.to.side);
    float area = cross2(run, mean_side);
    float t = cross2(offset, mean_side) / (abs(area) < 1e-12 ? 1e-12 : area);
    t = clamp(t, 0.0, 1.0);
    float side_area = cross2(run, mix(quad.from.side, quad.to.side, t));
    float across = cross2(run, offset) / (abs(side_area) < 1e-12 ? 1e-12 : side_area);
    // Along the piece itself, which the screen shows in perspective.
    t = t * quad.from.w / mix(quad.to.w, quad.from.w, t);
    t = mix(quad.part.x, quad.part.y, t);

    StrandFragment fragment;
    fragment.across = clamp(across, -1.0, 1.0);
    fragment.position =
        mix(piece.from.position, piece.to.position, t) + fragment.across * mix(piece.from.side, piece.to.side, t);
    vec3 tangent = mix(piece.from.tangent, piece.to.tangent, t);
    fragment.tangent = tangent * inversesqrt(max(dot(tangent, tangent), 1e-30));
    fragment.to_eye = normalize(picture.eye - fragment.position);
    fragment.along = 0.0;  // what a strand's texture would need
    return fragment;
}

void main() {
    uvec2 low;
    uvec2 high;
    hairBounds(low, high);
    uvec2 pixel = uvec2(low.x, gl_WorkGroupID.x);
    if (pixel.y < low.y || pixel.y >= high.y) return;
    PictureParameters picture = PictureReference(push.picture).parameters;
    for (pixel.x += gl_LocalInvocationID.x; pixel.x < high.x; pixel.x += gl_WorkGroupSize.x) {
        for (uint i = 0u; i < kSamples; ++i) {
            uint index = sampleIndex(pixel, i);
            uvec2 seen = loadPair(push.samples, index);
            if (seen.x == kNoPiece) continue;
            StrandFragment fragment = seenPoint(picture, seen.x, vec2(pixel) + samplePlace(i));
            vec3 color = shadeStrand(picture, fragment, picture.hair_color);
            if (kLinearLight == 1u)
                storePair(push.colors, index,
                          uvec2(packHalf2x16(color.rg), packHalf2x16(vec2(color.b, 1.0))));
            else
                storePair(push.samples, index, uvec2(packUnorm4x8(vec4(color, 0.0)), seen.y));
        }
    }
}
