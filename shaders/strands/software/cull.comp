#version 460
// Lists the potentially visible pieces of a part of the strands, so that no invocation is idle in
// the later passes over pieces. An invocation has some strands and fetches each of their points
// once.
#extension GL_GOOGLE_include_directive : require
#ifdef HAIRBENCH_TEXELS
#define kPointTexels 0
#define kPyramidTexels 1
#endif
#include "strands/software/software.glsl"

#include "strands/points/quad.glsl"

layout(local_size_x_id = kGroupConstant) in;

const uint kWord = 32u;

// Nearness of the farthest sample in the two levels of the depth pyramid at a tile.
#ifdef kPyramidTexels
layout(binding = kPyramidTexels) uniform utextureBuffer pyramid_texels;

uvec2 fetchPyramid(uvec2 tile) { return texelFetch(pyramid_texels, int(tileIndex(tile))).xy; }
#else
uvec2 fetchPyramid(uvec2 tile) { return loadPair(push.pyramid, tileIndex(tile)); }
#endif

// Rounding margins, far above that of floats: the passes that draw a piece round differently from
// its bounds.
const float kPlaceRounding = 0.01;  // px
const float kDepthRounding = 1e-5;  // relative to depth

// Bounds of a strand at a point. Everything drawn there lies within a sphere as wide as the strand.
// The bounds cost much less than pieceEnd().
struct PointBounds {
    vec2 low;  // px
    vec2 high;
    float depth;  // of the nearest point
    float beyond;  // distance of the farthest point beyond the near plane, by pastNearPlane()
    bool known;  // true if the whole sphere is in front of the eye, so that the other members are
                 // bounds
};

// Values that are the same for all pieces.
struct View {
    mat4 view_projection;
    vec4 row_lengths;  // of its rows: how far a step of 1 m reaches in each coordinate
    uvec2 low_tile;  // of the hair's bounds
    uvec2 high_tile;
};

View makeView() {
    View view;
    view.view_projection = PictureReference(push.picture).parameters.view_projection;
    mat4 rows = transpose(view.view_projection);
    view.row_lengths = vec4(length(rows[0].xyz), length(rows[1].xyz), length(rows[2].xyz),
                            length(rows[3].xyz));
    uvec2 low;
    uvec2 high;
    hairBounds(low, high);
    view.low_tile = low / kTile;
    view.high_tile = (high - 1u) / kTile;
    return view;
}

// |(x + dx) / (w + dw) - x / w| <= (|dx| w + |x| |dw|) / (w (w - |dw|)).
PointBounds pointBounds(View view, uint index) {
    vec4 stored = fetchPoint(push.points, index);
    float radius = 0.5 * unpackWidth(floatBitsToUint(stored.w) >> 20);
    vec4 clip = view.view_projection * vec4(stored.xyz, 1.0);
    vec4 reach = radius * view.row_lengths;
    float least_w = clip.w - reach.w;
    PointBounds bounds;
    bounds.known = least_w > 1e-4 * clip.w;
    bounds.beyond = pastNearPlane(clip) + reach.w + reach.z;
    float scale = 1.0 / (clip.w * least_w);
    vec3 middle = clip.xyz * (least_w * scale);
    vec3 away = (reach.xyz * clip.w + abs(clip.xyz) * reach.w) * scale;
    vec2 half_size = 0.5 * vec2(push.width, push.height);
    vec2 place = (middle.xy + 1.0) * half_size;
    vec2 px = away.xy * half_size + kPlaceRounding;
    bounds.low = place - px;
    bounds.high = place + px;
    bounds.depth = nearer(middle.z, away.z + kDepthRounding * abs(middle.z));
    return bounds;
}

// True if nothing of a piece is visible: it is outside the picture or, by the depth pyramid,
// hidden.
bool isCulled(View view, PointBounds from, PointBounds to) {
    if (max(from.beyond, to.beyond) <= 0.0) return true;
    if (!from.known || !to.known) return false;
    vec2 low = min(from.low, to.low);
    vec2 high = max(from.high, to.high);
    vec2 size = vec2(push.width, push.height);
    if (any(lessThan(high, vec2(0.0))) || any(greaterThanEqual(low, size))) return true;
    if (push.part == kFirstPart) return false;
    uvec2 first = clamp(uvec2(max(low, vec2(0.0))) / kTile, view.low_tile, view.high_tile);
    uvec2 last = clamp(uvec2(min(high, size - 1.0)) / kTile, view.low_tile, view.high_tile);
    uint near = nearness(isNearer(from.depth, to.depth) ? from.depth : to.depth);
    uint tiles = max(last.x - first.x, last.y - first.y) + 1u;
    uvec2 pyramid = fetchPyramid(first);
    return tiles <= kCoarseLevel && (tiles <= kFineLevel ? pyramid.x : pyramid.y) < near;
}

// Lists the pieces of a strand from `begin` on that have their bits set.
void list(uint strand, uint begin, uint pieces, uint bits) {
    if (bits == 0u) return;
    uint place = push.list_begin +
                 atomicAdd(Counts(push.counts).counts.visible[push.part], uint(bitCount(bits)));
    for (; bits != 0u; bits &= bits - 1u)
        PieceList(push.list).at[place++] = firstPoint(strand, begin + uint(findLSB(bits)), pieces);
}

void cullPieces(View view, uint strand, uint pieces) {
    PointBounds from = pointBounds(view, firstPoint(strand, 0u, pieces));
    uint count = kSegments * pieces;
    for (uint begin = 0u; begin < count; begin += kWord) {
        uint end = min(begin + kWord, count);
        uint bits = 0u;
        for (uint i = begin; i < end; ++i) {
            uint first = firstPoint(strand, i, pieces);
            if (kSplitJoints == 1u && i > 0u && i % pieces == 0u)
                from = pointBounds(view, first);
            PointBounds to = pointBounds(view, first + 1u);
            bits |= uint(!isCulled(view, from, to)) << (i - begin);
            from = to;
        }
        list(strand, begin, pieces, bits);
    }
}

void main() {
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uint block = group * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (push.part == kFirstPart) block *= kFirstStrands;
    else block += block / (kFirstStrands - 1u) + 1u;
    uint begin = block * kBlock;
    uint end = min(begin + kBlock, push.strands);
    if (begin >= end) return;  // no barrier follows
    View view = makeView();
    for (uint strand = begin; strand < end; ++strand) {
        uint pieces = piecesOf(StrandPieces(push.pieces).at[strand]);
        if (pieces > 0u) cullPieces(view, strand, pieces);
    }
}
