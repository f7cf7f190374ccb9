// The quad of a piece of a strand on the screen, as in strands/quad.glsl, thesis 2.2. Define push
// constants with points, pieces, width and height first.
#ifndef HAIRBENCH_POINTS_QUAD_GLSL
#define HAIRBENCH_POINTS_QUAD_GLSL

#include "common/depth.glsl"
#include "common/picture.glsl"
#include "strands/points/points.glsl"

// A point of a strand on the screen: its middle, and the vector from there to the edge.
struct ScreenEnd {
    vec2 place;  // px
    vec2 side;
    float depth;
    float side_depth;  // change of depth from the middle to the edge
    float w;  // of clip space
};

// An end of a piece.
struct PieceEnd {
    vec3 position;  // m
    vec3 side;  // m, from the middle to an edge
    vec3 tangent;  // unit length
    vec4 middle_clip;
    vec4 side_clip;
    float beyond;  // distance of the nearer corner beyond the near plane, by pastNearPlane()
    ScreenEnd projected;  // valid if both corners are beyond the near plane
};

// Projects a middle and an edge from clip space.
ScreenEnd screenEnd(vec4 middle, vec4 side) {
    vec4 low = middle - side;
    vec4 high = middle + side;
    vec3 a = low.xyz / low.w;
    vec3 b = high.xyz / high.w;
    vec2 half_size = 0.5 * vec2(push.width, push.height);
    ScreenEnd end;
    end.place = (0.5 * (a.xy + b.xy) + 1.0) * half_size;
    end.side = 0.5 * (b.xy - a.xy) * half_size;
    end.depth = 0.5 * (a.z + b.z);
    end.side_depth = 0.5 * (b.z - a.z);
    end.w = middle.w;
    return end;
}

// `side`: m, from the middle to an edge.
PieceEnd pieceEnd(PictureParameters picture, PackedPoint point, vec3 side) {
    PieceEnd end;
    end.position = point.position;
    end.tangent = point.tangent;
    end.side = side;
    end.middle_clip = picture.view_projection * vec4(end.position, 1.0);
    end.side_clip = picture.view_projection * vec4(end.side, 0.0);
    end.beyond = pastNearPlane(end.middle_clip) - abs(pastNearPlane(end.side_clip));
    end.projected = screenEnd(end.middle_clip, end.side_clip);
    return end;
}

PieceEnd pieceEnd(PictureParameters picture, PackedPoint point) {
    vec3 side = cross(picture.eye - point.position, point.tangent);
    side *= 0.5 * point.width * inversesqrt(max(dot(side, side), 1e-30));
    return pieceEnd(picture, point, side);
}

// The part of a piece beyond the near plane. Corners run from -+ side at both ends.
struct PieceQuad {
    ScreenEnd from;
    ScreenEnd to;
    vec2 part;  // of the piece at `from` and `to`, 0 to 1
    bool visible;
};

PieceQuad pieceQuad(PieceEnd from, PieceEnd to) {
    PieceQuad quad = PieceQuad(from.projected, to.projected, vec2(0.0, 1.0), true);
    if (min(from.beyond, to.beyond) > 0.0) return quad;
    quad.visible = max(from.beyond, to.beyond) > 0.0;
    float crossing = from.beyond / (from.beyond - to.beyond);
    vec4 middle = mix(from.middle_clip, to.middle_clip, crossing);
    vec4 side = mix(from.side_clip, to.side_clip, crossing);
    if (from.beyond > 0.0) {
        quad.part.y = crossing;
        quad.to = screenEnd(middle, side);
    } else {
        quad.part.x = crossing;
        quad.from = screenEnd(middle, side);
    }
    return quad;
}

// The farthest and the nearest depth of a piece.
vec2 depthRange(PieceQuad quad) {
    float slack = max(abs(quad.from.side_depth), abs(quad.to.side_depth));
    return vec2(min(quad.from.depth, quad.to.depth) - slack,
                max(quad.from.depth, quad.to.depth) + slack);
}

// A piece; its number is that of its first point.
struct Piece {
    PieceEnd from;
    PieceEnd to;
    PieceQuad quad;
};

Piece pieceOf(PictureParameters picture, uint number) {
    Piece piece;
    piece.from = pieceEnd(picture, loadPoint(push.points, number));
    piece.to = pieceEnd(picture, loadPoint(push.points, number + 1u));
    piece.quad = pieceQuad(piece.from, piece.to);
    return piece;
}

float cross2(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

#endif
