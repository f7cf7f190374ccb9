#ifndef HAIRBENCH_COMMON_QUATERNION_GLSL
#define HAIRBENCH_COMMON_QUATERNION_GLSL

// Unit quaternions as vec4: xyz the vector part, w the scalar part.

const vec4 kNoRotation = vec4(0.0, 0.0, 0.0, 1.0);

// Rotation by b, then by a.
vec4 multiply(vec4 a, vec4 b) {
    return vec4(a.w * b.xyz + b.w * a.xyz + cross(a.xyz, b.xyz), a.w * b.w - dot(a.xyz, b.xyz));
}

vec3 rotate(vec4 rotation, vec3 v) {
    vec3 t = 2.0 * cross(rotation.xyz, v);
    return v + rotation.w * t + cross(rotation.xyz, t);
}

// A unit vector perpendicular to v: its cross product with the axis it has least of (x before y
// before z where they tie). (0, 1, 0) for v = 0.
vec3 perpendicular(vec3 v) {
    vec3 size = abs(v);
    vec3 axis = size.x <= size.y && size.x <= size.z ? vec3(1.0, 0.0, 0.0)
                : size.y <= size.z                   ? vec3(0.0, 1.0, 0.0)
                                                     : vec3(0.0, 0.0, 1.0);
    vec3 normal = cross(v, axis);
    float len = length(normal);
    return len > 0.0 ? normal / len : vec3(0.0, 1.0, 0.0);
}

// The smallest rotation that takes unit vector `from` to unit vector `to`; half a turn round
// perpendicular(from) where they are opposite.
vec4 rotationBetween(vec3 from, vec3 to) {
    vec3 sum = from + to;
    float size = dot(sum, sum);
    // The sum of unit vectors is off by some 1e-7, so a shorter one has no direction.
    if (size < 1.0e-12) return vec4(perpendicular(from), 0.0);
    vec3 halfway = sum * inversesqrt(size);
    return vec4(cross(from, halfway), dot(from, halfway));
}

#endif
