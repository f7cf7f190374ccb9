// The color of each sample that shows a strand. A workgroup a row of pixels.
#include "shading/strand_shading.glsl"
#include "strands/software/seen.glsl"

#include "strands/points/quad.glsl"
#include "strands/software/samples.glsl"

layout(local_size_x_id = kPixelGroupConstant) in;

// The factors of two vectors with corner + x.x first + x.y second = 0.
vec2 factorsOf(vec2 corner, vec2 first, vec2 second) {
    float area = cross2(first, second);
    return vec2(cross2(second, corner), cross2(corner, first)) / (abs(area) < 1e-30 ? 1e-30 : area);
}

// The point of a piece that a place on the screen shows, px: on one of the two triangles that other
// back ends draw, from -+ side at its first end to - side at its second, and the rest.
StrandFragment seenPoint(PictureParameters picture, uint number, vec2 place) {
    Piece piece = pieceOf(picture, number);
    // In clip space, with what is seen at the place at 0.
    vec2 clip = 2.0 * place / vec2(push.width, push.height) - 1.0;
    vec2 from = piece.from.middle_clip.xy - clip * piece.from.middle_clip.w;
    vec2 from_side = piece.from.side_clip.xy - clip * piece.from.side_clip.w;
    vec2 to = piece.to.middle_clip.xy - clip * piece.to.middle_clip.w;
    vec2 to_side = piece.to.side_clip.xy - clip * piece.to.side_clip.w;
    vec2 along_and_across =
        factorsOf(from - from_side, to - to_side - from + from_side, 2.0 * from_side);
    bool second = along_and_across.x + along_and_across.y > 1.0;
    if (second)
        along_and_across =
            1.0 - factorsOf(to + to_side, from + from_side - to - to_side, -2.0 * to_side);
    float t = clamp(along_and_across.x, piece.quad.part.x, piece.quad.part.y);
    vec3 narrowing = piece.from.side - piece.to.side;

    StrandFragment fragment;
    fragment.across = clamp(2.0 * along_and_across.y - 1.0, -1.0, 1.0);
    fragment.position = mix(piece.from.position, piece.to.position, t);
    fragment.position += second ? fragment.across * piece.to.side + (1.0 - t) * narrowing
                                : fragment.across * piece.from.side + t * narrowing;
    vec3 tangent = mix(piece.from.tangent, piece.to.tangent, t);
    fragment.tangent = tangent * inversesqrt(max(dot(tangent, tangent), 1e-30));
    fragment.to_eye = normalize(picture.eye - fragment.position);
    fragment.along = 0.0;  // what a strand's texture would need
    fragment.width = 2.0 * length(mix(piece.from.side, piece.to.side, t));
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
            uvec2 seen = fetchSample(index);
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
