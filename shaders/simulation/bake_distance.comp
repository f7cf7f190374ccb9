#version 460
// Computes signed distances to a surface in two dispatches. The first treats the middles of blocks
// of grid points. They tell which points need no search and bound the search of the others. The
// second treats the points: one invocation per point, one work group per block. A depth-first
// search of a bounding volume hierarchy finds the nearest triangle and visits the nearer child
// first. For a closed surface, the sign is that of the pseudonormal of the nearest feature
// (Baerentzen and Aanaes 2005, Signed distance computation using the angle weighted pseudonormal).
// For others it is computed beforehand (bake_winding.comp).
#extension GL_GOOGLE_include_directive : require

#include "common/extensions.glsl"
#include "common/nearest_on_triangle.glsl"
#include "shared/distance_field_structs.h"
#include "simulation/bake_blocks.glsl"

layout(local_size_x = kBakeBlock * kBakeBlock * kBakeBlock) in;

layout(push_constant, scalar) uniform Push { BakeDistancePush push; };

layout(buffer_reference, scalar) readonly buffer Nodes { BvhNode at[]; };
layout(buffer_reference, scalar) readonly buffer Triangles { BvhTriangle at[]; };
layout(buffer_reference, scalar) readonly buffer Normals { TriangleNormals at[]; };
layout(buffer_reference, scalar) readonly buffer Sides { float at[]; };
layout(buffer_reference, scalar) buffer Middles { BlockMiddle at[]; };
layout(buffer_reference, scalar) writeonly buffer Distances { float at[]; };

// The squared distance to a box; 0 inside.
float boxDistance(vec3 p, vec3 lower, vec3 upper) {
    vec3 apart = max(max(lower - p, p - upper), vec3(0.0));
    return dot(apart, apart);
}

vec3 pseudonormal(TriangleNormals normals, uint feature) {
    if (feature == kFaceFeature) return normals.face;
    return feature < kCornerFeatures ? normals.edges[feature - kEdgeFeatures]
                                     : normals.corners[feature - kCornerFeatures];
}

// Returns the distance to the surface, signed if the normals give the sign. `most` must exceed the
// distance, m. `found` is a nearest triangle.
float distanceTo(vec3 p, float most, out uint found) {
    Nodes nodes = Nodes(push.nodes);
    Triangles triangles = Triangles(push.triangles);
    Nearest nearest = Nearest(vec3(0.0), most * most, kFaceFeature);
    found = 0u;

    uint stack[kBvhDepth];
    float stack_distance[kBvhDepth];
    uint depth = 0u;
    uint node = 0u;
    float node_distance = 0.0;
    while (true) {
        if (node_distance < nearest.size) {
            uint first = nodes.at[node].first;
            uint count = nodes.at[node].count;
            if (count == 0u) {
                float left = boxDistance(p, nodes.at[first].lower, nodes.at[first].upper);
                float right =
                    boxDistance(p, nodes.at[first + 1u].lower, nodes.at[first + 1u].upper);
                bool left_first = left <= right;
                stack[depth] = left_first ? first + 1u : first;
                stack_distance[depth] = max(left, right);
                ++depth;
                node = left_first ? first : first + 1u;
                node_distance = min(left, right);
                continue;
            }
            for (uint i = first; i < first + count; ++i) {
                float before = nearest.size;
                compareTriangle(p, triangles.at[i].corners, triangles.at[i].normal, nearest);
                if (nearest.size < before) found = i;
            }
        }
        if (depth == 0u) break;
        --depth;
        node = stack[depth];
        node_distance = stack_distance[depth];
    }

    if (push.sides != kNoAddress) return sqrt(nearest.size);
    vec3 normal = pseudonormal(Normals(push.normals).at[found], nearest.feature);
    return dot(nearest.outward, normal) < 0.0 ? -sqrt(nearest.size) : sqrt(nearest.size);
}

vec3 middleOf(uint block) {
    vec3 block_place = vec3(placeOf(block, push.blocks));
    vec3 place = float(kBakeBlock) * block_place + 0.5 * float(kBakeBlock - 1u);
    return push.field.origin + push.field.cell * place;
}

void findMiddle(uint lane) {
    if (lane >= push.block_count) return;
    uint block = push.first_block + lane;
    uint triangle;
    float distance = distanceTo(middleOf(block), 1.0e19, triangle);
    Middles(push.middles).at[block] = BlockMiddle(distance, triangle);
}

void findPoint(uint group) {
    uint block = push.first_block + group;
    uvec3 point = kBakeBlock * placeOf(block, push.blocks) + pointInBlock(gl_LocalInvocationID.x);
    if (group >= push.block_count || any(greaterThanEqual(point, push.field.points))) return;

    vec3 p = push.field.origin + push.field.cell * vec3(point);
    uint index = point.x + push.field.points.x * (point.y + push.field.points.y * point.z);
    BlockMiddle middle = Middles(push.middles).at[block];
    float reach = 0.5 * sqrt(3.0) * float(kBakeBlock - 1u) * push.field.cell;
    float side = push.sides != kNoAddress ? Sides(push.sides).at[index] : 1.0;
    float found = middle.distance - reach;  // at most the distance, except for rounding
    if (found <= push.band || side < 0.0) {
        // The triangle nearest to the middle gives an upper bound of the distance. Rounding errors
        // are below a quarter of a cell.
        BvhTriangle triangle = Triangles(push.triangles).at[middle.triangle];
        Nearest near = Nearest(vec3(0.0), 3.0e38, kFaceFeature);
        compareTriangle(p, triangle.corners, triangle.normal, near);
        uint nearest;
        found = distanceTo(p, sqrt(near.size) + 0.25 * push.field.cell, nearest);
    }
    Distances(push.field.distances).at[index] = side * found;
}

void main() {
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    if (push.finds_middles != 0u)
        findMiddle(group * gl_WorkGroupSize.x + gl_LocalInvocationID.x);
    else
        findPoint(group);
}
