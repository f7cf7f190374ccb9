#version 460
// The back end `expanded`: a vertex is a corner of a quad and fetches its point. HAIRBENCH_SHADOW
// is for a light's map.
#extension GL_GOOGLE_include_directive : require
#include "common/depth.glsl"
#include "common/vectors.glsl"
#include "strands/points/merged.glsl"
#include "strands/points/points.glsl"
#include "strands/strand.glsl"
#ifdef HAIRBENCH_SHADOW
#include "shadows/quad.glsl"
#else
#include "strands/quad.glsl"
#endif

layout(push_constant, scalar) uniform Push { ExpandedPush push; };

layout(buffer_reference, scalar) readonly buffer VisibleStrands { uint at[]; };

// The value that replaces the position along a strand when the picture does not show shading.
float shownAlong(PictureParameters picture, uint strand, float along) {
    if (kShow != kShowLod && kShow != kShowStrands && kShow != kShowGroups) return along;
    uint triangle = strand / picture.forced_density;
    uint index = strand % picture.forced_density;
    uint part = triangle * picture.patches_per_triangle + index / picture.strands_per_patch;
    StrandPatch strand_patch = strandPatch(picture, part * kSegments);
    strand_patch.lod = patchLod(picture, strand_patch, patchGuides(picture, strand_patch));
    StrandPoint shown;
    putShown(picture, strand_patch, index, shown);
    return shown.along;
}

void main() {
    // Vertices are numbered [strand][point][corner], with the point count of the finest level.
    // Draws with direct arguments number all strands, with kExpandedStrands per instance.
    uint vertex = uint(gl_InstanceIndex) * kExpandedStrands * kPointsPerStrand * 2u +
                  uint(gl_VertexIndex);
    uint corner = vertex % 2u;
    uint place = vertex / 2u % kPointsPerStrand;
    uint strand = vertex / 2u / kPointsPerStrand;
    if (push.visible != kNoAddress) strand = VisibleStrands(push.visible).at[strand];
    uint stored = StrandPieces(push.pieces).at[strand];
    uint pieces = piecesOf(stored);
    gl_Position = kClippedPosition;
    if (pieces == 0u) return;

    // Pieces beyond those that are drawn have no length.
    uint segment = place / (kMostPieces + kSplitJoints);
    uint end = min(place % (kMostPieces + kSplitJoints), pieces);
    PackedPoint point = loadPoint(
        push.points, strand * kPointsPerStrand + segment * (pieces + kSplitJoints) + end);
    float along = (float(segment) + float(end) / float(pieces)) / float(kSegments);
    PictureParameters picture = PictureReference(push.picture).parameters;
    uint merged = kTellsHairs ? storedMerged(picture, strand, stored) : 0u;
    // Stored points have the drawn width, including gaps.
    float width = point.width / mergedSpread(merged);
    LineEnd line_end =
        LineEnd(point.position, point.tangent, width, shownAlong(picture, strand, along), merged);
    makeCorner(picture, line_end, quadEnd(picture, line_end), corner == 0u ? -1.0 : 1.0);
}
