#version 460
// The back end `rays`: a ray from the eye through each sample finds the nearest piece of a strand.
// Several work groups per row of pixels; an invocation has one pixel, because Mesa's lavapipe ends
// an invocation's loops after 65,535 iterations in all.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_ray_query : require
#include "common/depth.glsl"
#include "strands/software/piece_coordinates.glsl"
#include "strands/software/samples.glsl"
#include "strands/software/visibility.glsl"

layout(local_size_x_id = kGroupConstant) in;

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

// Returns a sample as in SoftwarePush::visibility. `scene` is its nearness without hair.
uvec2 nearestPiece(PictureParameters picture, vec2 place, uint scene) {
    const float kSlack = 1.001;  // of the scene's place: its depth decides
    SampleRay ray = rayThrough(picture, place);
    uint flags = kMergedHairs == 0 ? gl_RayFlagsOpaqueEXT : gl_RayFlagsNoOpaqueEXT;
    rayQueryEXT query;
    rayQueryInitializeEXT(query, accelerationStructureEXT(push.structure), flags, 0xffu,
                          picture.eye, placeOfDepth(ray, float(kNearDepth)), ray.along,
                          kSlack * placeOfDepth(ray, depthOf(scene)));
    while (rayQueryProceedEXT(query)) {
        if (kMergedHairs == 0) continue;
        uint piece = pieceOfTriangle(uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, false)));
        if (!isGap(picture, piece, place)) rayQueryConfirmIntersectionEXT(query);
    }
    uvec2 shown = uvec2(kNoPiece, scene);
    if (rayQueryGetIntersectionTypeEXT(query, true) !=
        gl_RayQueryCommittedIntersectionTriangleEXT)
        return shown;
    uint near = nearness(depthAt(ray, rayQueryGetIntersectionTEXT(query, true)));
    if (near > scene) return shown;
    return uvec2(pieceOfTriangle(uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, true))), near);
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
