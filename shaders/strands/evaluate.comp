#version 460
// Writes points of strands, from a first one on, to a buffer; one invocation per point. It uses the
// same functions as the back ends that draw strands.
#extension GL_GOOGLE_include_directive : require
#include "strands/own_color.glsl"
#include "strands/strand.glsl"

layout(local_size_x = kStrandPointsGroupSize) in;

layout(push_constant, scalar) uniform Push { StrandPointsPush push; };

layout(buffer_reference, scalar) writeonly buffer StrandPointRecords {
    StrandPointRecord records[];
};

void main() {
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uint slot = group * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (slot >= push.count) return;  // no barrier follows

    // Points are numbered [triangle][strand][guide segment][point], with the counts of the finest
    // level.
    uint index = push.first + slot;
    PictureParameters picture = PictureReference(push.picture).parameters;
    uint segments = picture.vertices_per_guide - 1u;
    uint points = picture.forced_tessellation + 1u;
    uint point_index = index % points;
    uint segment = index / points % segments;
    uint strand = index / points / segments % picture.forced_density;
    uint triangle = index / points / segments / picture.forced_density;
    uint part = triangle * picture.patches_per_triangle + strand / picture.strands_per_patch;

    StrandPatch strand_patch = strandPatch(picture, part * segments + segment);
    uvec3 guides = patchGuides(picture, strand_patch);
    strand_patch.lod = patchLod(picture, strand_patch, guides);
    uint isoline = strand - strand_patch.first_strand;
    bool drawn = isoline < strandsInPatch(picture, strand_patch) &&
                 point_index <= strand_patch.lod.pieces;

    StrandPoint point = pointFromGuides(picture, strand_patch, guides, strand, point_index);

    StrandPointRecord record;
    record.position = point.position;
    record.width = drawn ? point.width : -1.0;
    record.tangent = point.tangent;
    record.along = point.along;
    record.power = ownPower(picture, point.merged, point.along);
    StrandPointRecords(push.records).records[slot] = record;
}
