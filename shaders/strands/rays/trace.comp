#version 460
// The back end `rays`: a ray from the eye through each sample finds the nearest piece of a strand.
// Several work groups per row of pixels; an invocation has one pixel, because Mesa's lavapipe ends
// an invocation's loops after 65,535 iterations in all.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_ray_query : require
#include "common/depth.glsl"
#include "strands/rays/round_cone.glsl"
#include "strands/software/piece_coordinates.glsl"
#include "strands/software/samples.glsl"
#include "strands/software/visibility.glsl"

layout(local_size_x_id = kGroupConstant) in;

// 1: the structure has boxes instead of triangles
layout(constant_id = kBoxesConstant) const uint kBoxes = 0;

// Returns the number of the piece that a triangle belongs to. Triangles are numbered
// [strand][segment][piece][2], for the finest level of detail; those of pieces that are not drawn
// have no area.
uint pieceOfTriangle(uint triangle) {
    uint quad = triangle / 2u;
    uint strand = quad / kPiecesPerStrand;
    uint place = quad % kPiecesPerStrand;
    uint pieces = piecesOf(StrandPieces(push.pieces).at[strand]);
    return firstPoint(strand, place / kMostPieces * pieces + place % kMostPieces, pieces);
}

// A ray from the eye whose parameter is w of clip space.
struct SampleRay {
    vec3 along;
    float depth_start;  // z of clip space at the eye
    float depth_rate;  // its change with w
};

// The points that a screen position, px, shows have x and y of clip space in proportion to w. Each
// proportion is a plane through the eye; the ray is where they meet.
SampleRay rayThrough(PictureParameters picture, vec2 place) {
    mat4 rows = transpose(picture.view_projection);
    vec2 clip = 2.0 * place / vec2(push.width, push.height) - 1.0;
    SampleRay ray;
    ray.along = cross(rows[0].xyz - clip.x * rows[3].xyz, rows[1].xyz - clip.y * rows[3].xyz);
    ray.along /= dot(rows[3].xyz, ray.along);
    ray.depth_start = dot(rows[2], vec4(picture.eye, 1.0));
    ray.depth_rate = dot(rows[2].xyz, ray.along);
    return ray;
}

// The depth at a parameter of the ray, and the parameter at a depth.
float depthAt(SampleRay ray, float w) { return ray.depth_start / w + ray.depth_rate; }
float placeOfDepth(SampleRay ray, float depth) {
    return ray.depth_start / (depth - ray.depth_rate);
}

// A piece and the parameter of the ray where it is.
struct FoundPiece {
    uint piece;  // kNoPiece: the ray meets none
    float w;
};

// The parameters between which a ray looks for pieces.
struct RayRange {
    float from;
    float to;
};

FoundPiece nearestOfTriangles(PictureParameters picture, vec2 place, SampleRay ray,
                              RayRange range) {
    uint flags = kMergedHairs == 0 ? gl_RayFlagsOpaqueEXT : gl_RayFlagsNoOpaqueEXT;
    rayQueryEXT query;
    rayQueryInitializeEXT(query, accelerationStructureEXT(push.structure), flags, 0xffu,
                          picture.eye, range.from, ray.along, range.to);
    while (rayQueryProceedEXT(query)) {
        if (kMergedHairs == 0) continue;
        uint piece = pieceOfTriangle(uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, false)));
        if (!isGap(picture, piece, place)) rayQueryConfirmIntersectionEXT(query);
    }
    if (rayQueryGetIntersectionTypeEXT(query, true) !=
        gl_RayQueryCommittedIntersectionTriangleEXT)
        return FoundPiece(kNoPiece, 0.0);
    return FoundPiece(
        pieceOfTriangle(uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, true))),
        rayQueryGetIntersectionTEXT(query, true));
}

// A round piece is met in the middle of the ray's chord, at the depth of the quads.
FoundPiece nearestOfBoxes(PictureParameters picture, vec2 place, SampleRay ray, RayRange range) {
    float rate = inversesqrt(dot(ray.along, ray.along));  // of the parameter, per metre
    FoundPiece found = FoundPiece(kNoPiece, range.to);
    rayQueryEXT query;
    rayQueryInitializeEXT(query, accelerationStructureEXT(push.structure), gl_RayFlagsNoneEXT,
                          0xffu, picture.eye, range.from, ray.along, range.to);
    while (rayQueryProceedEXT(query)) {
        uint box = uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, false));
        uint piece = StrandBoxes(push.boxes).at[box].piece;
        if (piece == kNoPiece) continue;
        RayChord chord =
            chordOf(picture.eye, rate * ray.along, coneOfPiece(push.points, piece));
        float w = rate * chordMiddle(chord);
        if (!isChord(chord) || w < range.from || w > found.w) continue;
        if (kMergedHairs != 0 && isGap(picture, piece, place)) continue;
        rayQueryGenerateIntersectionEXT(query, w);
        found = FoundPiece(piece, w);
    }
    return found;
}

// Returns a sample as in SoftwarePush::visibility. `scene` is its nearness without hair.
uvec2 nearestPiece(PictureParameters picture, vec2 place, uint scene) {
    const float kSlack = 1.001;  // of the scene's place: its depth decides
    SampleRay ray = rayThrough(picture, place);
    RayRange range = RayRange(placeOfDepth(ray, float(kNearDepth)),
                              kSlack * placeOfDepth(ray, depthOf(scene)));
    FoundPiece found = kBoxes == 0u ? nearestOfTriangles(picture, place, ray, range)
                                    : nearestOfBoxes(picture, place, ray, range);
    uvec2 shown = uvec2(kNoPiece, scene);
    if (found.piece == kNoPiece) return shown;
    uint near = nearness(depthAt(ray, found.w));
    if (near > scene) return shown;
    return uvec2(found.piece, near);
}

void main() {
    uvec2 low;
    uvec2 high;
    hairBounds(low, high);
    uvec2 pixel = uvec2(low.x, gl_WorkGroupID.x);
    pixel.x += gl_WorkGroupID.y * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (pixel.y < low.y || pixel.y >= high.y || pixel.x >= high.x) return;  // no barrier follows
    PictureParameters picture = PictureReference(push.picture).parameters;
    for (uint i = 0u; i < kSamples; ++i) {
        uint index = sampleIndex(pixel, i);
        uint scene = fetchVisibility(index).y;
        storePair(push.visibility, index,
                  nearestPiece(picture, vec2(pixel) + samplePosition(i), scene));
    }
}
