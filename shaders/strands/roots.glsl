// Positions of strands' roots between three guides.
#ifndef HAIRBENCH_STRAND_ROOTS_GLSL
#define HAIRBENCH_STRAND_ROOTS_GLSL

#include "strands/patch.glsl"

layout(buffer_reference, scalar) readonly buffer RootPattern { vec2 pairs[]; };

// A random pair in [0, 1), multiples of 2^-24. `key` differs between triangles. The published
// program uses one pattern for all of them.
vec2 rootPair(PictureParameters picture, uint key, uint strand) {
    if (kRandomness == kRandomnessThesis) {
        uint drawn = min(strand, picture.density - 1u);  // a patch may have unused places
        return RootPattern(picture.root_pattern).pairs[drawn];
    }
    uint bits = pcg(key + strand);
    return vec2(unitFloat(bits), unitFloat(pcg(bits)));
}

// Area-uniform barycentric coordinates of a strand in its triangle: a random pair, folded (thesis
// 2.3.2).
vec3 rootWeights(vec2 pair) {
    float u = pair.x;
    float v = pair.y;
    if (u > 1.0 - v) {  // the difference is exact, the sum u + v is not
        u = 1.0 - u;
        v = 1.0 - v;
    }
    return vec3(u, v, 1.0 - u - v);
}

vec3 strandWeights(PictureParameters picture, StrandPatch strand_patch, uint index) {
    if (kSource == kSourceGroom) return boundStrand(picture, index).weights;
    uint number = strandNumber(picture, strand_patch.triangle, index);
    return rootWeights(rootPair(picture, strand_patch.key, number));
}

// The corner whose guide has the greatest weight. The medians cut a triangle into thirds; it is the
// corner of the third that contains the strand's root.
uint heaviestCorner(vec3 weights) {
    if (weights.x >= weights.y && weights.x >= weights.z) return 0u;
    return weights.y >= weights.z ? 1u : 2u;
}

// The scalp bulges out of its flat root triangles. edges[i] times the product of its corners'
// weights is the offset that the edge from corner i to corner i + 1 adds. It is half of the
// projection onto the corners' tangent planes (Boubekeur and Alexa 2008, Phong tessellation, with
// alpha = 1/2, which is exact to second order on a sphere). A strand of the groom knows its root:
// edges[0] is its offset, and the others are 0.
struct RootLift {
    vec3 edges[3];
};

vec3 edgeLift(vec3 from, vec3 to, vec3 normal_from, vec3 normal_to) {
    vec3 edge = from - to;
    precise vec3 lift =
        0.5 * (dot(edge, normal_from) * normal_from - dot(edge, normal_to) * normal_to);
    return lift;
}

RootLift rootLift(PictureParameters picture, StrandPatch strand_patch, uvec3 guides) {
    RootLift lift;
    for (int i = 0; i < 3; ++i) lift.edges[i] = vec3(0.0);
    if (kSource == kSourceGroom) {
        lift.edges[0] =
            boundOffset(picture, boundStrand(picture, strand_patch.first_strand));
        return lift;
    }
    if (picture.root_normals == kNoAddress) return lift;
    RootNormals root_normals = RootNormals(picture.root_normals);
    precise vec3 normals[3];
    for (int i = 0; i < 3; ++i) normals[i] = mat3(picture.head) * root_normals.normals[guides[i]];
    for (int i = 0; i < 3; ++i) {
        int next = (i + 1) % 3;
        lift.edges[i] = edgeLift(guideVertex(picture, guides[i], 0),
                                 guideVertex(picture, guides[next], 0), normals[i], normals[next]);
    }
    return lift;
}

// The displacement of a whole strand that puts its root on the scalp.
vec3 strandLift(RootLift lift, vec3 weights) {
    if (kSource == kSourceGroom) return lift.edges[0];
    precise vec3 sum = weights.x * weights.y * lift.edges[0] +
                       weights.y * weights.z * lift.edges[1] +
                       weights.z * weights.x * lift.edges[2];  // strands/curve.glsl
    return sum;
}

#endif
