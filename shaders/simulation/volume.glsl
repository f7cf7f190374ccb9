// The grids of hair's density and momentum. Cells are numbered from the grid's corner; the grids
// turn and move with the head. Quadratic B-splines spread a vertex over 3 x 3 x 3 cells of each:
// density is smooth in the vertex's place, and its gradient never jumps.
#ifndef HAIRBENCH_SIMULATION_VOLUME_GLSL
#define HAIRBENCH_SIMULATION_VOLUME_GLSL

#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "common/rigid_frame.glsl"
#include "shared/volume_structs.h"
#include "simulation/guides.glsl"

layout(buffer_reference, scalar) readonly buffer VolumeReference { VolumeParameters parameters; };
layout(buffer_reference, scalar) buffer Samples { VolumeSample at[]; };
layout(buffer_reference, scalar) buffer Sums { int at[]; };
layout(buffer_reference, scalar) buffer Fastest { uint bits; };

// Cells that a vertex is spread over in a grid, and where they lie round the one that it is in.
const uint kStencil = 27;
ivec3 stencilOffset(uint i) { return ivec3(i % 3, i / 3 % 3, i / 9) - 1; }

// A point of the first grid in the coordinates of another.
vec3 onGrid(vec3 point, uint grid) { return point + 0.5 * float(grid); }

// The values, along each axis, of the quadratic B-splines round the middles of a cell and its
// neighbours before and after it.
struct Splines {
    vec3 at[3];
};

Splines splinesAt(vec3 point, ivec3 cell) {
    Splines splines;
    for (int i = 0; i < 3; ++i) {
        vec3 away = abs(point - (vec3(cell + i) - 0.5));
        vec3 tail = max(1.5 - away, 0.0);
        splines.at[i] = mix(0.5 * tail * tail, 0.75 - away * away, lessThan(away, vec3(0.5)));
    }
    return splines;
}

// The slopes of the splines, 1/cell, for a point in the cell itself.
Splines slopesAt(vec3 point, ivec3 cell) {
    vec3 offset = point - (vec3(cell) + 0.5);
    return Splines(vec3[3](offset - 0.5, -2.0 * offset, offset + 0.5));
}

// The part of a vertex that falls to a cell of the stencil.
float weight(Splines splines, uint i) {
    return splines.at[i % 3].x * splines.at[i / 3 % 3].y * splines.at[i / 9].z;
}

// How weight() grows with the vertex's place, 1/cell.
vec3 weightGradient(Splines splines, Splines slopes, uint i) {
    vec3 along = vec3(splines.at[i % 3].x, splines.at[i / 3 % 3].y, splines.at[i / 9].z);
    vec3 slope = vec3(slopes.at[i % 3].x, slopes.at[i / 3 % 3].y, slopes.at[i / 9].z);
    return slope * along.yzx * along.zxy;
}

uint cellIndex(uint grid, ivec3 cell, uint resolution) {
    uvec3 c = uvec3(cell);
    return ((grid * resolution + c.z) * resolution + c.y) * resolution + c.x;
}

// The factor from velocity times share to fixed point. `fastest` is no less than any component, so
// the sum of all vertices fits.
float momentumScale(float fastest) {
    return fastest > 1.0e-20 ? float(kVolumeOne) / fastest : 0.0;
}

// A vertex's share and momentum, for its weight in a cell to part. xyz momentum, w share.
vec4 scaled(VolumeSample vertex, float momentum_scale) {
    return vertex.share * vec4(vertex.velocity * momentum_scale, float(kVolumeOne));
}

// What a vertex adds to a cell, fixed point. `scaled_vertex` is from scaled().
ivec4 fixedPoint(vec4 scaled_vertex, float weight) { return ivec4(round(weight * scaled_vertex)); }

#endif
