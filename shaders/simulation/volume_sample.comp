#version 460
// Converts guide vertices to grid coordinates and finds the range for the fixed point of each block
// of cells. One invocation per vertex. With HAIRBENCH_YIELD a vertex has the potential of the stress
// that holds hair in place of its velocity (YieldPush).
#extension GL_GOOGLE_include_directive : require

#include "simulation/volume.glsl"

layout(local_size_x = kGuideGroupSize) in;

#ifdef HAIRBENCH_YIELD
layout(push_constant, scalar) uniform Push { YieldPush push; };

// Adds the last step's displacement to the elastic one, and returns the potential. `moved`: in a
// step, m.
vec3 potentialAt(VolumeParameters volume, uint index, vec3 position, vec3 moved) {
    vec3 velocity = rotate(conjugate(push.frame.rotation), moved);
    // Zero if the head rests.
    velocity += fromWorld(push.frame, position) - fromWorld(push.frame_before, position);
    velocity *= volume.per_step;
    vec4 elastic = State(volume.kept).at[index];
    elastic = elastic.w == 0.0 ? vec4(0.0, 0.0, 0.0, 1.0) : elastic + vec4(velocity, 0.0);
    State(volume.kept).at[index] = elastic;
    return elastic.xyz + velocity;
}
#else
layout(push_constant, scalar) uniform Push { VolumePush push; };
#endif

// Adds a vertex to the blocks of its 3 x 3 x 3 cells.
void addToBlocks(VolumeParameters volume, VolumeSample vertex) {
    Blocks blocks = Blocks(volume.blocks);
    vec3 size = abs(vertex.velocity);
    // Non-negative floats have the same order as their bits.
    uint speed = floatBitsToUint(max(size.x, max(size.y, size.z)));
    uint share = uint(ceil(vertex.share * float(kVolumeBlockOne)));
    for (uint grid = 0; grid < kVolumeGrids; ++grid) {
        ivec3 middle = ivec3(floor(onGrid(vertex.point, grid)));
        uvec3 first = blockOf(middle - 1);
        uvec3 last = blockOf(middle + 1);
        for (uint z = first.z; z <= last.z; ++z)
            for (uint y = first.y; y <= last.y; ++y)
                for (uint x = first.x; x <= last.x; ++x) {
                    uint block = blockIndex(grid, uvec3(x, y, z), volume.resolution);
                    atomicAdd(blocks.at[block].share, share);
                    // It only grows, so an outdated value at worst causes a needless atomic
                    // operation.
                    if (blocks.at[block].fastest < speed)
                        atomicMax(blocks.at[block].fastest, speed);
                }
    }
}

void main() {
    VolumeParameters volume = VolumeReference(push.volume).parameters;
    GuideParameters guides = GuideReference(push.guides).parameters;
    uint index = workgroupIndex() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (index >= guides.strand_count * guides.vertices_per_strand) return;  // no barrier follows

    vec3 position = State(guides.positions).at[index].xyz;
    vec3 moved = position - State(guides.previous).at[index].xyz;
    vec3 later = fromWorld(push.frame, position + float(guides.step.count) * moved);

    VolumeSample vertex;
    // Hair that is stretched beyond its reach is clamped to the grid's edge.
    vertex.point = clamp(
        (later - volume.origin) / volume.cell, vec3(kVolumeMargin),
        vec3(float(volume.resolution - kVolumeMargin) - 0.001));
    vertex.share = Factors(volume.shares).at[index];
#ifdef HAIRBENCH_YIELD
    vertex.velocity = potentialAt(volume, index, position, float(guides.step.count) * moved);
#else
    vertex.velocity = moved / guides.step.sub;
#endif
    vertex.unused = 0.0;
    Samples(volume.samples).at[index] = vertex;
    addToBlocks(volume, vertex);
}
