#version 460
// Computes the generalised winding number of triangles at grid points: one invocation per point,
// one work group per block. hair/groom/mesh/winding_number.h.
#extension GL_GOOGLE_include_directive : require

#include "common/extensions.glsl"
#include "shared/distance_field_structs.h"
#include "simulation/bake_blocks.glsl"

layout(local_size_x = kBakeBlock * kBakeBlock * kBakeBlock) in;

layout(push_constant, scalar) uniform Push { BakeWindingPush push; };

layout(buffer_reference, scalar) readonly buffer Nodes { WindingNode at[]; };
layout(buffer_reference, scalar) readonly buffer Triangles { WindingTriangle at[]; };
layout(buffer_reference, scalar) writeonly buffer Windings { float at[]; };

const float kTwoPi = 6.28318531;

// The solid angle of a triangle over 4 pi, positive behind it: van Oosterom and Strackee 1983, The
// solid angle of a plane triangle, eq. 8. In the plane of the triangle it has no sign and is set to
// 0.
float windingOf(vec3 corners[3], vec3 p) {
    vec3 a = corners[0] - p;
    vec3 b = corners[1] - p;
    vec3 c = corners[2] - p;
    float size_a = length(a);
    float size_b = length(b);
    float size_c = length(c);
    float volume = dot(a, cross(b, c));
    if (volume == 0.0) return 0.0;
    float across = size_a * size_b * size_c + dot(a, b) * size_c + dot(b, c) * size_a +
                   dot(c, a) * size_b;
    return atan(volume, across) / kTwoPi;
}

// The solid angle over 4 pi of a node at the offset `away`, approximated by its moments.
float multipoleWinding(uint index, vec3 away) {
    Nodes nodes = Nodes(push.nodes);
    float closeness = inversesqrt(dot(away, away));
    vec3 d = away * closeness;
    vec3 dd = d * d;
    float q[5] = nodes.at[index].quadrupole;
    float o[10] = nodes.at[index].octupole;
    float second = q[0] * (dd.x - dd.z) + q[1] * (dd.y - dd.z) +
                   2.0 * (q[2] * d.x * d.y + q[3] * d.x * d.z + q[4] * d.y * d.z);
    float third = d.x * (o[0] * dd.x + 3.0 * (o[5] * dd.y + o[7] * dd.z)) +
                  d.y * (o[1] * dd.y + 3.0 * (o[3] * dd.x + o[8] * dd.z)) +
                  d.z * (o[2] * dd.z + 3.0 * (o[4] * dd.x + o[6] * dd.y)) +
                  6.0 * o[9] * d.x * d.y * d.z;
    float first = dot(nodes.at[index].dipole, d);
    return closeness * closeness *
           (first + closeness * (-3.0 * second + 7.5 * closeness * third));
}

// All points within `radius` of `middle` visit the same nodes, so that invocations that run
// together do not diverge.
float windingNumber(vec3 p, vec3 middle, float radius) {
    Nodes nodes = Nodes(push.nodes);
    Triangles triangles = Triangles(push.triangles);
    float sum = 0.0;
    uint stack[kBvhDepth];
    uint depth = 0u;
    uint index = 0u;
    while (true) {
        vec3 centre = nodes.at[index].centre;
        if (distance(centre, middle) > nodes.at[index].reach + radius) {
            sum += multipoleWinding(index, centre - p);
        } else {
            uint first = nodes.at[index].first;
            uint count = nodes.at[index].count;
            if (count == 0u) {
                stack[depth] = first + 1u;
                ++depth;
                index = first;
                continue;
            }
            for (uint i = first; i < first + count; ++i)
                sum += windingOf(triangles.at[i].corners, p);
        }
        if (depth == 0u) break;
        --depth;
        index = stack[depth];
    }
    return sum;
}

void main() {
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uvec3 place = placeOf(push.first_block + group, push.blocks);
    uvec3 point = kBakeBlock * place + pointInBlock(gl_LocalInvocationID.x);
    if (group >= push.block_count || any(greaterThanEqual(point, push.points))) return;
    uint index = point.x + push.points.x * (point.y + push.points.y * point.z);
    vec3 p = push.origin + push.cell * vec3(point);
    vec3 middle = push.origin + push.cell * (vec3(point & ~1u) + 0.5);  // of eight points in Morton
                                                                        // order
    float radius = 0.5 * sqrt(3.0) * push.cell;
    Windings(push.windings).at[index] = windingNumber(p, middle, radius);
}
