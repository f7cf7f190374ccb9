// Directions across a line, also where the line is seen end-on and the view gives none.
#ifndef HAIRBENCH_ACROSS_GLSL
#define HAIRBENCH_ACROSS_GLSL

#include "common/quaternion.glsl"

// The unit vector along `direction`, or where that has no length `otherwise`.
vec3 unitOr(vec3 direction, vec3 otherwise) {
    return dot(direction, direction) > 1e-30 ? normalize(direction) : otherwise;
}

// The unit vector across both of two unit vectors, E x T. Where it is no longer than what rounding
// leaves of parallel ones, any across the tangent.
vec3 unitSide(vec3 to_eye, vec3 tangent) {
    vec3 side = cross(to_eye, tangent);
    if (dot(side, side) > 1e-14) return normalize(side);
    return perpendicular(tangent);
}

// The vector of this length along E x T, of vectors of any length; where they are parallel any
// across the tangent.
vec3 sideOfLength(vec3 to_eye, vec3 tangent, float size) {
    vec3 side = cross(to_eye, tangent);
    float squared = dot(side, side);
    if (squared > 1e-30) return side * (size * inversesqrt(squared));
    return size * perpendicular(unitOr(tangent, vec3(0.0, 1.0, 0.0)));
}

#endif
