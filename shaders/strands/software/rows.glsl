// The samples of a piece of a strand. Pieces are drawn in spans across their major axis, so each row
// or column of samples meets a thin piece in few samples. Define push constants as for
// strands/points/quad.glsl first.
#ifndef HAIRBENCH_SOFTWARE_ROWS_GLSL
#define HAIRBENCH_SOFTWARE_ROWS_GLSL

#include "shared/software_structs.h"
#include "strands/points/quad.glsl"
#include "strands/software/samples.glsl"

// A piece's samples row by row, or column by column if it is nearer to horizontal.
struct RasterQuad {
    bool columns;
    int begin;  // rows of samples
    int end;
    vec4 starts;  // positions of the four edges across the rows at row coordinate 0
    vec4 slopes;
    bvec4 lower;  // edges that bound it from below
    float size;  // of the picture along a row, px
    vec2 origin;  // along and across rows: a point of known depth
    float depth;
    vec2 gradient;  // of depth, along and across rows
    vec2 depth_range;
    float row_length;  // mean, px
};

float least(vec4 v) { return min(min(v.x, v.y), min(v.z, v.w)); }
float most(vec4 v) { return max(max(v.x, v.y), max(v.z, v.w)); }

void makeEdges(PieceQuad quad, inout RasterQuad raster) {
    vec4 x = vec4(quad.from.place.x, quad.from.place.x, quad.to.place.x, quad.to.place.x) +
             vec4(-quad.from.side.x, quad.from.side.x, quad.to.side.x, -quad.to.side.x);
    vec4 y = vec4(quad.from.place.y, quad.from.place.y, quad.to.place.y, quad.to.place.y) +
             vec4(-quad.from.side.y, quad.from.side.y, quad.to.side.y, -quad.to.side.y);
    vec4 down = raster.columns ? x : y;
    vec4 across = raster.columns ? y : x;
    vec4 run = down.yzwx - down;
    vec4 rise = across.yzwx - across;
    float area = dot(down, across.yzwx - across.wxyz);
    // An edge parallel to the rows bounds which of them there are, `begin` to `end`, and nothing in
    // them. A row on it would otherwise end where the edge does.
    bvec4 parallel = lessThan(abs(run), vec4(1e-6));
    run = mix(area > 0.0 ? run : -run, vec4(1.0), parallel);
    if (area <= 0.0) rise = -rise;
    raster.lower = greaterThan(run, vec4(0.0));
    raster.slopes = mix(rise / run, vec4(0.0), parallel);
    raster.starts = mix(across - raster.slopes * down, vec4(-1.0), parallel);
    vec2 size = vec2(push.width, push.height);
    if (raster.columns) size = size.yx;
    raster.size = size.x;
    float first = clamp(least(down), -1.0, size.y);
    float last = clamp(most(down), -1.0, size.y);
    raster.begin = max(int(ceil(first * float(kSamples) - 0.5)), 0);
    raster.end = min(int(ceil(last * float(kSamples) - 0.5)), int(size.y) * int(kSamples));
    raster.row_length = 0.5 * abs(area) / max(last - first, 1.0);
}

// Depth is a plane through the middle line and the mean side.
void makeDepth(PieceQuad quad, vec2 run, inout RasterQuad raster) {
    vec2 side = 0.5 * (quad.from.side + quad.to.side);
    float area = cross2(run, side);
    float change = quad.to.depth - quad.from.depth;
    float side_change = 0.5 * (quad.from.side_depth + quad.to.side_depth);
    vec2 gradient = vec2(side.y * change - run.y * side_change,
                         run.x * side_change - side.x * change) /
                    (abs(area) < 1e-12 ? 1e-12 : area);
    raster.depth = quad.from.depth;
    raster.depth_range = depthRange(quad);
    raster.origin = raster.columns ? quad.from.place : quad.from.place.yx;
    raster.gradient = raster.columns ? gradient : gradient.yx;
}

RasterQuad setUpQuad(PieceQuad quad) {
    vec2 run = quad.to.place - quad.from.place;
    // Sides that cross on the screen do not form a quad.
    if (cross2(run, quad.from.side) * cross2(run, quad.to.side) < 0.0) {
        quad.to.side = -quad.to.side;
        quad.to.side_depth = -quad.to.side_depth;
    }
    RasterQuad raster;
    raster.columns = abs(run.x) > abs(run.y);
    makeEdges(quad, raster);
    makeDepth(quad, run, raster);
    return raster;
}

// Whether a whole work group rasterises the piece.
bool isLarge(RasterQuad raster) {
    float samples = float(raster.end - raster.begin) * (1.0 + raster.row_length);
    return samples > float(kLargePieceSamples);
}

// Takes a sample of the piece. `index`: its number in the pixel; `place`: its position, px. Whatever
// includes this file defines it.
void takeSample(PictureParameters picture, uint piece, uvec2 pixel, uint index, vec2 place,
                float depth);

// An invocation's share of a piece: every `step`-th row from row `first` of the piece on. Each row has
// `parts` equal parts, and the invocation takes part `part` of them.
struct RowShare {
    int first;
    int step;
    int part;
    int parts;
};

const RowShare kWholePiece = RowShare(0, 1, 0, 1);

// The share of invocation `place` of a work group that draws the piece: whole rows, or parts of them
// if there are fewer rows than invocations. So no invocation has a long row alone
// (kLargePieceSamples). `group` is gl_WorkGroupSize.x, which isn't known here, before its layout.
RowShare shareOfGroup(RasterQuad raster, int place, int group) {
    int parts = max(group / max(raster.end - raster.begin, 1), 1);
    return RowShare(place / parts, group / parts, place % parts, parts);
}

// Takes the samples of a share of a piece. The search for the next sample does not access memory, so
// that invocations that run together access memory together.
void rasterizeRows(PictureParameters picture, RasterQuad raster, RowShare share, uint piece) {
    uint places = raster.columns ? columnPositions() : rowPositions();
    uint samples = raster.columns ? columnSamples() : rowSamples();
    float across = 0.0;
    float end = -1.0;
    float depth = 0.0;
    int row = raster.begin + share.first - share.step;
    while (true) {
        while (!(across < end) && row + share.step < raster.end) {
            row += share.step;
            float down = (float(row) + 0.5) / float(kSamples);
            vec4 bounds = raster.starts + raster.slopes * down;
            float place = float(entry(places, uint(row) % kSamples)) / 16.0;
            float begin = most(mix(vec4(-1.0), bounds, raster.lower));
            across = max(ceil(begin - place), 0.0) + place;
            end = least(mix(bounds, vec4(raster.size), raster.lower));
            if (share.parts > 1) {
                float part = ceil((end - across) / float(share.parts));
                across += float(share.part) * part;
                end = min(end, across + part);
            }
            depth = raster.depth + raster.gradient.x * (down - raster.origin.x) +
                    raster.gradient.y * (across - raster.origin.y);
        }
        if (!(across < end)) return;
        uvec2 pixel = uvec2(uint(across), uint(row) / kSamples);
        vec2 place = vec2(across, (float(row) + 0.5) / float(kSamples));
        takeSample(picture, piece, raster.columns ? pixel.yx : pixel,
                   entry(samples, uint(row) % kSamples), raster.columns ? place.yx : place,
                   clamp(depth, raster.depth_range.x, raster.depth_range.y));
        across += 1.0;
        depth += raster.gradient.y;
    }
}

#endif
