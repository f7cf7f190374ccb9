#ifndef HAIRBENCH_SIMULATION_TURBULENCE_GLSL
#define HAIRBENCH_SIMULATION_TURBULENCE_GLSL

#extension GL_GOOGLE_include_directive : require

#include "common/noise.glsl"

// Kolmogorov's spectrum is E ~ k^(-5/3). The octave round k has the energy k E ~ k^(-2/3), so
// velocities fall by 2^(-1/3) when sizes halve.
const float kKolmogorov = 0.7937005259840998;

// Keeps the nodes of one octave away from those of the next.
const vec3 kOctaveShift = vec3(0.37, 0.61, 0.23);

// Divergence-free turbulence at `fraction` (of any size) from the corner of `cell` in the lattice
// of the largest eddies, with an r.m.s. of 1 in each component. The cells of each octave are half
// the size of the last.
vec3 turbulence(uvec3 cell, vec3 fraction, uint octaves, uint seed) {
    vec3 sum = vec3(0.0);
    float energy = 0.0;
    float amplitude = 1.0;
    for (uint octave = 0u; octave < octaves; ++octave) {
        vec3 whole = floor(fraction);
        cell += uvec3(ivec3(whole));
        fraction -= whole;
        sum += amplitude * curlNoise(cell, fraction, hash(seed, octave, kTurbulencePurpose));
        energy += amplitude * amplitude;
        amplitude *= kKolmogorov;
        cell *= 2u;
        fraction = 2.0 * fraction + kOctaveShift;
    }
    return sum * inversesqrt(energy);
}

#endif
