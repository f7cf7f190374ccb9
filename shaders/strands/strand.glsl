// Evaluates a point on a strand from guides. All strand back ends draw from this function.
#ifndef HAIRBENCH_STRAND_GLSL
#define HAIRBENCH_STRAND_GLSL

#include "common/picture.glsl"
#include "extension/curve.glsl"
#include "extension/offset.glsl"
#include "extension/turns.glsl"
#include "shading/options.glsl"
#include "strands/collision.glsl"
#include "strands/curve.glsl"
#include "strands/interpolation.glsl"
#include "strands/merged_word.glsl"
#include "strands/offsets.glsl"
#include "strands/patch.glsl"
#include "strands/residuals.glsl"
#include "strands/roots.glsl"

layout(buffer_reference, scalar) readonly buffer GuideWidths { float widths[]; };
layout(buffer_reference, scalar) readonly buffer RootCorrections { vec4 at[]; };
layout(buffer_reference, scalar) readonly buffer GroupShades { float at[]; };

// One strand of a patch.
struct PatchStrand {
    uint index;    // of the triangle, in the order in which levels of detail keep its strands
    uvec3 guides;
    vec3 weights;  // of the guides
    vec3 lift;     // m, displacement of the whole strand
    vec3 r[4];     // control points r(i-1) to r(i+2), without the lift
};

// A point on a strand as input of the geometry stage.
struct StrandPoint {
    vec3 position;  // m
    vec3 tangent;   // d position / d t, not normalised
    float width;    // m
    float along;    // 0 at the root, 1 at the tip; or the value that is shown instead
    uint merged;    // strands/merged_word.glsl; set if kTellsHairs
};

float guideWidth(PictureParameters picture, PatchStrand strand, uint vertex) {
    GuideWidths guides = GuideWidths(picture.guide_widths);
    uvec3 at = strand.guides * picture.vertices_per_guide + vertex;
    return dot(strand.weights, vec3(guides.widths[at.x], guides.widths[at.y],
                                    guides.widths[at.z]));
}

// The width at t of a segment, at level of detail 0.
float strandWidth(PictureParameters picture, PatchStrand strand, uint segment, float t,
                  float along) {
    if (kWidth == kWidthGroom) {
        precise float width = (1.0 - t) * guideWidth(picture, strand, segment) +
                              t * guideWidth(picture, strand, segment + 1u);
        return width;
    }
    float taper = kTaper == kTaperSegment ? t : along;
    taper = max(taper - picture.taper_start, 0.0) / max(1.0 - picture.taper_start, 1e-6);
    return mix(picture.root_width, picture.tip_width, taper);
}

// Moves a point of the smooth strand. The tangent ignores the frame's rotation along the strand: it
// is the curvature times the offset, small compared with 1.
void offsetPoint(PictureParameters picture, StrandPatch strand_patch, PatchStrand strand, float t,
                 inout StrandPoint point) {
    uint strand_number = strandNumber(picture, strand_patch.triangle, strand.index);
    uint profile =
        hash(strand_patch.key, strand_number, kOffsetPurpose) % picture.offset_profiles;
    StrandOffset offset = strandOffset(picture, profile, point.along);
    uint guide = strand.guides[heaviestCorner(strand.weights)];
    mat3 frame = strandFrame(picture, guide, strand_patch.segment, t, point.tangent);
    precise vec3 position = point.position + frame * offset.value;  // strands/curve.glsl
    precise vec3 tangent =
        point.tangent + frame * (offset.slope / float(picture.vertices_per_guide - 1));
    point.position = position;
    point.tangent = tangent;
}

#ifdef HAIRBENCH_EXTENDED_OFFSET

layout(constant_id = kOffsetReachConstant) const float kOffsetReach = 0.0;  // m

float hairRandom(HairPlace place, uint which) {
    return random01(place.strand, which, kExtensionPurpose);
}

// Limits the offset to the length that the host assumes.
vec3 boundedOffset(HairPlace place) {
    beginTurns();
    vec3 offset = offsetHair(place);
    float size = length(offset);
    if (!(size <= 1e30)) return vec3(0.0);  // NaN or infinite
    return size > kOffsetReach ? offset * (kOffsetReach / size) : offset;
}

// Moves a point by a function from the scene. Its slope is a difference between two positions
// beside the point.
void extendPoint(PictureParameters picture, StrandPatch strand_patch, PatchStrand strand, float t,
                 inout StrandPoint point) {
    const float kBeside = 1.0 / 1024.0;  // of the strand
    uint number = hash(strand_patch.key,
                       strandNumber(picture, strand_patch.triangle, strand.index),
                       kExtensionPurpose);
    float from = max(point.along - kBeside, 0.0);
    float to = min(point.along + kBeside, 1.0);
    vec3 value = boundedOffset(HairPlace(point.along, number));
    vec3 slope = (boundedOffset(HairPlace(to, number)) - boundedOffset(HairPlace(from, number))) /
                 (to - from);
    uint guide = strand.guides[heaviestCorner(strand.weights)];
    mat3 frame = strandFrame(picture, guide, strand_patch.segment, t, point.tangent);
    precise vec3 position = point.position + frame * value;  // strands/curve.glsl
    precise vec3 tangent =
        point.tangent + frame * (slope / float(picture.vertices_per_guide - 1));
    point.position = position;
    point.tangent = tangent;
}

