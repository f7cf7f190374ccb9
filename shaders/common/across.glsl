// Directions across a line, even where the line is seen end-on and the view gives none.
#ifndef HAIRBENCH_ACROSS_GLSL
#define HAIRBENCH_ACROSS_GLSL

#include "common/quaternion.glsl"

// Returns the unit vector along `direction`, or `otherwise` if `direction` has no length.
vec3 unitOr(vec3 direction, vec3 otherwise) {
    return dot(direction, direction) > 1e-30 ? normalize(direction) : otherwise;
}

// Returns the unit vector perpendicular to two unit vectors, E x T. If they are parallel within
// rounding, it returns any vector perpendicular to the tangent.
vec3 unitSide(vec3 to_eye, vec3 tangent) {
    vec3 side = cross(to_eye, tangent);
    if (dot(side, side) > 1e-14) return normalize(side);
    return perpendicular(tangent);
}

// Returns the vector of length `size` along E x T. The inputs may have any length. If they are
// parallel, it returns any vector perpendicular to the tangent.
vec3 sideOfLength(vec3 to_eye, vec3 tangent, float size) {
    vec3 side = cross(to_eye, tangent);
    float squared = dot(side, side);
    if (squared > 1e-30) return side * (size * inversesqrt(squared));
    return size * perpendicular(unitOr(tangent, vec3(0.0, 1.0, 0.0)));
}

#endif
