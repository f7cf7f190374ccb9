#version 460
// Computes the displacement from strands' roots to their positions on the triangles of a deformed
// mesh; one invocation per strand. The roots are those that all back ends draw without this
// correction.
#extension GL_GOOGLE_include_directive : require
#include "strands/strand.glsl"

layout(local_size_x = kSkinGroupSize) in;
layout(push_constant, scalar) uniform Push { SkinPush push; };

layout(buffer_reference, scalar) readonly buffer CarriedRoots { CarriedRoot at[]; };
layout(buffer_reference, scalar) readonly buffer MeshPositions { vec3 at[]; };
layout(buffer_reference, scalar) writeonly buffer Found { vec4 at[]; };

// Returns the root's position on its moved triangle: groom::motionOf().
vec3 carried(CarriedRoot root) {
    MeshPositions mesh = MeshPositions(push.mesh);
    vec3 a = mesh.at[root.corners.x];
    vec3 b = mesh.at[root.corners.y];
    vec3 c = mesh.at[root.corners.z];
    vec3 place = a + root.weights.y * (b - a) + root.weights.z * (c - a);
    vec3 edge = b - a;
    vec3 other = c - a;
    vec3 normal = cross(edge, other);
    float area = length(normal);
    float size = length(edge);
    if (area <= 0.0 || size <= 0.0) return place;
    normal /= area;
    vec3 along = edge / size;
    vec3 across = cross(normal, along);
    // The current edges, relative to those at rest.
    mat2 now = mat2(size, 0.0, dot(other, along), dot(other, across));
    mat2 change = now * mat2(root.inverse_edges.xy, root.inverse_edges.zw);
    vec2 turned = vec2(change[0][0] + change[1][1], change[0][1] - change[1][0]);
    turned /= max(length(turned), 1e-30);  // cosine and sine
    vec2 offset = vec2(turned.x * root.offset.x - turned.y * root.offset.y,
                       turned.y * root.offset.x + turned.x * root.offset.y);
    return place + offset.x * along + offset.y * across + root.offset.z * normal;
}

void main() {
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uint index = group * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (index >= push.count) return;  // no barrier follows

    PictureParameters picture = PictureReference(push.picture).parameters;
    uint strand = index % picture.density;
    if (strand >= picture.forced_density) {  // no level of detail draws it
        Found(push.found).at[index] = vec4(0.0);
        return;
    }
    uint part = index / picture.density * picture.patches_per_triangle +
                strand / picture.strands_per_patch;
    StrandPatch strand_patch =
        strandPatch(picture, part * (picture.vertices_per_guide - 1u));
    uvec3 guides = patchGuides(picture, strand_patch);
    strand_patch.lod = patchLod(picture, strand_patch, guides);
    PatchStrand drawn = strandFromGuides(picture, strand_patch, guides, strand);
    vec3 root = pointOnStrand(picture, strand_patch, drawn, 0.0).position;
    vec3 found = root;
    if (push.roots != kNoAddress) found = carried(CarriedRoots(push.roots).at[index]) - root;
    Found(push.found).at[index] = vec4(found, 0.0);
}