#endif

// Moves a point of the guides' mean to the file's strand. As above, the tangent ignores the change
// of the rotation along the strand, which is 0 at rest. A strand that follows only the head is its
// root plus its residual.
void addResidual(PictureParameters picture, StrandPatch strand_patch, PatchStrand strand, float t,
                 inout StrandPoint point) {
    BoundStrand bound = boundStrand(picture, strand.index);
    StrandOffset residual = strandResidual(picture, bound, point.along);
    point.width *= bound.width;
    if (followsHead(bound.weights)) {
        mat3 head = mat3(picture.head);
        precise vec3 place = strand.lift + head * residual.value;  // strands/curve.glsl
        precise vec3 along = head * (residual.slope / float(picture.vertices_per_guide - 1));
        point.position = place;
        point.tangent = along;
        return;
    }
    vec4 turn = strandTurn(picture, strand.guides, strand.weights, strand_patch.segment, t);
    precise vec3 position = point.position + turnedBy(turn, residual.value);  // strands/curve.glsl
    precise vec3 slope = residual.slope / float(picture.vertices_per_guide - 1);
    precise vec3 tangent = point.tangent + turnedBy(turn, slope);
    point.position = position;
    point.tangent = tangent;
}

// Moves a strand's root to its own triangle of the deformed mesh. The rest of the strand moves
// along, less and less towards the tip.
void correctRoot(PictureParameters picture, StrandPatch strand_patch, PatchStrand strand,
                 inout StrandPoint point) {
    // A patch may have unused places.
    uint index = strand_patch.triangle * picture.density + min(strand.index, picture.density - 1u);
    vec3 correction = RootCorrections(picture.root_corrections).at[index].xyz;
    precise float left = 1.0 - point.along;
    precise vec3 position = point.position + left * left * correction;  // strands/curve.glsl
    precise vec3 tangent =
        point.tangent - 2.0 * left / float(picture.vertices_per_guide - 1) * correction;
    point.position = position;
    point.tangent = tangent;
}

#ifdef HAIRBENCH_EXTENDED_CURVE

// Calls a function from the scene. Limits the point to the distance from the segment's line that
// culling assumes (strands/outside.glsl).
HairCurvePoint extendedCurve(PictureParameters picture, uint segment, vec3 r[4], float t) {
    beginTurns();
    HairCurvePoint curve = curveHair(
        HairSegment(r[0], r[1], r[2], r[3], segment, picture.vertices_per_guide - 1u), t);
    float longest = max(max(distance(r[0], r[1]), distance(r[1], r[2])), distance(r[2], r[3]));
    vec3 place = mix(r[1], r[2], t);
    float away = distance(curve.position, place);
    if (!(away <= 1e30)) curve.position = place;  // NaN or infinite
    else if (away > longest) curve.position = place + longest / away * (curve.position - place);
    if (!(length(curve.tangent) <= 1e30)) curve.tangent = r[2] - r[1];
    return curve;
}

#endif

vec4 curveWeights(float t) {
    return kCurve == kCurveCatmullRom ? interpolationWeights(t) : splineWeights(t);
}

vec4 curveSlopes(float t) {
    return kCurve == kCurveCatmullRom ? interpolationSlopes(t) : splineSlopes(t);
}

// Returns the word for the hairs that a strand stands for.
uint strandMerged(PictureParameters picture, StrandPatch strand_patch, uint index) {
    StrandLod lod = strand_patch.lod;
    uint number = strandNumber(picture, strand_patch.triangle, index);
    return mergedWord(lod.width_scale * strandShare(lod, index),
                      hash(strand_patch.key, number, kMergedPurpose));
}

