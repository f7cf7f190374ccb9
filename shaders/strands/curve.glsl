// Cubic curves: the uniform B-spline of thesis equation (4), and a curve through its points.
//
// Two segments compute the same joint from the same points, and all back ends compute the same
// strands, because every sum of products is `precise`: each is rounded by itself, in this order,
// and none is fused. At the ends of a segment t is exactly 0 or 1 (pieceEnd()), so all weights are
// integers before the last division. Dot products, roots and logarithms are single operations,
// which compilers expand alike in every stage, as far as is known.
#ifndef HAIRBENCH_CURVE_GLSL
#define HAIRBENCH_CURVE_GLSL

// Weights of the four control points r(i-1), r(i), r(i+1), r(i+2) at t in [0, 1]. At t = 1 they
// equal the weights of the next segment at t = 0, shifted by one, to the last bit: joints have no
// seam.
vec4 splineWeights(float t) {
    float s = 1.0 - t;
    precise vec4 weights = vec4(s * s * s, (3.0 * t - 6.0) * t * t + 4.0,
                                (3.0 * s - 6.0) * s * s + 4.0, t * t * t) /
                           6.0;
    return weights;
}

// Derivatives of splineWeights() by t.
vec4 splineSlopes(float t) {
    float s = 1.0 - t;
    precise vec4 slopes = vec4(-s * s, (3.0 * t - 4.0) * t, (4.0 - 3.0 * s) * s, t * t) / 2.0;
    return slopes;
}

// Weights of four samples at unit distances, for the curve through them: Catmull and Rom 1974. t in
// [0, 1] is the position between the second sample, where the curve is exact, and the third.
vec4 interpolationWeights(float t) {
    float s = 1.0 - t;
    precise vec4 weights = vec4(-t * s * s, (3.0 * t - 5.0) * t * t + 2.0,
                                (3.0 * s - 5.0) * s * s + 2.0, -s * t * t) /
                           2.0;
    return weights;
}

// Derivatives of interpolationWeights() by t.
vec4 interpolationSlopes(float t) {
    float s = 1.0 - t;
    precise vec4 slopes = vec4((3.0 * t - 1.0) * s, (9.0 * t - 10.0) * t, (10.0 - 9.0 * s) * s,
                               (1.0 - 3.0 * s) * t) /
                          2.0;
    return slopes;
}

vec3 blend(vec4 weights, vec3 a, vec3 b, vec3 c, vec3 d) {
    precise vec3 sum = weights.x * a + weights.y * b + weights.z * c + weights.w * d;
    return sum;
}

#endif
