// Uniform cubic B-spline, thesis equation (4).
#ifndef HAIRBENCH_CURVE_GLSL
#define HAIRBENCH_CURVE_GLSL

// Weights of the four control points r(i-1), r(i), r(i+1), r(i+2) at t in [0, 1]. At t = 1 they are
// the weights at t = 0 of the next segment, shifted by one, to the last bit: joints have no seam.
vec4 splineWeights(float t) {
    float s = 1.0 - t;
    return vec4(s * s * s, (3.0 * t - 6.0) * t * t + 4.0, (3.0 * s - 6.0) * s * s + 4.0, t * t * t) /
           6.0;
}

// Derivatives of the weights by t.
vec4 splineSlopes(float t) {
    float s = 1.0 - t;
    return vec4(-s * s, (3.0 * t - 4.0) * t, (4.0 - 3.0 * s) * s, t * t) / 2.0;
}

vec3 blend(vec4 weights, vec3 a, vec3 b, vec3 c, vec3 d) {
    return weights.x * a + weights.y * b + weights.z * c + weights.w * d;
}

#endif
