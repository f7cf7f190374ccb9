#ifndef HAIRBENCH_CONSTRAINT_DISTANCE_FIELD_GLSL
#define HAIRBENCH_CONSTRAINT_DISTANCE_FIELD_GLSL

#include "common/extensions.glsl"
#include "shared/distance_field_structs.h"
#include "shared/simulation_structs.h"

layout(buffer_reference, scalar) readonly buffer FieldDistances { float at[]; };
layout(buffer_reference, scalar) readonly buffer BodyFields { BodyField at[]; };

// A shorter gradient lies between surfaces equally near on opposite sides: it has no direction.
const float kFlatField = 1.0e-3;

// The trilinear interpolant of the field at p and its exact gradient, which has only approximately
// unit length. Outside the grid, it is the value at the nearest point of the grid plus the distance
// to that point, with the gradient of this sum. The value there is at least the grid's padding.
float sampleDistance(DistanceField field, vec3 p, out vec3 gradient) {
    precise vec3 scaled = (p - field.origin) * field.cells_per_metre;
    vec3 last = vec3(field.points - 1u);
    vec3 inside = clamp(scaled, vec3(0.0), last);
    uvec3 corner = min(uvec3(inside), field.points - 2u);
    vec3 t = inside - vec3(corner);

    FieldDistances distances = FieldDistances(field.distances);
    uint row = field.points.x;
    uint slice = field.points.x * field.points.y;
    uint base = corner.x + row * corner.y + slice * corner.z;
    // One vec4 per x: (y, z) = (0, 0), (1, 0), (0, 1), (1, 1).
    vec4 left = vec4(distances.at[base], distances.at[base + row], distances.at[base + slice],
                     distances.at[base + row + slice]);
    vec4 right = vec4(distances.at[base + 1u], distances.at[base + row + 1u],
                      distances.at[base + slice + 1u], distances.at[base + row + slice + 1u]);
    vec4 along_x = mix(left, right, t.x);
    vec2 along_y = mix(along_x.xz, along_x.yw, t.y);  // per z
    vec4 slope_x = right - left;
    vec2 slope_x_y = mix(slope_x.xz, slope_x.yw, t.y);
    vec2 slope_y = along_x.yw - along_x.xz;
    gradient = field.cells_per_metre * vec3(mix(slope_x_y.x, slope_x_y.y, t.z),
                                            mix(slope_y.x, slope_y.y, t.z),
                                            along_y.y - along_y.x);

    precise vec3 beyond = field.cell * (scaled - inside);  // strands/curve.glsl
    float gap = length(beyond);
    if (gap > 0.0) gradient = mix(gradient, beyond / gap, notEqual(beyond, vec3(0.0)));
    return mix(along_y.x, along_y.y, t.z) + gap;
}

// Distance of a point from the surface with its margin; negative inside. `normal`: the unit
// gradient, or +y if the gradient has no direction. All in the field's frame.
float gapTo(DistanceField field, float margin, vec3 position, out vec3 normal) {
    vec3 gradient;
    float gap = sampleDistance(field, position, gradient) - margin;
    float steepness = length(gradient);
    normal = steepness < kFlatField ? vec3(0.0, 1.0, 0.0) : gradient / steepness;
    return gap;
}

#endif