// Returns the point at t in [0, 1] of a patch's segment.
StrandPoint pointOnStrand(PictureParameters picture, StrandPatch strand_patch, PatchStrand strand,
                          float t) {
    StrandPoint point;
    vec3 r[4] = strand.r;
#ifdef HAIRBENCH_EXTENDED_CURVE
    HairCurvePoint curve = extendedCurve(picture, strand_patch.segment, r, t);
    point.position = curve.position;
    point.tangent = curve.tangent;
#else
    point.position = blend(curveWeights(t), r[0], r[1], r[2], r[3]);
    point.tangent = blend(curveSlopes(t), r[0], r[1], r[2], r[3]);
#endif
    point.along =
        (float(strand_patch.segment) + t) / float(picture.vertices_per_guide - 1);
    point.width = strandWidth(picture, strand, strand_patch.segment, t, point.along) *
                  strand_patch.lod.width_scale * strandShare(strand_patch.lod, strand.index);
    point.position += strand.lift;
    if (kOffsets != 0) offsetPoint(picture, strand_patch, strand, t, point);
    if (kResiduals != 0) addResidual(picture, strand_patch, strand, t, point);
#ifdef HAIRBENCH_EXTENDED_OFFSET
    extendPoint(picture, strand_patch, strand, t, point);
#endif
    if (kSkinnedStrands != 0) correctRoot(picture, strand_patch, strand, point);
    return point;
}

// True if a strand's point depends on the root triangle itself, beyond its guides' points.
const bool kNeedsTriangle =
    kSkinnedStrands != 0 || kShow == kShowGroups || kLodMode == kLodCluster;

// Returns the shade of the group that a patch's strands belong to: that of the groom's own strand,
// or of the first guide.
float groupShade(PictureParameters picture, StrandPatch strand_patch) {
    if (picture.group_shades == kNoAddress) return 0.0;
    uint at = kSource == kSourceGroom ? strand_patch.first_strand
                                      : patchGuides(picture, strand_patch).x;
    return GroupShades(picture.group_shades).at[at];
}

// Replaces the position along the strand by the value, in [0, 1], that /render/show selects for a
// whole strand. This costs nothing if nothing is selected.
void putShown(PictureParameters picture, StrandPatch strand_patch, uint index,
              inout StrandPoint point) {
    if (kShow == kShowLod)
        point.along = strand_patch.lod.level / max(picture.lod_maximum_level, 1e-6);
    if (kShow == kShowStrands) {
        uint number = strandNumber(picture, strand_patch.triangle, index);
        point.along = random01(strand_patch.key, number, kColorPurpose);
    }
    if (kShow == kShowGroups) point.along = groupShade(picture, strand_patch);
}

// Returns end number `index` of a patch's drawn pieces.
StrandPoint drawnPoint(PictureParameters picture, StrandPatch strand_patch, PatchStrand strand,
                       uint index) {
    StrandLod lod = strand_patch.lod;
    StrandPoint point = pointOnStrand(picture, strand_patch, strand, pieceEnd(lod, index));
    uint past = index % lod.step;
    if (kLodMorph != 0 && lod.morph < 1.0 && past != 0u) {
        float from = pieceEnd(lod, index - past);
        float to = pieceEnd(lod, index - past + lod.step);
        StrandPoint a = pointOnStrand(picture, strand_patch, strand, from);
        StrandPoint b = pointOnStrand(picture, strand_patch, strand, to);
        float part = float(past) / float(lod.step);
        point.position = mix(mix(a.position, b.position, part), point.position, lod.morph);
        point.tangent = mix(mix(a.tangent, b.tangent, part), point.tangent, lod.morph);
        point.width = mix(mix(a.width, b.width, part), point.width, lod.morph);
    }
    if (kStrandCollision == kStrandCollisionPushOut && !followsHead(strand.weights)) {
        float along_guides = float(strand_patch.segment) + pieceEnd(lod, index);
        pushStrandOut(picture, along_guides, point.position, point.tangent);
    }
    putShown(picture, strand_patch, strand.index, point);
    if (kTellsHairs) point.merged = strandMerged(picture, strand_patch, strand.index);
    return point;
}

// Builds a strand of a patch directly from the guides, for stages that work on one point at a time.
PatchStrand strandFromGuides(PictureParameters picture, StrandPatch strand_patch, uvec3 guides,
                             uint index) {
    PatchStrand strand;
    strand.index = index;
    strand.guides = guides;
    strand.weights = strandWeights(picture, strand_patch, index);
    strand.lift = strandLift(rootLift(picture, strand_patch, guides), strand.weights);
    uint segment = strand_patch.segment;
    vec3 points[12];
    for (int corner = 0; corner < 3; ++corner) {
        for (int k = 0; k < 4; ++k) {
            points[4 * corner + k] =
                guideControlPoint(picture, guides[corner], int(segment) + k - 1);
        }
    }
    strandControlPoints(picture, guides, segment, strand.weights, points,
                        singleShares(picture, guides, segment), strand.r);
    return strand;
}

// Returns a point of a strand from strandFromGuides().
StrandPoint pointFromGuides(PictureParameters picture, StrandPatch strand_patch, uvec3 guides,
                            uint index, uint piece_end) {
    PatchStrand strand = strandFromGuides(picture, strand_patch, guides, index);
    return drawnPoint(picture, strand_patch, strand, piece_end);
}

#endif
