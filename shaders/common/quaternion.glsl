#ifndef HAIRBENCH_COMMON_QUATERNION_GLSL
#define HAIRBENCH_COMMON_QUATERNION_GLSL

// Unit quaternions as vec4: xyz the vector part, w the scalar part.

const vec4 kNoRotation = vec4(0.0, 0.0, 0.0, 1.0);

// Rotates by b, then by a.
vec4 multiply(vec4 a, vec4 b) {
    return vec4(a.w * b.xyz + b.w * a.xyz + cross(a.xyz, b.xyz), a.w * b.w - dot(a.xyz, b.xyz));
}

vec4 conjugate(vec4 rotation) { return vec4(-rotation.xyz, rotation.w); }

vec3 rotate(vec4 rotation, vec3 v) {
    vec3 t = 2.0 * cross(rotation.xyz, v);
    return v + rotation.w * t + cross(rotation.xyz, t);
}

// A vector perpendicular to v: its cross product with the axis along which v is smallest (x before
// y before z if they tie).
vec3 crossLeastAxis(vec3 v) {
    vec3 size = abs(v);
    return size.x <= size.y && size.x <= size.z ? vec3(0.0, v.z, -v.y)
           : size.y <= size.z                   ? vec3(-v.z, 0.0, v.x)
                                                : vec3(v.y, -v.x, 0.0);
}

// A unit vector perpendicular to v; (0, 1, 0) for v = 0.
vec3 perpendicular(vec3 v) {
    vec3 normal = crossLeastAxis(v);
    float len = length(normal);
    return len > 0.0 ? normal / len : vec3(0.0, 1.0, 0.0);
}

// The smallest rotation that takes unit vector `from` to unit vector `to`. If they are opposite, it
// is half a turn round perpendicular(from).
vec4 rotationBetween(vec3 from, vec3 to) {
    vec4 rotation = vec4(cross(from, to), 1.0 + dot(from, to));
    // Unit vectors are off by about 1e-7, so a shorter rotation has no direction.
    if (dot(rotation, rotation) < 1.0e-12) rotation = vec4(crossLeastAxis(from), 0.0);
    return rotation * inversesqrt(dot(rotation, rotation));
}

#endif
