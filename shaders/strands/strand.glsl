// Guides -> a point on a strand: the one function that every strand back end draws from.
// Interpolation between the three guides of a root triangle: thesis 2.3.2, equations (1) to (3).
#ifndef HAIRBENCH_STRAND_GLSL
#define HAIRBENCH_STRAND_GLSL

#include "common/picture.glsl"
#include "common/random.glsl"
#include "strands/curve.glsl"
#include "strands/lod.glsl"

const uint kCurveBspline = 0;
const uint kCurveBsplineUnpinned = 1;
const uint kTaperStrand = 0;
const uint kTaperSegment = 1;
const uint kLodForced = 0;

layout(constant_id = 0) const uint kCurve = kCurveBspline;
layout(constant_id = 1) const uint kTaper = kTaperStrand;
layout(constant_id = 2) const uint kLodMode = kLodForced;

// One (root triangle, guide segment) pair, or a part of its strands.
struct StrandPatch {
    uint triangle;
    uint key;           // random, of the triangle
    uint segment;
    uint first_strand;  // of the triangle
    StrandLod lod;
};

// A point on a strand as the geometry stage takes it.
struct StrandPoint {
    vec3 position;  // m
    vec3 tangent;   // d position / d t, not normalised
    float width;    // m
    float along;    // 0 at the root, 1 at the tip
};

uvec3 rootTriangle(PictureParameters picture, uint triangle) {
    RootTriangles triangles = RootTriangles(picture.root_triangles);
    return uvec3(triangles.guides[3 * triangle], triangles.guides[3 * triangle + 1],
                 triangles.guides[3 * triangle + 2]);
}

vec3 guideVertex(PictureParameters picture, uint guide, uint vertex) {
    return GuidePoints(picture.guides).points[guide * picture.vertices_per_guide + vertex].xyz;
}

// Control point `index` of a guide, -1 and vertices_per_guide included. Reflecting the second point
// in the end makes the curve start and end exactly at the root and the tip; the published program
// repeats the end, and its hair floats off the scalp.
vec3 guideControlPoint(PictureParameters picture, uint guide, int index) {
    int last = int(picture.vertices_per_guide) - 1;
    int inside = clamp(index, 0, last);
    vec3 point = guideVertex(picture, guide, uint(inside));
    if (kCurve == kCurveBsplineUnpinned || inside == index) return point;
    int neighbour = index < 0 ? 1 : last - 1;
    return 2.0 * point - guideVertex(picture, guide, uint(neighbour));
}

StrandLod triangleLod(PictureParameters picture, uvec3 guides) {
    if (kLodMode == kLodForced) return forcedLod(picture);
    vec3 centre = (guideVertex(picture, guides.x, 0) + guideVertex(picture, guides.y, 0) +
                   guideVertex(picture, guides.z, 0)) /
                  3.0;
    return lodAtDistance(picture, distance(centre, picture.eye));
}

// Patches are numbered [triangle][part][segment].
StrandPatch strandPatch(PictureParameters picture, uint patch_index) {
    uint segments = picture.vertices_per_guide - 1;
    uint part = patch_index / segments;
    StrandPatch result;
    result.segment = patch_index % segments;
    result.triangle = part / picture.patches_per_triangle;
    result.key = hash(picture.seed, result.triangle, kRootPurpose);
    result.first_strand = part % picture.patches_per_triangle * picture.strands_per_patch;
    return result;
}

// Strands of the patch that its level of detail draws; may be 0.
uint strandsInPatch(PictureParameters picture, StrandPatch strand_patch) {
    uint density = strand_patch.lod.density;
    uint first = strand_patch.first_strand;
    return density > first ? min(density - first, picture.strands_per_patch) : 0u;
}

// Area-uniform barycentric coordinates of a strand in its triangle: a random pair, folded (thesis
// 2.3.2). `key` differs between triangles; the published program has one pattern for all of them.
vec3 rootWeights(uint key, uint strand) {
    uint bits = pcg(key + strand);
    float u = unitFloat(bits);
    float v = unitFloat(pcg(bits));
    if (u > 1.0 - v) {  // the difference is exact, the sum u + v is not
        u = 1.0 - u;
        v = 1.0 - v;
    }
    return vec3(u, v, 1.0 - u - v);
}

// The scalp bulges out of its flat root triangles. edges[i] times the product of its corners'
// weights is the offset that the edge from corner i to corner i + 1 adds: half of the projection
// onto the corners' tangent planes (Boubekeur and Alexa 2008, Phong tessellation, with alpha = 1/2,
// which is exact to second order on a sphere).
struct RootLift {
    vec3 edges[3];
};

vec3 edgeLift(vec3 from, vec3 to, vec3 normal_from, vec3 normal_to) {
    vec3 edge = from - to;
    return 0.5 * (dot(edge, normal_from) * normal_from - dot(edge, normal_to) * normal_to);
}

RootLift rootLift(PictureParameters picture, uvec3 guides) {
    RootLift lift;
    for (int i = 0; i < 3; ++i) lift.edges[i] = vec3(0.0);
    if (picture.root_normals == 0) return lift;
    RootNormals root_normals = RootNormals(picture.root_normals);
    vec3 normals[3];
    for (int i = 0; i < 3; ++i) normals[i] = mat3(picture.head) * root_normals.normals[guides[i]];
    for (int i = 0; i < 3; ++i) {
        int next = (i + 1) % 3;
        lift.edges[i] = edgeLift(guideVertex(picture, guides[i], 0),
                                 guideVertex(picture, guides[next], 0), normals[i], normals[next]);
    }
    return lift;
}

// What a whole strand is moved by, so that its root is on the scalp.
vec3 strandLift(RootLift lift, vec3 weights) {
    return weights.x * weights.y * lift.edges[0] + weights.y * weights.z * lift.edges[1] +
           weights.z * weights.x * lift.edges[2];
}

// Control point k of the strand from control point k of its three guides.
vec3 mixGuides(vec3 weights, vec3 a, vec3 b, vec3 c) {
    return weights.x * a + weights.y * b + weights.z * c;
}

// The point at t in [0, 1] of a segment; r are the strand's control points r(i-1) to r(i+2).
StrandPoint pointOnStrand(PictureParameters picture, uint segment, float width_scale, vec3 r[4],
                          float t) {
    StrandPoint point;
    point.position = blend(splineWeights(t), r[0], r[1], r[2], r[3]);
    point.tangent = blend(splineSlopes(t), r[0], r[1], r[2], r[3]);
    point.along = (float(segment) + t) / float(picture.vertices_per_guide - 1);
    float taper = kTaper == kTaperSegment ? t : point.along;
    point.width = mix(picture.root_width, picture.tip_width, taper) * width_scale;
    return point;
}

#endif
