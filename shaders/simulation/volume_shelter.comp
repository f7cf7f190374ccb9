#version 460
// Slows the air at every guide vertex by the drag of the hair that it has passed; hair_hair.h has
// the equations. One invocation per vertex.
#extension GL_GOOGLE_include_directive : require

#include "simulation/air_drag.glsl"
#include "simulation/volume.glsl"

layout(local_size_x = kGuideGroupSize) in;

layout(push_constant, scalar) uniform Push { ShelterPush push; };

// The share in a cell of the first grid.
float shareIn(VolumeParameters volume, ivec3 cell) {
    VolumeBlock block =
        Blocks(volume.blocks).at[blockIndex(0, blockOf(cell), volume.resolution)];
    int share = Cells(volume.sums).at[cellIndex(0, cell, volume.resolution)].x;
    return inverseOf(scalesOf(block).x) * float(share);
}

// The sum over the cells of the first grid on a ray, each share times the ray's length in the cell,
// in cells. `direction` is a unit vector. Amanatides and Woo 1987, A fast voxel traversal algorithm
// for ray tracing.
float columnAlong(VolumeParameters volume, vec3 point, vec3 direction) {
    ivec3 cell = ivec3(floor(point));
    bvec3 forward = greaterThan(direction, vec3(0.0));
    ivec3 to_next = mix(ivec3(-1), ivec3(1), forward);
    vec3 between_faces = 1.0 / max(abs(direction), 1.0e-6);
    vec3 to_face = mix(point - vec3(cell), vec3(cell + 1) - point, forward) * between_faces;
    float passed = 0.0;
    float column = 0.0;
    for (uint i = 0; i < 3 * volume.resolution; ++i) {
        float next = min(to_face.x, min(to_face.y, to_face.z));
        column += (next - passed) * shareIn(volume, cell);
        passed = next;
        bvec3 crossed = lessThanEqual(to_face, vec3(next));
        cell += mix(ivec3(0), to_next, crossed);
        to_face += mix(vec3(0.0), between_faces, crossed);
        if (any(lessThan(cell, ivec3(0))) || any(greaterThanEqual(cell, ivec3(volume.resolution))))
            break;
    }
    return column;
}

// The share of its speed that air keeps behind hair with this frontal area for each unit of area.
float keptSpeed(float speed, float area) {
    float power = pow(speed, 2.0 / 3.0);
    float lost = (power + push.viscous) * (1.0 - exp(-area / 3.0));
    return lost < power ? pow(1.0 - lost / power, 1.5) : 0.0;
}

void main() {
    VolumeParameters volume = VolumeReference(push.volume).parameters;
    GuideParameters guides = GuideReference(push.guides).parameters;
    uint index = workgroupIndex() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (index >= guides.strand_count * guides.vertices_per_strand) return;  // no barrier follows

    VolumeSample vertex = Samples(volume.samples).at[index];
    vec3 moved = State(guides.positions).at[index].xyz - State(guides.previous).at[index].xyz;
    precise vec3 velocity = moved / guides.step.sub;  // as of VolumeSample without a yield stress
    vec3 relative = State(push.air).at[index].xyz - velocity;
    float speed = length(relative);
    if (speed == 0.0) return;
    vec3 upstream = rotate(conjugate(push.frame.rotation), -relative / speed);
    float area = push.area_per_share * columnAlong(volume, vertex.point, upstream);
    vec3 lost = (1.0 - keptSpeed(speed, area)) * relative;
    State(push.air).at[index].xyz -= lost;
    if (push.drag_along > 0.0) {
        vec3 tangent = tangentAt(guides, index);
        State(push.accelerations).at[index].xyz -=
            push.drag_along * dot(tangent, lost) * tangent;
    }
}
