#ifndef HAIRBENCH_COMMON_NOISE_GLSL
#define HAIRBENCH_COMMON_NOISE_GLSL

// Divergence-free noise: the curl of a vector potential of gradient noise. Bridson, Hourihan and
// Nordenstam 2007, Curl-noise for procedural fluid flow. The fade is from Perlin 2002, Improving
// noise. Cells are counted modulo 2^32, so the noise never ends.

#include "common/random.glsl"

// 1 / the r.m.s. of a component of the curl, over a cell and over all potentials. With gradients of
// variance 1/3 per entry and the fade product W of a corner at d, the mean square is
//   integral over [-1, 1]^3 of (2 W^2 + 4/3 W (d . grad W) + 2/3 |d|^2 |grad W|^2) / 3,
// The integrand is a polynomial, and the result is 238536280 / 480729249.
const float kCurlScale = 1.4196230828767126;

// 6 t^5 - 15 t^4 + 10 t^3 and its derivative. The potential is C2 and its curl C1.
vec3 fade(vec3 t) { return t * t * t * (t * (6.0 * t - 15.0) + 10.0); }
vec3 fadeSlope(vec3 t) { return 30.0 * t * t * (t - 1.0) * (t - 1.0); }

// Returns components in (-1, 1) from ten bits each, with mean 0 and, to within a millionth,
// variance 1/3.
vec3 signedVector(uint bits) {
    uvec3 tens = (uvec3(bits) >> uvec3(2u, 12u, 22u)) & 1023u;
    return (vec3(tens) + 0.5) / 512.0 - 1.0;
}

// The noise at `fraction` of `cell`, per cell, with an r.m.s. of 1 in each component. The potential
// is the sum of W_i G_i d_i over the cell's corners. Row r of G_i is the gradient of component r of
// the potential at corner i. The curl is sum grad W_i x (G_i d_i) + W_i curl(G_i d_i). It is exact,
// so the divergence is exactly zero.
vec3 curlNoise(uvec3 cell, vec3 fraction, uint seed) {
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < 8u; ++i) {
        uvec3 corner = uvec3(i, i >> 1u, i >> 2u) & 1u;
        uvec3 node = cell + corner;
        uint column = hash(seed, node.x, node.y);
        vec3 x = signedVector(hash(column, node.z, 0u));
        vec3 y = signedVector(hash(column, node.z, 1u));
        vec3 z = signedVector(hash(column, node.z, 2u));

        vec3 d = fraction - vec3(corner);
        vec3 weights = 1.0 - fade(abs(d));
        vec3 gradient = -sign(d) * fadeSlope(abs(d)) * weights.yzx * weights.zxy;
        vec3 potential = vec3(dot(x, d), dot(y, d), dot(z, d));
        vec3 curl = vec3(z.y - y.z, x.z - z.x, y.x - x.y);
        sum += cross(gradient, potential) + weights.x * weights.y * weights.z * curl;
    }
    return kCurlScale * sum;
}

#endif
