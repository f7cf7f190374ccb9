// Guides -> a point on a strand: the one function that every strand back end draws from.
// Interpolation between the three guides of a root triangle: thesis 2.3.2, equations (1) to (3).
#ifndef HAIRBENCH_STRAND_GLSL
#define HAIRBENCH_STRAND_GLSL

#include "common/picture.glsl"
#include "strands/curve.glsl"
#include "strands/offsets.glsl"
#include "strands/patch.glsl"
#include "strands/roots.glsl"

layout(buffer_reference, scalar) readonly buffer GuideWidths { float widths[]; };

// One strand of a patch.
struct PatchStrand {
    uint index;    // of the triangle
    uvec3 guides;
    vec3 weights;  // of the guides
    vec3 lift;     // m, of the whole strand
    vec3 r[4];     // control points r(i-1) to r(i+2), without the lift
};

// A point on a strand as the geometry stage takes it.
struct StrandPoint {
    vec3 position;  // m
    vec3 tangent;   // d position / d t, not normalised
    float width;    // m
    float along;    // 0 at the root, 1 at the tip
};

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

// Control point k of the strand from control point k of its three guides.
vec3 mixGuides(vec3 weights, vec3 a, vec3 b, vec3 c) {
    return weights.x * a + weights.y * b + weights.z * c;
}

float guideWidth(PictureParameters picture, PatchStrand strand, uint vertex) {
    GuideWidths guides = GuideWidths(picture.guide_widths);
    uvec3 at = strand.guides * picture.vertices_per_guide + vertex;
    return dot(strand.weights, vec3(guides.widths[at.x], guides.widths[at.y],
                                    guides.widths[at.z]));
}

// At t of a segment, at level 0 of detail.
float strandWidth(PictureParameters picture, PatchStrand strand, uint segment, float t,
                  float along) {
    if (kWidth == kWidthGroom) {
        return (1.0 - t) * guideWidth(picture, strand, segment) +
               t * guideWidth(picture, strand, segment + 1u);
    }
    float taper = kTaper == kTaperSegment ? t : along;
    return mix(picture.root_width, picture.tip_width, taper);
}

// Moves a point of the smooth strand. That the frame turns along the strand is left out of the
// tangent: it is the curvature times the offset, small beside 1.
void offsetPoint(PictureParameters picture, StrandPatch strand_patch, PatchStrand strand, float t,
                 inout StrandPoint point) {
    uint profile =
        hash(strand_patch.key, strand.index, kOffsetPurpose) % picture.offset_profiles;
    StrandOffset offset = strandOffset(picture, profile, point.along);
    uint guide = frameGuide(strand.guides, strand.weights);
    mat3 frame = strandFrame(picture, guide, strand_patch.segment, t, point.tangent);
    point.position += frame * offset.value;
    point.tangent += frame * (offset.slope / float(picture.vertices_per_guide - 1));
}

// The point at t in [0, 1] of a patch's segment.
StrandPoint pointOnStrand(PictureParameters picture, StrandPatch strand_patch, PatchStrand strand,
                          float t) {
    StrandPoint point;
    vec3 r[4] = strand.r;
    point.position = blend(splineWeights(t), r[0], r[1], r[2], r[3]);
    point.tangent = blend(splineSlopes(t), r[0], r[1], r[2], r[3]);
    point.along =
        (float(strand_patch.segment) + t) / float(picture.vertices_per_guide - 1);
    point.width = strandWidth(picture, strand, strand_patch.segment, t, point.along) *
                  strand_patch.lod.width_scale;
    point.position += strand.lift;
    if (kOffsets != 0) offsetPoint(picture, strand_patch, strand, t, point);
    return point;
}

// The same for who evaluates one point at a time, from the guides themselves.
StrandPoint pointFromGuides(PictureParameters picture, StrandPatch strand_patch, uvec3 guides,
                            uint index, float t) {
    PatchStrand strand;
    strand.index = index;
    strand.guides = guides;
    strand.weights = strandWeights(picture, strand_patch.key, index);
    strand.lift = strandLift(rootLift(picture, strand_patch, guides), strand.weights);
    for (int k = 0; k < 4; ++k) {
        int control = int(strand_patch.segment) + k - 1;
        strand.r[k] = mixGuides(strand.weights, guideControlPoint(picture, guides.x, control),
                                guideControlPoint(picture, guides.y, control),
                                guideControlPoint(picture, guides.z, control));
    }
    return pointOnStrand(picture, strand_patch, strand, t);
}

#endif
