// The guides and strands of patches.
#ifndef HAIRBENCH_STRAND_PATCH_GLSL
#define HAIRBENCH_STRAND_PATCH_GLSL

#include "common/picture.glsl"
#include "common/random.glsl"
#include "strands/lod.glsl"
#include "strands/options.glsl"

layout(buffer_reference, scalar) readonly buffer BoundStrands { BoundStrand strands[]; };
layout(buffer_reference, scalar) readonly buffer ClusterLevels { ClusterLevel at[]; };
layout(buffer_reference, scalar) readonly buffer StrandOrder { uint at[]; };

// One (root triangle, guide segment) pair, or a part of its strands. The strands of a groom count
// as those of one triangle, and a level of detail keeps the first of them. Each of them is a patch.
struct StrandPatch {
    uint triangle;
    uint key;           // random, of the triangle
    uint segment;
    uint first_strand;  // of the triangle
    StrandLod lod;
};

BoundStrand boundStrand(PictureParameters picture, uint strand) {
    return BoundStrands(picture.bound_strands).strands[strand];
}

bool followsHead(vec3 weights) { return kResiduals != 0 && weights == vec3(0.0); }

// The displacement of a groom's strand in addition to its guides. For a strand that follows only
// the head, it is the position of its root.
vec3 boundOffset(PictureParameters picture, BoundStrand bound) {
    precise vec3 offset = mat3(picture.head) * bound.offset;
    if (followsHead(bound.weights)) {
        precise vec3 root = offset + picture.head[3].xyz;
        offset = root;
    }
    return offset;
}

// Greatest distance of a groom's strand from the curve of its guides' mean.
float boundReach(PictureParameters picture, uint strand) {
    BoundStrand bound = boundStrand(picture, strand);
    return length(bound.offset) + (kResiduals != 0 ? bound.residual_reach : 0.0);
}

vec3 guideVertex(PictureParameters picture, uint guide, uint vertex) {
    return GuidePoints(picture.guides).points[guide * picture.vertices_per_guide + vertex].xyz;
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

// Returns the three guides of all strands of the patch.
uvec3 patchGuides(PictureParameters picture, StrandPatch strand_patch) {
    if (kSource == kSourceGroom) return boundStrand(picture, strand_patch.first_strand).guides;
    RootTriangles triangles = RootTriangles(picture.root_triangles);
    uint first = 3 * strand_patch.triangle;
    return uvec3(triangles.guides[first], triangles.guides[first + 1],
                 triangles.guides[first + 2]);
}

// The position that determines a patch's level of detail.
vec3 lodCentre(PictureParameters picture, StrandPatch strand_patch, uvec3 guides) {
    vec3 a = guideVertex(picture, guides.x, 0);
    vec3 b = guideVertex(picture, guides.y, 0);
    vec3 c = guideVertex(picture, guides.z, 0);
    if (kSource == kSourceGroom) {
        BoundStrand strand = boundStrand(picture, strand_patch.first_strand);
        precise vec3 root = strand.weights.x * a + strand.weights.y * b + strand.weights.z * c +
                            boundOffset(picture, strand);
        return root;
    }
    return (a + b + c) / 3.0;
}

StrandLod patchLod(PictureParameters picture, StrandPatch strand_patch, uvec3 guides) {
    if (kLodMode == kLodForced) return forcedLod(picture);
    if (kLodMode == kLodCluster)
        return lodOfCluster(picture,
                            ClusterLevels(picture.cluster_levels).at[strand_patch.triangle]);
    vec3 centre = lodCentre(picture, strand_patch, guides);
    return lodAtDistance(picture, distance(centre, picture.lod_eye));
}

// The number that a strand's random numbers come from. `index` is its place in the order in which
// levels of detail keep the strands of a triangle.
uint strandNumber(PictureParameters picture, uint triangle, uint index) {
    if (kLodMode != kLodCluster) return index;
    uint place = min(index, picture.density - 1u);  // a patch may have unused places
    return StrandOrder(picture.strand_order).at[triangle * picture.density + place];
}

// Number of the patch's strands that its level of detail draws; may be 0.
uint strandsInPatch(PictureParameters picture, StrandPatch strand_patch) {
    uint drawn = drawnStrands(strand_patch.lod);
    uint first = strand_patch.first_strand;
    return drawn > first ? min(drawn - first, picture.strands_per_patch) : 0u;
}

#endif
