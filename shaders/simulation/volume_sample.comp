#version 460
// Guide vertices in the grid's coordinates, and the greatest component of their velocities; one
// invocation per vertex.
#extension GL_GOOGLE_include_directive : require

#include "simulation/volume.glsl"

layout(local_size_x = kGuideGroupSize) in;

layout(push_constant, scalar) uniform Push { VolumePush push; };

shared uint fastest_of_group;

void main() {
    VolumeParameters volume = VolumeReference(push.volume).parameters;
    GuideParameters guides = GuideReference(push.guides).parameters;
    uint index = workgroupIndex() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (gl_LocalInvocationID.x == 0) fastest_of_group = 0;
    barrier();
    if (index < guides.strand_count * guides.vertices_per_strand) {
        vec3 position = State(guides.positions).at[index].xyz;
        vec3 moved = position - State(guides.previous).at[index].xyz;
        vec3 later = fromWorld(push.frame, position + float(guides.step.count) * moved);
        vec3 velocity = moved / guides.step.sub;

        VolumeSample vertex;
        // Hair that is stretched beyond its reach counts at the grid's edge.
        vertex.point = clamp(
            (later - volume.origin) / volume.cell, vec3(kVolumeMargin),
            vec3(float(volume.resolution - kVolumeMargin) - 0.001));
        vertex.share = Factors(volume.shares).at[index];
        vertex.velocity = velocity;
        vertex.unused = 0.0;
        Samples(volume.samples).at[index] = vertex;
        // Floats that are not negative are in the order of their bits.
        vec3 size = abs(velocity);
        atomicMax(fastest_of_group, floatBitsToUint(max(size.x, max(size.y, size.z))));
    }
    barrier();
    if (gl_LocalInvocationID.x == 0) atomicMax(Fastest(volume.fastest).bits, fastest_of_group);
}
