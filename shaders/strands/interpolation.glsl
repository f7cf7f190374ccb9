// Control points of a strand from those of the three guides of its root triangle: thesis 2.3.1 to
// 2.3.4. A strand's root is the same in all modes of interpolation.
#ifndef HAIRBENCH_STRAND_INTERPOLATION_GLSL
#define HAIRBENCH_STRAND_INTERPOLATION_GLSL

#include "strands/patch.glsl"
#include "strands/roots.glsl"

layout(buffer_reference, scalar) readonly buffer GuideContacts { float values[]; };

// Control point `index` of a guide, from -1 to vertices_per_guide. The two extra points
// mirror the neighbour of the first or last point about that point, so that the curve starts
// exactly at the root and ends exactly at the tip. The published program repeats the first and last
// points, and its hair floats off the scalp.
vec3 guideControlPoint(PictureParameters picture, uint guide, int index) {
    int last = int(picture.vertices_per_guide) - 1;
    int inside = clamp(index, 0, last);
    vec3 point = guideVertex(picture, guide, uint(inside));
    if (kCurve == kCurveBsplineUnpinned || inside == index) return point;
    int neighbour = index < 0 ? 1 : last - 1;
    precise vec3 reflected = 2.0 * point - guideVertex(picture, guide, uint(neighbour));
    return reflected;
}

// True if one of the guides touches a body at a vertex or above it. All vertices below a contact
// are marked too.
bool touchesBody(PictureParameters picture, uvec3 guides, int index) {
    uint vertex = uint(clamp(index, 0, int(picture.vertices_per_guide) - 1));
    uvec3 w = 4u * (guides * picture.vertices_per_guide + vertex) + 3u;
    GuideContacts contacts = GuideContacts(picture.contacts);
    return max(max(contacts.values[w.x], contacts.values[w.y]), contacts.values[w.z]) > 0.0;
}

// The shares, 0 to 1, by which the control points r(i-1) to r(i+2) of a segment follow one guide
// instead of all three. The curve stays smooth where they change.
vec4 singleShares(PictureParameters picture, uvec3 guides, uint segment) {
    if (kInterpolation == kInterpolationSingle) return vec4(1.0);
    vec4 shares = vec4(kInterpolation == kInterpolationMixed ? 1.0 - picture.blend : 0.0);
    if (kCollisionRule == 0) return shares;
    for (int k = 0; k < 4; ++k) {
        if (touchesBody(picture, guides, int(segment) + k - 1)) shares[k] = 1.0;
    }
    return shares;
}

vec3 mixGuides(vec3 weights, vec3 a, vec3 b, vec3 c) {
    precise vec3 sum = weights.x * a + weights.y * b + weights.z * c;  // strands/curve.glsl
    return sum;
}

// Computes r(i-1) to r(i+2) of a strand in a segment. points: [guide of the triangle][r(i-1) ..
// r(i+2)]
void strandControlPoints(PictureParameters picture, uvec3 guides, uint segment, vec3 weights,
                         vec3 points[12], vec4 single_shares, out vec3 r[4]) {
    for (int k = 0; k < 4; ++k) r[k] = mixGuides(weights, points[k], points[4 + k], points[8 + k]);
    if (kInterpolation == kInterpolationMulti && kCollisionRule == 0) return;

    vec3 roots[3];
    for (int corner = 0; corner < 3; ++corner)
        roots[corner] = guideVertex(picture, guides[corner], 0u);
    uint heaviest = heaviestCorner(weights);
    vec3 offset = mixGuides(weights, roots[0], roots[1], roots[2]) - roots[heaviest];
    for (int k = 0; k < 4; ++k)
        r[k] = mix(r[k], points[4u * heaviest + uint(k)] + offset, single_shares[k]);

    // If shares change at an end, the mean of reflected points is not the reflection.
    if (kCollisionRule == 0 || kCurve == kCurveBsplineUnpinned) return;
    precise vec3 before = 2.0 * r[1] - r[2];
    precise vec3 behind = 2.0 * r[2] - r[1];
    if (segment == 0u) r[0] = before;
    if (segment + 2u == picture.vertices_per_guide) r[3] = behind;
}

#endif
