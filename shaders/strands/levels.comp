#version 460
// Chooses the level of detail of each cluster, which has the strands of a root triangle, so that a
// picture differs from that of level 0 by a stated distance in pixels at most. One invocation per
// cluster. hair/rendering/points_pass.h has the bounds.
#extension GL_GOOGLE_include_directive : require
#include "strands/roots.glsl"

layout(local_size_x = kLevelsGroupSize) in;
layout(push_constant, scalar) uniform Push { LevelsPush push; };

layout(buffer_reference, scalar) readonly buffer Coverings { float at[]; };
layout(buffer_reference, scalar) writeonly buffer ChosenLevels { ClusterLevel at[]; };

// The part of the error that merging strands may take. Leaving out points takes the rest.
const float kMergedShare = 0.9;

// How far strands of a cluster may be from one another, from straight and from their guides, m.
struct ClusterShape {
    float apart;  // two guides, at one vertex
    float bend;  // second difference of a guide's points
    float beyond;  // how far strands reach beyond the convex hull of the guides' vertices
};

const bool kFollowsOne = kInterpolation != kInterpolationMulti || kCollisionRule != 0;

ClusterShape shapeOf(PictureParameters picture, StrandPatch strand_patch, uvec3 guides) {
    ClusterShape shape = ClusterShape(0.0, 0.0, 0.0);
    float longest = 0.0;  // segment
    float edge = 0.0;  // of the root triangle
    for (int corner = 0; corner < 3; ++corner) {
        uint guide = guides[corner];
        uint other = guides[(corner + 1) % 3];
        for (uint vertex = 0u; vertex < picture.vertices_per_guide; ++vertex) {
            vec3 here = guideVertex(picture, guide, vertex);
            // At the ends, the control points are those of strands/interpolation.glsl: unpinned
            // ones are repeated, and the others continue straight on.
            vec3 before = guideVertex(picture, guide, max(vertex, 1u) - 1u);
            vec3 behind =
                guideVertex(picture, guide, min(vertex + 1u, picture.vertices_per_guide - 1u));
            bool is_end = vertex == 0u || vertex + 1u == picture.vertices_per_guide;
            if (!is_end || kCurve == kCurveBsplineUnpinned)
                shape.bend = max(shape.bend, length(before - 2.0 * here + behind));
            longest = max(longest, distance(here, behind));
            float between = distance(here, guideVertex(picture, other, vertex));
            if (vertex == 0u) edge = max(edge, between);
            shape.apart = max(shape.apart, between);
        }
    }
    if (kCollisionRule != 0) shape.bend += 4.0 * (shape.apart + edge);
    if (kCurve == kCurveCatmullRom) {
        // The magnitudes of the weights add up to 1.25 at most, and those of the slopes' slopes to
        // three second differences.
        shape.apart *= 1.25;
        shape.bend *= 3.0;
        shape.beyond += 0.375 * longest;
    }
    RootLift lift = rootLift(picture, strand_patch, guides);
    float highest = max(max(length(lift.edges[0]), length(lift.edges[1])), length(lift.edges[2]));
    shape.apart += 4.0 * highest;
    shape.beyond += highest / 3.0 + push.reach + (kFollowsOne ? edge : 0.0);
    return shape;
}

// Returns how many pixels apart two points of the cluster in the picture can be, for each metre
// between them. For points P and Q at depths p and q, P / p - Q / q = (P - Q) / p + Q (q - p) / (q p),
// so a metre becomes at most sqrt(1 + |Q / q|^2) / p. Infinite if a point may be behind the eye.
float pixelsPerMetre(PictureParameters picture, uvec3 guides, float beyond) {
    float nearest = 1e30;
    vec2 slope = vec2(0.0);  // greatest |Q / q|
    for (int corner = 0; corner < 3; ++corner) {
        for (uint vertex = 0u; vertex < picture.vertices_per_guide; ++vertex) {
            vec4 clip =
                picture.view_projection * vec4(guideVertex(picture, guides[corner], vertex), 1.0);
            float depth = clip.w - beyond;
            if (!(depth > 0.0)) return 1e30;
            nearest = min(nearest, depth);
            slope = max(slope, (abs(clip.xy) * push.slopes + beyond) / depth);
        }
    }
    slope = min(slope, push.slopes);  // what is outside the picture doesn't matter
    // Corners of wide strands are nearer than their middle, by less than the error.
    nearest *= max(1.0 - push.error * picture.pixel_slope, 0.1);
    return sqrt(1.0 + dot(slope, slope)) / (nearest * picture.pixel_slope);
}

void main() {
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uint cluster = group * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (cluster >= push.clusters) return;  // no barrier follows

    PictureParameters picture = PictureReference(push.picture).parameters;
    uint patches = picture.patches_per_triangle * (picture.vertices_per_guide - 1u);
    StrandPatch strand_patch = strandPatch(picture, cluster * patches);
    uvec3 guides = patchGuides(picture, strand_patch);
    ClusterShape shape = shapeOf(picture, strand_patch, guides);
    float scale = pixelsPerMetre(picture, guides, shape.beyond);

    float all = float(picture.density);
    float finest = float(picture.tessellation);
    ClusterLevel level = ClusterLevel(all, finest);
    // Offsets may move each of two strands, or of two points, apart by their reach.
    float offsets = 2.0 * push.reach * scale;
    float merged = kMergedShare * push.error - offsets;
    float left_out = (1.0 - kMergedShare) * push.error - offsets;
    if (merged > 0.0) {
        float root = Coverings(push.coverings).at[cluster] * shape.apart * scale / merged;
        float width = max(push.greatest_width * scale, 1e-9);  // px
        float spread = kMergedHairs != 0 ? kMostMergedSpread : 1.0;
        float widest = (1.0 + 2.0 * kMergedShare * push.error / width) / spread;
        float least = max(all / max(widest, 1.0), all * picture.least_density_scale);
        level.strands = clamp(max(root * root, least), 1.0, all);
    }
    if (left_out > 0.0)
        level.pieces = clamp(sqrt(shape.bend * scale / (8.0 * left_out)), 1.0, finest);
    ChosenLevels(push.levels).at[cluster] = level;
}
