#version 460
// Every point of every strand into a buffer; one invocation per point. The same functions as the
// back ends that draw them.
#extension GL_GOOGLE_include_directive : require
#include "strands/strand.glsl"

layout(local_size_x = 64) in;

layout(push_constant, scalar) uniform Push { StrandPointsPush push; };

layout(buffer_reference, scalar) writeonly buffer StrandPointRecords {
    StrandPointRecord records[];
};

void main() {
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uint index = group * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (index >= push.count) return;  // no barrier follows

    // Points are numbered [triangle][strand][guide segment][point], as many as at the finest level.
    PictureParameters picture = PictureReference(push.picture).parameters;
    uint segments = picture.vertices_per_guide - 1u;
    uint points = picture.forced_tessellation + 1u;
    uint point_index = index % points;
    uint segment = index / points % segments;
    uint strand = index / points / segments % picture.forced_density;
    uint triangle = index / points / segments / picture.forced_density;
    uint part = triangle * picture.patches_per_triangle + strand / picture.strands_per_patch;

    StrandPatch strand_patch = strandPatch(picture, part * segments + segment);
    uvec3 guides = rootTriangle(picture, strand_patch.triangle);
    strand_patch.lod = triangleLod(picture, guides);
    uint isoline = strand - strand_patch.first_strand;
    bool drawn = isoline < strandsInPatch(picture, strand_patch) &&
                 point_index <= strand_patch.lod.tessellation;

    float t = float(point_index) / float(strand_patch.lod.tessellation);
    vec3 weights = rootWeights(strand_patch.key, strand);
    vec3 r[4];
    for (int k = 0; k < 4; ++k) {
        int control = int(segment) + k - 1;
        r[k] = mixGuides(weights, guideControlPoint(picture, guides.x, control),
                         guideControlPoint(picture, guides.y, control),
                         guideControlPoint(picture, guides.z, control));
    }
    StrandPoint point = pointOnStrand(picture, segment, strand_patch.lod.width_scale, r, t);
    point.position += strandLift(rootLift(picture, guides), weights);

    StrandPointRecord record;
    record.position = point.position;
    record.width = drawn ? point.width : -1.0;
    record.tangent = point.tangent;
    record.along = point.along;
    StrandPointRecords(push.records).records[index] = record;
}
